"""Figures and tables of the chapter on seeing and reaching: stages, failures, choices, lesions."""

import numpy as np

from book.figures.loop import describe_end, draw_movement, moves, photo_name
from book.figures.panels import panels
from book.figures.reaching import norm_mm
from reproduce import results
from reproduce.experiments.loop_evaluation import FAILURE_STAGES, LESIONS, lesion_outcomes
from reproduce.experiments.real_world import count_answers, share_text
from vmc_lib import marker_sheet, photos
from vmc_lib.arm.kinematics import to_world
from vmc_lib.show import COLOURS, note, photo_view, table
from vmc_lib.statistics import wilson

FAILURES = {"": "arrived"} | {stage: stage for stage in FAILURE_STAGES}
FAILURE_COLOURS = ("green", "red", "orange", "purple", "blue", "grey")
STAGES = ("place", "plan", "off-line", "online")  # that have a distance
PLACE_SEEN = "the place seen"
BOXES = {  # by lesion: the box's label and colour, what it is for, and what the hand aims at
    "none": ("shuttlecock", "green", "", PLACE_SEEN),
    "ventral": ("best score", "green", "Nothing has a name. ", PLACE_SEEN),
    "dorsal": (
        "shuttlecock",
        "blue",
        "The box has a name, but its place is not used. ",
        "the place in an old photo",
    ),
}
CROWDED = (110, 60)  # pixels: labels nearer than that would hide each other


def miss_mm(photo, reach, motion):
    """How far the hand is from the true shuttlecock over the hold of a reach, in mm."""
    return 1000 * reach.distance(motion, photo.target)


def stage_errors(photo, reach, online):
    """Distances from the true shuttlecock in mm, by stage; none where there is no reach.

    Of the place that is reached for, and of the hand over the hold of each movement.
    """
    if reach is None:
        return {}
    ends = {s: miss_mm(photo, reach, motion) for s, motion in moves(reach, online).items()}
    return {"place": norm_mm(reach.target - photo.target)} | ends


def lesion_view(photo, box, reach, lesion):
    """The box and the calibrated reach under a lesion; what the box is for; how the hand ends."""
    motion = reach.calibrated
    label, colour, told, aim = BOXES.get(lesion, BOXES["none"])
    words = describe_end(photo, reach, motion, aim).capitalize()
    view, scene = draw_movement(photo, box, reach, motion, label, colour)
    scene.tell("miss", None)  # it would tell how near the hand is to the wrong place
    return view, scene, note(f"{told}{words}.")


def shares_within(errors, limit):
    """Cumulative shares of errors, name -> (n,) in mm, up to a limit: a figure of steps."""
    fig, ax = panels(size=(4.3, 3.2))
    for name, values in errors.items():
        share = np.arange(1, len(values) + 1) / len(values)
        ax.step(np.sort(values), share, where="post", label=name)
    ax.set(xlim=(0, limit), ylim=(0, 1), xlabel="place off by at most (mm)")
    ax.set_ylabel("share of the photos")
    ax.legend(loc="lower right")
    return fig


def shoulder_offset_mm(place, turn):
    """How far the shoulder's forward line lies beside a place (3,) once the trunk has turned."""
    shoulder, ahead = to_world([[0, 0, 0], [1, 0, 0]], turn)
    (x, z), (along_x, along_z) = (place - shoulder)[[0, 2]], (ahead - shoulder)[[0, 2]]
    return 1000 * abs(x * along_z - z * along_x)


def sizes_view(photo, boxes):
    """A photo with boxes (n, 4), the size (cm) of the first two, and how many boxes there are."""
    sizes = 100 * photo.camera.sizes(boxes)
    labels = [f"{size:.0f} cm" * (k < 2) for k, size in enumerate(sizes)]
    marks = [(box, label, "orange") for box, label in zip(boxes, labels, strict=True)]
    return f"<div>{photo_view(photo.image, marks[::-1])}{note(f'{len(boxes)} boxes')}</div>"


def failure_bars(failures):
    """Shares of the stages at which reaches failed, level -> (n,) names: stacked bars, a figure.

    Each level tells how many of its failures are the moving's, with a 95 % interval.
    """
    fig, ax = panels(size=(4.3, 3.6))
    fig.subplots_adjust(left=0.42, bottom=0.4)  # room for words and for the legend
    levels = [_name_failures(level, stages) for level, stages in failures.items()]
    left = np.zeros(len(failures))
    for stage, colour in zip(FAILURES, FAILURE_COLOURS, strict=True):
        share = np.array([stages.count(stage) / len(stages) for stages in failures.values()])
        ax.barh(levels, share, left=left, label=FAILURES[stage], color=COLOURS[colour])
        left += share
    ax.set(xlim=(0, 1), xlabel="share of the test photos")
    fig.legend(ncols=2, loc="lower center")
    return fig


def _name_failures(level, stages):
    failed = [stage for stage in stages if stage]
    moving = failed.count(FAILURE_STAGES[-1])
    if not failed:
        return level
    low, high = wilson(moving, len(failed))
    return f"{level}: {moving} of {len(failed)}\nfail by moving\n({low:.0%} to {high:.0%})"


def failure_view(photo, sight):
    """A photo with its kept boxes (orange), the most likely labelled, and the truth (green)."""
    truth = (photo.boxes["shuttlecock"], "", "green")
    return photo_view(photo.image, [*_labelled_boxes(sight), truth])


