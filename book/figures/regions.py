"""Figures and tables of the chapter on regions: crops, margins, weights, boxes and scores."""

import numpy as np

from book.figures.panels import legend_above, panels
from book.figures.where import in_corner
from reproduce import paper
from reproduce.experiments import fresh_test_set, localisation, real_world, region_clusters
from reproduce.measures.precision_recall import rates
from vmc_lib.boxes import HIT_IOU, MIN_IOU, iou
from vmc_lib.show import COLOURS, dot_plot, photo_view, table
from vmc_lib.statistics import wilson

CHANNELS = ("red", "green", "blue", "mean")
MEASURES = ("precision", "recall")
PRINTED_NAMES = {  # in the paper's Table I; that its "Gaussian" is the sigmoid is our reading
    "linear": "linear",
    "rbf": "RBF",
    "poly": "polynomial",
    "sigmoid": "Gaussian",
}
FRESH_ROWS = (*fresh_test_set.KERNELS, *fresh_test_set.DETECTORS)
PLANE = (-4, 5)  # of an SVM's two clouds: what is drawn of both axes
YOURS = (3.3, -1.3)  # the example that the reader moves
QUALITIES = ("a good candidate", "a box on the shuttlecock", "a good box")


def crop_sheet(crops):
    """Crops (n, 3 size²) of `raw_pixels`, size up to 32, in rows of eight: an image.

    Each is drawn 32 pixels wide.
    """
    size = round((crops.shape[1] / 3) ** 0.5)
    tiles = crops.reshape(-1, 8, size, size, 3).repeat(32 // size, 2).repeat(32 // size, 3)
    grid = np.pad(tiles / 2 + 0.5, [(0, 0), (0, 0), (2, 2), (2, 2), (0, 0)]).swapaxes(1, 2)
    return grid.reshape(-1, 36 * 8, 3)


def margin(cost, kernel, yours=YOURS):
    """Two clouds (40, 2), the first point given, and an SVM: points, which are something, SVM."""
    from sklearn.svm import SVC  # slow to load

    clouds, side = _clouds()
    clouds[0] = yours
    return clouds, side, SVC(C=cost, kernel=kernel).fit(clouds, side)


def _clouds():
    side = np.repeat([True, False], 20)
    noise = np.random.default_rng(3).normal(size=(40, 2))
    return noise + np.where(side[:, None], 1.3, -1.3), side


def margin_plot(cost, kernel, yours):
    """An SVM between two clouds: its border, its margin and how much each example counts.

    A ring's area grows with its example's α, as a share of the cost C, its bound: a figure.
    """
    clouds, side, svm = margin(cost, kernel, yours)
    grid = np.stack(np.meshgrid(*[np.linspace(*PLANE, 81)] * 2), -1)
    f = svm.decision_function(grid.reshape(-1, 2)).reshape(81, 81)
    fig, ax = _plane()
    ax.contour(*grid.T, f.T, [-1, 0, 1], colors=COLOURS["grey"], linestyles=["--", "-", "--"])
    ax.plot(*clouds[side].T, "o", color=COLOURS["blue"], gid="something")
    ax.plot(*clouds[~side].T, "s", color=COLOURS["orange"], gid="table")
    rings = 40 + 160 * abs(svm.dual_coef_[0]) / cost
    ax.scatter(*svm.support_vectors_.T, rings, "none", edgecolors=COLOURS["red"], gid="alpha")
    ax.set_title(_rings_in_words(svm, cost))
    return fig


def _plane():
    fig, ax = panels(size=(4.3, 3.4))
    for mark, colour, name in ("o", "blue", "something"), ("s", "orange", "table"):
        ax.plot([], [], mark, color=COLOURS[colour], label=name)
    ax.set(xticks=[], yticks=[], xlim=PLANE, ylim=PLANE, aspect="equal")
    ax.set(xlabel="blueness", ylabel="roundness")
    legend_above(fig, 0.6)
    return fig, ax


def _rings_in_words(svm, cost):
    """How many examples count, and how much the reader's own does, in words."""
    yours = abs(svm.dual_coef_[0][svm.support_ == 0]).sum() / cost
    return f"{len(svm.support_)} rings; yours: α = {yours:.2f} C"


def margin_in_words(cost, kernel, yours):
    """The same in words."""
    words = _rings_in_words(margin(cost, kernel, yours)[2], cost)
    return f"Two clouds and a border between them; C is {cost:g}, {kernel}: {words}."


def margin_in_page():
    """The same for the page to work out (see `explore`)."""
    clouds, side = _clouds()
    given = {"clouds": clouds.tolist(), "labels": np.where(side, 1, -1).tolist(), "plane": PLANE}
    return "margin", lambda: _plane()[0], given


def weight_map(weights, channel):
    """A channel of weights (16, 16, 3), or their mean: a heat map with a colour bar, a figure."""
    channels = np.dstack([weights, weights.mean(2)])
    limit = abs(weights).max()
    fig, ax = panels(size=(4, 3.3))
    shown = channels[..., CHANNELS.index(channel)]
    fig.colorbar(ax.imshow(shown, cmap="PuOr", vmin=-limit, vmax=limit))
    ax.set_axis_off()
    return fig


def regress(detector, image, thing, middle, rounds):
    """A box around `middle`, 0.9 times as large as a thing's (4,), corrected; its IoU with that."""
    half = 0.45 * (thing[2:] - thing[:2])
    box = np.concatenate([middle - half, middle + half])
    box = detector.regress(image, box[None], rounds)
    return box[0], iou(box, thing).item()


def regressed_view(detector, image, thing, middle, rounds):
    """An image with a thing's box, a corrected one (see `regress`), their IoU, and its start.

    Green at an IoU of 0.8 or more.
    """
    box, shared = regress(detector, image, thing, middle, rounds)
    colour = "green" if shared >= MIN_IOU else "orange"
    words = in_corner(f"IoU {shared:.2f}; began {_began(thing, middle)}", colour)
    return photo_view(image, [(thing, "", "grey"), (box, "", colour), words])


def regressed_in_words(detector, image, thing, middle, rounds):
    """The same in words."""
    _, shared = regress(detector, image, thing, middle, rounds)
    began = _began(thing, middle, " widths", " heights")
    when = f"After {rounds} round{'s' * (rounds > 1)} of" if rounds else "Before"
    return (
        f"Two boxes on a photo: the thing's own, and one that began {began}. "
        f"{when} box regression: IoU {shared:.2f}."
    )


def _began(thing, middle, wide="", high=""):
    """How far off a thing a box's middle lies, in its widths and heights, in words."""
    right, down = ((middle - (thing[:2] + thing[2:]) / 2) / (thing[2:] - thing[:2])).round(1)
    across = f"{abs(right):g}{wide} {'left' if right < 0 else 'right'}"
    along = f"{abs(down):g}{high} {'up' if down < 0 else 'down'}"
    return ", ".join([across] * bool(right) + [along] * bool(down)) or "in its middle"


def kernel_plot(level, recipe, measure):
    """Table I of a level by a recipe, over its trainings: a dot plot.

    The published recipe on the rig is tested on fresh photos, beside what the paper printed.
    """
    part, ticks = MEASURES.index(measure), {}
    test = localisation.table_1(level, "test", recipe)
    if (level, recipe) == ("rig", "published"):
        test = fresh_test_set.table_1()
        ticks = {kernel: paper.TABLE_1[name][part] for kernel, name in PRINTED_NAMES.items()}
    series = {"test": test, "in-sample": localisation.table_1(level, "train", recipe)}
    series = {
        split: {kernel: draws[:, part] for kernel, draws in rows.items()}
        for split, rows in series.items()
    }
    return dot_plot(series, measure, ticks, (0, 1.02))


def recipe_plot(best, overlap):
    """Table II as a dot plot: precision and recall at an overlap, of `best_by_recipe`."""
    rows = zip(MEASURES, rates(best, overlap).T, strict=True)
    series = {measure: dict(zip(localisation.RECIPES, row, strict=True)) for measure, row in rows}
    return dot_plot(series, f"at an overlap of {overlap:g}", None, (0, 1.02))


def fresh_plot(level, measure):
    """Shares on the fresh test set, and what forty photos would know of them: a dot plot.

    Regions on one object say less than their number, by their design effect.
    """
    part, effects = MEASURES.index(measure), region_clusters.load_results()[level]["context"]
    series = {"fresh photos": {}, "40 photos": {}}
    for row, (right, wrong, missed) in _fresh_counts(level).items():
        n, effect = (right + wrong, right + missed)[part], effects.get(row, (1, 1))[part]
        fresh = 100 if row in fresh_test_set.KERNELS else 200  # photos
        for name, shots in zip(series, (fresh, 40), strict=True):
            worth = shots / fresh / effect
            series[name][row] = right / n, *wilson(worth * right, worth * n)
    return dot_plot(series, f"{measure}, {level}", None, (0, 1.02))


def _fresh_counts(level):
    """Row -> how many are right, wrong and missed on the fresh test set."""
    counts = fresh_test_set.load_results()
    found = {row: counts[row][level] for row in FRESH_ROWS}
    if level == "rig":
        seeds = range(localisation.TRAININGS)
        found["published"] = np.mean([counts["IoU", k][level] for k in seeds], axis=0)
    return found


def retrained_table(levels):
    """Table II over several trainings, means and half 95 % intervals: a Markdown table."""
    rows = []
    for recipe in localisation.RETRAINED:
        rates = [
            zip(*localisation.table_2_interval(level, recipe), strict=True) for level in levels
        ]
        cells = (" / ".join(f"{mean:.2f} ± {half:.2f}" for mean, half in rate) for rate in rates)
        rows.append([recipe, *cells])
    return table(["features", *levels], rows)


def photograph_table(head, questions):
    """How often each model is right in photographs, by what is asked: a Markdown table."""
    rows = []
    for model in real_world.MODELS:
        for split in real_world.SPLITS:
            counts = real_world.count_answers(real_world.load_results(model, split))
            tuned = (model, split) == ("real", "validation")
            name = f"{model}, {split}{' (partly in-sample)' * tuned}"
            rows.append([name, *(real_world.share_text(*counts[q]) for q in questions)])
    return table([head, *questions], rows)


def box_counts(model):
    """Of a model's test photographs of shuttlecocks: how many boxes it keeps of each, the mean.

    And on how many shuttlecocks one of its FEW best lies, and a good one.
    """
    found = real_world.load_results(model, "test").values()
    shown = [result for result in found if result["holds"] == "shuttlecock"]
    onto, good = (sum(r["few"] > least for r in shown) for least in (HIT_IOU, MIN_IOU))
    return np.mean([result["boxes"] for result in shown]), onto, good


def counts_table():
    """The numbers of objects and of false alarms behind Table I's percentages: a Markdown table."""
    wanted, rows = paper.TEST_ROIS["positive"], {}
    for kernel, (precision, recall) in paper.TABLE_1.items():
        hits = round(recall * wanted)
        false = round(hits / precision) - hits
        rows[kernel] = f"{precision:.2%} / {recall:.2%}", f"{hits} of {wanted}", false
    return table(["kernel", "precision / recall", "found", "false alarms"], rows)


def settings_table():
    """The costs and scales that were tried, and those chosen for each recipe: Markdown."""
    tried = localisation.COSTS, localisation.SCALES
    costs, scales = (", ".join(map("{:g}".format, values)) for values in tried)
    rows = {
        name: map("{0[0]:g}, {0[1]:g}".format, localisation.kernel_settings(name).values())
        for name in localisation.TABLE_1_RECIPES
    }
    return (
        f"Tried: C of {costs}; γ of {scales}, over the number of features times their variance. "
        "(*linear* has no γ; with *poly* a larger C does the same.)\n\n"
        + table(["C, γ", *localisation.TABLE_1_KERNELS], rows)
        + f"\n\nWith *published*, these lie at an edge of what was tried, so that settings beyond "
        f"may do better: {', '.join(_at_an_edge())}."
    )


def _at_an_edge():
    """The chosen settings of the published recipe that are the least or largest of those tried."""
    for kernel, (cost, scale) in localisation.kernel_settings().items():
        scales = localisation.FREE_SCALES[kernel]
        if cost in (min(localisation.COSTS), max(localisation.COSTS)):
            yield f"C of *{kernel}*"
        if len(scales) > 1 and scale in (min(scales), max(scales)):
            yield f"γ of *{kernel}*"
