"""Figures of names: boxes with their probabilities, crops sorted by them, and calibration."""

from collections import Counter
from itertools import product

import matplotlib.pyplot as plt
import numpy as np

from book.figures.panels import panels
from book.figures.what import tiles
from reproduce.experiments.real_world import share_text
from reproduce.experiments.recognition import PUBLISHED, confusion_counts, rates_of_counts
from vmc_lib.boxes import decode_deltas, iou
from vmc_lib.photos import HEIGHT, WIDTH
from vmc_lib.show import Estimate, dot_plot, estimate, photo_view, table
from vmc_lib.show.figures import margins
from vmc_lib.show.palette import COLOURS
from vmc_lib.statistics import wilson


def shares(draws, *names):
    """Estimates of shares from draws (…, draws, n), by the names along all axes but the draws'.

    No interval ends above 1.
    """
    first, *rest = names
    if rest:
        return {name: shares(part, *rest) for name, part in zip(first, draws, strict=True)}
    rows = zip(first, map(estimate, np.transpose(draws)), strict=True)
    return {name: Estimate(mean, low, min(high, 1)) for name, (mean, low, high) in rows}


def boxes_beside(photo, recogniser, shifts, scales):
    """Boxes beside each object: (object, shift in widths, scale) -> box (4,), probability."""
    places = list(product(photo.boxes, shifts, scales))
    true = np.array([photo.boxes[thing] for thing, *_ in places])
    deltas = [(shift, 0, np.log(scale), np.log(scale)) for _, shift, scale in places]
    moved = _move_boxes(photo, recogniser, true, deltas)
    return dict(zip(places, zip(*moved, strict=True), strict=True))


def steps_to_loss(shots, recogniser, steps):
    """Step, in widths, at which a box slid off a shuttlecock loses the name -> how many boxes.

    One slides to the left and one to the right in each photo; "never" where it keeps the name.
    """
    lost = Counter()
    for shot, side in product(shots, (-1, 1)):
        deltas = [(side * step, 0, 0, 0) for step in steps]
        true = np.tile(shot.boxes["shuttlecock"], (len(steps), 1))
        _, chances = _move_boxes(shot, recogniser, true, deltas)
        unnamed = chances <= 0.5
        lost[steps[unnamed.argmax()] if unnamed.any() else "never"] += 1
    return dict(sorted(lost.items(), key=lambda pair: np.inf if pair[0] == "never" else pair[0]))


def _move_boxes(photo, recogniser, true, deltas):
    """True boxes (n, 4) moved by deltas (n, 4) within their photo, and their probabilities."""
    boxes = decode_deltas(true, np.array(deltas)).clip(0, [WIDTH, HEIGHT, WIDTH, HEIGHT])
    return boxes, recogniser.box_probability(photo.image, boxes)


def named_box(image, box, chance):
    """A photo and a box, green where it is more likely than not a shuttlecock."""
    colour = "green" if chance > 0.5 else "red"
    return photo_view(image, [(box, f"shuttlecock: {100 * chance:.0f} %", colour)])


def named_objects(photo, chances):
    """A photo without shuttlecocks and the probability (n,) of each object: false alarms red."""
    rows = zip(photo.boxes.items(), chances, strict=True)
    return photo_view(
        photo.image,
        [(box, f"{name} {p:.0%}", "red" if p > 0.5 else "blue") for (name, box), p in rows],
    )


def refined_boxes(stream, photo, deltas, looks=3):
    """A box off a shuttlecock by deltas (4,), after so many looks of the stream: (1 + looks, 4).

    And how well each fits, IoU (1 + looks,).
    """
    true = photo.boxes["shuttlecock"][None]
    boxes = [decode_deltas(true, np.array([deltas]))]
    for _ in range(looks):
        boxes.append(stream.refine_boxes(photo.image, boxes[-1]))
    boxes = np.concatenate(boxes)
    return boxes, iou(boxes, true)[:, 0]


def refined_box(stream, photo, boxes, fits, look):
    """A photo, its shuttlecock's true box green, and one of `refined_boxes`."""
    chance = stream.box_probability(photo.image, boxes[look][None])[0]
    true = photo.boxes["shuttlecock"], "", "green"
    label = f"IoU {fits[look]:.2f}, {chance:.0%}"
    return photo_view(photo.image, [true, (boxes[look], label, "orange")])


