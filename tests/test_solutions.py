"""Right answers to the exercises are accepted in other idioms than ours, wrong ones refused."""

import inspect
from importlib import import_module

import numpy as np
import pytest

from tests.exercises import EVERY
from tests.mutants import define, mutants
from vmc_lib.grading import RIGHT, feedback

each_exercise = pytest.mark.parametrize("name", EVERY, ids=str.lower)

# The changed lines of functions that differ from ours, and are right nevertheless.
EQUAL = {
    # a factor of all weights, which their sum takes away
    "nearness = 2 / distances",
    "nearness = 2 / np.linalg.norm(points[:, None] - targets, axis=-1)",
    "weights = 2 / errors ** 2",
    # what is exchanged is alike
    "return sum((w * u for w, u in zip(commands, weights, strict=True)))",
    "a, b = (r.boxes[j], r.boxes[i])",
    "areas = [np.prod(box[:, 2:] - box[:, :2], axis=1) for box in (b, a)]",
    "scores[waiting] *= 1 - overlaps[waiting, best]",
    "fit = (windows * W).sum(axis=(3, 2))",
    "return (sliding_window_view(v, h.shape) * h).sum(axis=(3, 2))",
    "return np.clip(0, active, 1)",
    # a list for an array, the reader's own copy or not, False and True for 0 and 1
    "return arms",
    "return [bearing - inward, elbow]",
    "return [target - mixed, mixed - reached]",
    "scores, waiting = (scores, np.ones(len(scores), bool))",
    "return d == 0",
    # a case that does not come, or does not count: no score is below 0, no chance is 1, no two
    # templates lie in one place, no rounded percentage lies between two, at u = a nothing changes
    "best = np.where(waiting, scores, -2).argmax()",
    "place = (chances * bins).astype(int)",
    "place = np.minimum(chances * bins, bins).astype(int)",
    "place = np.minimum(chances * bins, bins + 1).astype(int)",
    "return (d == 0) * (d == 0).sum()",
    "if (off <= 0.05 + 1e-09).all():",
    "if (off < 0.05).all():",
    "if (off < 0.05 - 1e-09).all():",
    "return np.where(u > a, up, down)",
    # from one shuttlecock come 100 % and 50 % alone, from as many false alarms 50 %
    "for n in range(2, most + 1):",
    "precisions = 100 * n / (n + np.arange(n))",
    "precisions = 100 * n / (n + np.arange(n + 2))",
}


def of(name):
    """The other solutions of an exercise, by name."""
    right = EVERY[name].right
    module = import_module(f"tests.solutions.{right.__module__.rpartition('.')[2]}")
    begins = f"{right.__name__}_"
    return {name: one for name, one in vars(module).items() if name.startswith(begins)}


@each_exercise
def test_right_functions_in_other_idioms_are_accepted(name):
    assert len(of(name)) >= 3
    for solution in of(name).values():
        assert feedback(solution, EVERY[name]) == RIGHT, solution.__name__


@each_exercise
def test_a_function_that_is_wrong_in_one_place_is_refused(name):
    right = EVERY[name].right
    wrong = mutants(inspect.getsource(right))
    assert len(wrong) >= 5
    for source, line in wrong.items():
        said = feedback(define(source, right.__globals__), EVERY[name])
        assert (said == RIGHT) == (line in EQUAL), line


def energy_with_one_bias(v, h, W, b, a):
    return EVERY["ENERGY_OF"].right(v, h, W, 0, a) - b


def mean_of_the_drawn(first, again):
    return np.array([again[k].mean() for k in first.argmin(axis=0)])


def to_one_side(side):
    def moment_arms(length, q, turn):
        turned = [q + side * turn * joint for joint in np.eye(2)]
        return [side * (length(q) - length(one)) / turn for one in turned]

    return moment_arms


def ours(name, **fixed):
    """Our solution, some of whose inputs the reader has typed as numbers."""
    right = EVERY[name].right
    names = inspect.signature(right).parameters
    return lambda *inputs: right(**dict(zip(names, inputs, strict=True)) | fixed)


