"""Figures of the hierarchy: a layer's maps, its units and what they answer to."""

from itertools import product

import matplotlib.pyplot as plt
import numpy as np

from book.figures.what import grey, tiles, with_words
from reproduce.measures.slow_features import separation
from vmc_lib.show.figures import photo_view
from vmc_lib.show.markup import data_uri, number
from vmc_lib.show.palette import COLOURS

ZOOMS = {"V": 1, "H1": 0.5, "P1": 1, "H2": 1, "P2": 2, "MP2": 4}


def layer(maps, name):
    """A layer's maps, of a dict layer -> (1, K, height, width), and how many numbers they are."""
    x, zoom = np.asarray(maps[name])[0], ZOOMS[name]
    words = f"{name}: {' × '.join(map(str, x.shape))} = {x.size:,} numbers"
    if zoom < 1:  # half as large, to fit the page
        x, zoom = x.reshape(len(x), x.shape[1] // 2, 2, -1, 2).max((2, 4)), 1
    return with_words(grey(x[0]) if name == "V" else tiles(x, zoom=zoom), words, (204, 504))


def beside_gabors(filters, fits):
    """Ten filters, below each its closest Gabor function, of (Gabor, correlation) pairs `fits`."""
    gabors, correlations = zip(*fits, strict=True)
    words = f"median correlation {np.median(correlations):.2f}"
    return with_words(tiles([*filters, *gabors], columns=10, zoom=6), words)


def unit(stack, zoom, column, row, patches, pictures, shuttlecock):
    """Ten filters, the chosen one marked, and its `preferred_patches` (units, n, width, width).

    A `Pad` over columns 1 to 5 and rows 1 to 2 makes the filters answer to a click. `pictures`
    (units, n) says of which crops the patches are, `shuttlecock` which crops show one.
    """
    image = np.uint8(255 * tiles(stack, 5, zoom))
    height, width = image.shape
    high, wide = height / 2, width / 5
    box = (column - 1) * wide, (row - 1) * high, column * wide, row * high
    k = 5 * (row - 1) + column - 1
    words = f"{shuttlecock[pictures[k]].sum()} of {len(pictures[k])} from shuttlecocks"
    nine = tiles(patches[k], columns=3, zoom=72 // patches.shape[-1])
    marked = photo_view(image, [(box, "", "orange")], axes=(0.5, 5.5, 2.5, 0.5))
    return marked, with_words(nine, words)


def layers_under_shift(cdbn, crop, right, down):
    """P2 and MP2 of a crop (1, 1, h, w) that is shifted: (right, down) in pixels -> layers."""
    from torch import from_numpy  # not in the page

    bird, layers = from_numpy(crop), {}
    for x, y in product(right, down):
        rolled = cdbn.layers(bird.roll((y, x), (-2, -1)))
        layers[x, y] = {name: rolled[name].numpy() for name in ("P2", "MP2")}
    return layers


def under_shift(crop, layers, shift):
    """A whitened crop (n, n), shifted (right, down) as a `Pad` says, and two layers' maps of it.

    `layers` is shift -> layer -> (1, K, h, w). What leaves at one side comes in at the other. The
    maps are P2's strongest and MP2.
    """
    size, half, (x, y) = len(crop), len(crop) // 2, np.mod(shift, len(crop))
    places = [(x - a, y - b) for a in (0, size) for b in (0, size)]
    axes = f"{-half} {half} {half} {-half} 0 1 1 0"
    picture = [
        f'<svg viewBox="0 0 {size} {size}" width="260" data-axes="{axes}"><defs>',
        f'<image id="shifted-crop" width="{size}" height="{size}" href="',
        data_uri(np.uint8(255 * grey(crop))),
        '"/></defs>',
        *(f'<use href="#shifted-crop" x="{x}" y="{y}"/>' for x, y in places),
        "</svg>",
    ]
    now, before = layers[shift], layers[0, 0]
    strongest = before["P2"][0].sum((1, 2)).argmax()
    alike = [np.corrcoef(now[k].ravel(), before[k].ravel())[0, 1] for k in ("P2", "MP2")]
    maps = tiles([now["P2"][0, strongest], now["MP2"][0, 0]], zoom=4)
    return "\n".join(picture), with_words(maps, "P2 {:.2f}, MP2 {:.2f} alike".format(*alike))


def correlations(by_layer, title):
    """How well each layer's maps correlate with what they were (layer -> correlation), as bars."""
    fig, ax = plt.subplots(figsize=(5.6, 2.4))
    bars = ax.bar(list(by_layer), list(by_layer.values()), color=COLOURS["blue"])
    ax.bar_label(bars, fmt="%.2f")
    ax.set(ylim=(min(0, *by_layer.values()) - 0.05, 1.15), ylabel="correlation", title=title)
    return fig


def over_time(answers, shuttlecock):
    """A unit's answers (n, views) to films of n objects, blue for shuttlecocks, orange for cups."""
    fig, ax = plt.subplots(figsize=(4.3, 2.6))
    for here, colour in ((shuttlecock, "blue"), (~shuttlecock, "orange")):
        ax.plot(range(1, answers.shape[1] + 1), answers[here].T, lw=1, color=COLOURS[colour])
    ax.axhline(0, color=COLOURS["ink"])
    title = f"its sign tells cup from shuttlecock in {separation(answers, shuttlecock):.0%}"
    ax.set(xlabel="view", ylabel="answer", ylim=(-3.2, 3.2), title=title)
    ax.set_xticks(range(1, answers.shape[1] + 1))
    return fig


def mean_map(p2, before):
    """The maps P2 (1, K, height, width) and their mean MP2, with its change from `before`."""
    change = float(abs(p2.mean(1) - before.mean(1)).max())
    mean = with_words(tiles(p2.mean(1), zoom=4), f"MP2: changed by {number(change, 1)}")
    return with_words(tiles(p2[0]), "P2"), mean
