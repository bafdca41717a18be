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
LOOKS = {  # of a crop's layers
    "V": "A whitened crop in grey, with {}: its edges are dark and bright, its surfaces grey",
    "H1": "Ten dark maps of a crop with {}: thin bright lines, in each along other edges",
    "P1": "Ten dark maps of a crop with {}: the same lines as in H1, thicker",
    "H2": "Ten dark maps of a crop with {}: rows of small dots where many edges lie",
    "P2": "Ten maps of a crop with {}: broad bright bands and patches, much alike in all ten",
    "MP2": "One coarse map of a crop with {}: bright where its edges are, without lines",
}


def layer(maps, name):
    """A layer's maps, of a dict layer -> (1, K, height, width), and how many they are."""
    x, zoom = np.asarray(maps[name])[0], ZOOMS[name]
    words = f"{name}: {_size(x)}"
    if zoom < 1:  # half as large, to fit the page
        x, zoom = x.reshape(len(x), x.shape[1] // 2, 2, -1, 2).max((2, 4)), 1
    return with_words(grey(x[0]) if name == "V" else tiles(x, zoom=zoom), words, (204, 504))


def layer_in_words(maps, name, shown):
    """What `layer` draws of a crop that shows a thing, in words."""
    return f"{LOOKS[name].format(shown)}. {name}: {_size(np.asarray(maps[name])[0])}."


def _size(x):
    return " × ".join(map(str, x.shape))


def beside_gabors(filters, fits):
    """Ten filters, below each its closest Gabor function, of (Gabor, correlation) pairs `fits`."""
    gabors, correlations = zip(*fits, strict=True)
    words = f"median correlation {np.median(correlations):.2f}"
    return with_words(tiles([*filters, *gabors], columns=10, zoom=6), words)


def beside_gabors_in_words(fits):
    """The same in words."""
    typical = np.median([correlation for _, correlation in fits])
    return (
        "Two rows of ten small grey pictures: filters, and under each the Gabor function nearest "
        f"to it. Median correlation {typical:.2f}."
    )


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


def unit_in_words(layer, column, row, pictures, shuttlecock):
    """What `unit` draws, in words."""
    k = 5 * (row - 1) + column - 1
    return (
        f"Ten filters of {layer} in two rows of five, as small grey pictures; in an orange frame "
        f"the one in column {column}, row {row}. Beside them the nine patches that excite it most: "
        f"{shuttlecock[pictures[k]].sum()} are from shuttlecocks."
    )


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
    now, strongest = layers[shift], layers[0, 0]["P2"][0].sum((1, 2)).argmax()
    maps = tiles([now["P2"][0, strongest], now["MP2"][0, 0]], zoom=4)
    return "\n".join(picture), with_words(maps, "left: one of P2; right: MP2")


def under_shift_in_words(shift):
    """The same in words."""
    x, y = shift
    return (
        f"A whitened crop of a shuttlecock, shifted {abs(x)} px {'left' if x < 0 else 'right'} and "
        f"{abs(y)} px {'up' if y < 0 else 'down'}. Beside it two coarse maps, bright where the "
        "shuttlecock is: one of P2, and MP2."
    )


def correlations(by_layer, title):
    """How well each layer's maps correlate with what they were (layer -> correlation), as bars."""
    fig, ax = plt.subplots(figsize=(4.3, 2.9))
    bars = ax.barh(list(by_layer), list(by_layer.values()), color=COLOURS["blue"])
    ax.bar_label(bars, fmt="%.2f", padding=2)
    ax.set(xlim=(min(0, *by_layer.values()) - 0.05, 1.2), xlabel="correlation", title=title)
    ax.invert_yaxis()  # the first on top
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


def over_time_in_words(answers, shuttlecock):
    """The same in words."""
    way = "keeps its sign in most films" if _steady(answers) > 0.75 else "often changes its sign"
    return (
        f"{len(answers)} lines over {answers.shape[1]} views, blue for shuttlecocks, orange for "
        f"cups. The answer {way}; its sign tells cup from shuttlecock in "
        f"{separation(answers, shuttlecock):.0%}."
    )


def _steady(answers):
    """The share of films (n, views) in which a unit's answers have one sign."""
    return np.mean(abs(np.sign(answers).sum(1)) == answers.shape[1])


def mean_map(p2, before):
    """The maps P2 (1, K, height, width) and their mean MP2, with its change from `before`."""
    change = float(abs(p2.mean(1) - before.mean(1)).max())
    mean = with_words(tiles(p2.mean(1), zoom=4), f"MP2: changed by {number(change, 1)}")
    return with_words(tiles(p2[0]), "P2"), mean


def mean_map_in_words(p2, before, dealt_anew):
    """The same in words."""
    change = float(abs(p2.mean(1) - before.mean(1)).max())
    look = "ten speckled maps, all alike" if dealt_anew else "ten maps, each with its own bands"
    return (
        f"P2 of a shuttlecock: {look}. Beside them their mean, MP2: a bright shuttlecock without "
        f"lines, changed by {number(change, 1)}."
    )