WRONG = [
    ("CHOSEN_BOX", lambda scores, chances: (scores * (chances > 0.5)).argmax()),
    ("CHOSEN_BOX", lambda scores, chances: np.where(chances > 0.5, scores, 0).argmax()),
    ("MIXED", lambda distances, commands: commands[distances.argmin()]),
    ("SIMILAR_FILL", ours("SIMILAR_FILL", pixels=240_000)),
    ("RECALL_CURVE", ours("RECALL_CURVE", enough=0.7)),
    ("SVM_COST", ours("SVM_COST", C=1)),
    ("SOFT_NMS", lambda overlaps, scores: scores * (1 - overlaps[scores.argmax()])),
    ("ENERGY_OF", energy_with_one_bias),
    ("UNIT_ON", lambda drives, die: min(EVERY["UNIT_ON"].right(drives, die), len(drives) - 1)),
    ("CD_STEP", lambda v, h, dream_v, dream_h: EVERY["CD_STEP"].right(v, h, dream_v, dream_h).T),
    ("POOLED_WIDTHS", ours("POOLED_WIDTHS", layers=3)),
    ("PIXELS_SEEN", lambda filters, blocks: EVERY["PIXELS_SEEN"].right(filters[:3], blocks[:3])),
    ("PRECISION_AND_RECALL", ours("PRECISION_AND_RECALL", threshold=0.5)),
    ("BROKEN_PROMISE", ours("BROKEN_PROMISE", bins=5)),
    ("POSSIBLE_COUNTS", ours("POSSIBLE_COUNTS", most=100)),
    ("ACTIVATION_RATES", ours("ACTIVATION_RATES", rise=0.01, fall=0.04)),
    ("ACTIVATION_TO_HOLD", ours("ACTIVATION_TO_HOLD", strongest=987)),
    ("MOMENT_ARMS", to_one_side(1)),
    ("MOMENT_ARMS", to_one_side(-1)),
    ("MOMENT_ARMS", ours("MOMENT_ARMS", turn=0.1)),
    ("POSTURE", ours("POSTURE", upper=0.29, fore=0.27)),
    ("NEAR_WEIGHTS", lambda target, points: 1 / ((points - target) ** 2).sum(axis=1)),
    ("FAIR_VOTE", lambda rates, preferred: preferred.T @ rates / (rates**2).sum() ** 0.5),
    ("SHORTENED", ours("SHORTENED", longest=0.5)),
    ("AFTER_LESSONS", ours("AFTER_LESSONS", rate=0.3)),
    ("AFTER_LESSONS", lambda v, active, answers, rate: v + rate * (answers[0] - active[0] @ v)),
    ("SPARSE", ours("SPARSE", most=3)),
    ("DELAY_SIGNAL", lambda signal, steps: EVERY["DELAY_SIGNAL"].right(signal, 1)),
    ("SMITH", lambda report, model, steps: report + model - model[0]),
    ("FIRST_BROKEN", lambda right: np.where(right.all(axis=1), 4, right.argmin(axis=1))),
    ("TENFOLD", lambda sizes, errors: EVERY["TENFOLD"].right(sizes, np.sort(errors)[::-1])),
    ("ONE_JOINT", lambda torque, gain: EVERY["ONE_JOINT"].right(abs(torque), gain)),
    ("HONEST", mean_of_the_drawn),
    ("COMBINE", lambda reports, errors: EVERY["COMBINE"].right(reports[:2], errors[:2])),
]


@pytest.mark.parametrize(("name", "function"), WRONG, ids=[name.lower() for name, _ in WRONG])
def test_what_was_drawn_tells_a_wrong_function(name, function):
    """A constant for an input, a case that hid a term, one side of two, the first alone."""
    assert feedback(function, EVERY[name]) != RIGHT


def test_there_are_many():
    right = [one for name in EVERY for one in of(name)]
    ours = [inspect.getsource(exercise.right) for exercise in EVERY.values()]
    wrong = [line for source in ours for line in mutants(source).values() if line not in EQUAL]
    assert len(right) >= 110
    assert len(wrong) >= 500