def _labelled_boxes(sight):
    """Boxes with their chance, by falling chance; of boxes that lie together, one is labelled."""
    chances, boxes = sight.probability, sight.detections.boxes
    corners = []
    for k in np.argsort(-chances):
        corner = boxes[k][:2]
        crowded = any(np.all(abs(corner - other) < CROWDED) for other in corners)
        corners.append(corner)
        yield boxes[k], "" if crowded else f"{chances[k]:.0%}", "orange"


def choices_view(photo, chosen):
    """A photo with its true boxes, and the box or None that each model chose: model -> (4,)."""
    colours = dict(zip(chosen, ("red", "blue"), strict=True))
    boxes = [(box, "", "green") for box in photos.boxes_of(photo, "shuttlecock")]
    boxes += [(box, "", colours[model]) for model, box in chosen.items() if box]
    words = ", ".join(f"{colour} by {model}" for model, colour in colours.items())
    return photo_view(photo.image, boxes), note(f"Green: the truth. Chosen {words}.")


def answer_table(head, results):
    """Each question about photos, and the share that each model answers right: a Markdown table."""
    counts = [count_answers(answers) for answers in results.values()]
    rows = [[question, *(share_text(*one[question]) for one in counts)] for question in counts[0]]
    return table([head, *results], rows)


def error_table(reaches):
    """How far each stage is from the true shuttlecock, and the hand's speed: a Markdown table.

    Of reaches, name -> (photo, reach, online).
    """
    rows = []
    for name, (photo, *made) in reaches.items():
        errors = stage_errors(photo, *made)
        speeds = {stage: f" ({1000 * m.speed:.0f})" for stage, m in moves(*made).items()}
        cells = (f"{errors.get(s, np.nan):.1f}{speeds.get(s, '')}" for s in STAGES)
        rows.append([name, *cells])
    place, *ends = STAGES
    return table(["photo", f"{place} (mm)", *(f"{end} (mm, at mm/s)" for end in ends)], rows)


def sheet_table(shots):
    """How to lay a marker sheet and a shuttlecock, as in photos of both: a Markdown table."""
    aside = [100 * (marker_sheet.CORNER[2] - photo.target[2]) for photo in shots]
    ahead, up, left = 100 * marker_sheet.CORNER - [marker_sheet.PAGE[1] / 10, 0, 0]
    measures = {
        "black square of a marker": f"{marker_sheet.MARKER} mm",
        "markers in the photo": f"{marker_sheet.FEWEST} or more",
        "shuttlecock, left of the sheet": f"{min(aside):.0f}–{max(aside):.0f} cm",
        "shoulder, left of the sheet": f"{left:.0f} cm",
        "shoulder, nearer to you than the sheet": f"{ahead:.0f} cm",
        "shoulder, above the table": f"{-up:.0f} cm",
    }
    return table(["measure", "here"], measures.items())


def place_errors():
    """How far off each place is in the photos that show a sheet: way -> (n,) in mm, or infinite."""
    found = results.records("printed_sheet").items()
    return {way: np.array([np.inf if x is None else x for x in mm]) for way, mm in found}


def lesion_examples():
    """A photo of each kind: without names the hand goes for a cup, or by chance for the right."""
    goes_for = ("rig", "cup"), ("varied", "cup"), ("free", "shuttlecock"), ("rig", "shuttlecock")
    shots, lesions = {}, results.records("lesions")
    for level, held in goes_for:
        outcomes = zip(*lesions[level]["ventral"].values(), strict=True)
        k = [what == held and mm is not None for what, mm, _ in outcomes].index(True)
        shots[photo_name(level, k + 1)] = photos.load(level, "test")[k]
    return shots


def place_table(errors):
    """Medians of errors, way -> (n,) in mm, infinite without a place: a Markdown table."""
    rows = [
        [way, f"{np.median(mm):.1f}", f"{np.mean(mm <= 15):.0%}", np.isinf(mm).sum()]
        for way, mm in errors.items()
    ]
    return table(["box, camera", "median (mm)", "within 15 mm", "without a place"], rows)


def generalist_table(own, generalist, count):
    """Of each level's own model and of one for all, shares of `count` photos: a Markdown table."""
    heads = {"named": "box right", "arrived, own": "hand within 1 cm", "close, own": "within 5 mm"}
    rows = [
        [f"{level}, model of {name}", *(share_text(round(one[k] * count), count) for k in heads)]
        for level in photos.LEVELS
        for name, one in ((level, own[level]), (photos.REAL_LEVEL, generalist[level]))
    ]
    return table(["test renders", *heads.values()], rows)


def lesion_table():
    """What the target boxes hold under each lesion, and how the reaches end: a Markdown table."""
    objects, rows = ("shuttlecock", "cup", "neither", "nothing"), []
    for lesion in LESIONS:
        held, missed, speed = lesion_outcomes(lesion)
        counts = ["–"] * len(objects)  # a place, and no box
        if lesion != "dorsal":
            counts = [np.sum(held == name) for name in objects]
        medians = [f"{np.nanmedian(values):.0f}" for values in (missed, speed)]
        rows.append(
            [lesion, *counts, np.isfinite(missed).sum(), *medians, f"{np.mean(missed <= 10):.0%}"]
        )
    heads = ["lesion", "for the shuttlecock", "the cup", "neither", "nothing", "reaches"]
    return table([*heads, "median miss (mm)", "median speed (mm/s)", "within 1 cm"], rows)