def ablation_table(without, asked):
    """What the eye for photographs answers without each of its parts: a Markdown table."""
    rows = [
        [name, *(share_text(count, asked[key]) for key, count in counts.items())]
        for name, counts in without.items()
    ]
    heads = "right (IoU above 0.5)", "tight (0.8)", "found, of all", "false alarms"
    return table(["without", *heads], rows)


def scene_table(counts, of):
    """Of `of` pasted scenes of each kind, what was right, tight and a false alarm: a table.

    A scene without a shuttlecock has a dash for what is right and tight.
    """
    from reproduce.training.scenes import SCENES  # whose cut-outs need more than a page has

    rows = []
    for name, three in counts.items():
        *found, alarms = (share_text(count, of) for count in three)
        rows.append([name, *(found if SCENES[name][0] else ("–", "–")), alarms])
    return table(["scene", "right (IoU above 0.5)", "tight (0.8)", "false alarms"], rows)


def rivals(by_level, level, measure):
    """Table III on a level as a dot plot; on the rig's, ticks for what the paper printed."""
    published = PUBLISHED.get(measure) if level == "rig" else None
    return dot_plot(by_level[level][measure], measure, published, (0.6, 1.01))


def first_layer(filters, rows):
    """Filters (n, width, width) about as large on the page for any width, and a plot of scores."""
    plot = dot_plot(rows, "named right, held-out", None, (0.9, 1.005))
    left = plot.subplotpars.left * plot.get_figwidth()
    plot.set_figheight(2.9)  # as high for one seed as for several
    margins(plot, left, top=0.34)
    return tiles(filters, zoom=round(56 / filters.shape[-1])), plot


def sorted_crops(chances, shuttlecock, threshold):
    """Each crop's probability (n,) as a dot, shuttlecocks above cups, and the threshold."""
    precision, recall = rates_of_counts(confusion_counts(chances, shuttlecock, threshold))
    fig, ax = _rows()
    for here, colour in ((shuttlecock, "blue"), (~shuttlecock, "orange")):
        ax.plot(chances[here], _spread(shuttlecock)[here], "o", ms=4, color=COLOURS[colour])
    ax.axvline(threshold, color=COLOURS["ink"])
    ax.set_title(f"precision {precision:.3f}, recall {recall:.3f}".replace("nan", "–"))
    return fig


def _rows():
    fig, ax = plt.subplots(figsize=(4.3, 2.4))
    ax.set(xlim=(-0.02, 1.02), xlabel="probability of a shuttlecock", ylim=(-0.45, 1.45))
    ax.set(yticks=[0, 1], yticklabels=["cups", "shuttlecocks"], title=" ")
    return fig, ax


def _spread(shuttlecock):
    """How high each crop's dot lies (n,): shuttlecocks about 1, cups about 0."""
    place = np.where(shuttlecock, shuttlecock.cumsum(), (~shuttlecock).cumsum()) - 1
    last = np.where(shuttlecock, shuttlecock.sum(), (~shuttlecock).sum()) - 1
    return shuttlecock - 0.3 + 0.6 * place / last


def sorted_crops_in_page(held_out, methods):
    """The same for the page to work out (see `explore`), of level -> chances by method, truth."""
    given = {
        level: {
            "chances": {method: chances[method].tolist() for method in methods},
            "spread": _spread(truth).tolist(),
            "truth": truth.tolist(),
        }
        for level, (chances, truth) in held_out.items()
    }
    return "line", lambda: _rows()[0], given


def reliability(chances, truth):
    """In five bins of the probabilities given (n,), the share that came true, with its interval."""
    fig, ax = panels(size=(4.2, 3.4))
    ax.plot([0, 1], [0, 1], color=COLOURS["grey"], lw=1, gid="guide")
    place = np.minimum((chances * 5).astype(int), 4)
    groups = [place == i for i in np.unique(place)]
    given = np.array([chances[here].mean() for here in groups])
    share = np.array([truth[here].mean() for here in groups])
    ends = np.array([wilson(truth[here].sum(), here.sum()) for here in groups])
    ax.errorbar(given, share, abs(ends.T - share), fmt="o", color=COLOURS["blue"])
    for here, *point in zip(groups, given, share, strict=True):
        side = ("left", 7) if point[1] < point[0] else ("right", -7)  # where no diagonal runs
        away = {"ha": side[0], "xytext": (side[1], -4), "textcoords": "offset points"}
        ax.annotate(f"{here.sum()}", point, **away)
    ax.set(xlabel="probability given", ylabel="share that came true")
    ax.set(xlim=(-0.12, 1.12), ylim=(-0.05, 1.08))
    return fig
