"""Exercises that grade code: our solution passes, a known mistake gets its own hint."""

import inspect
import re
from unittest.mock import patch

import nbformat
import numpy as np
import pytest
from scipy.optimize import nnls
from sklearn.metrics import mean_squared_error, precision_score, recall_score

from book.exercises import beyond
from tests.exercises import EVERY, exercises
from tests.project import CHAPTERS, code, each_chapter
from vmc_lib import photos
from vmc_lib.arm import muscle
from vmc_lib.camera import Camera
from vmc_lib.cerebellum import offline
from vmc_lib.grading import EMPTY, RIGHT, WRONG, feedback
from vmc_lib.motor.planning import habitual_weights
from vmc_lib.show import figures, questions
from vmc_lib.show.questions import grade, solution
from vmc_lib.what.crbm import CRBM
from vmc_lib.where.appearance import Appearance, similarity


@pytest.fixture(params=EVERY, ids=str.lower)
def exercise(request):
    return EVERY[request.param]


def test_our_solution_passes(exercise):
    """Also where another function has changed its inputs before."""

    def spoils(*inputs):
        for one in inputs:
            if isinstance(one, np.ndarray):
                one[:] = 0
        return 0

    feedback(spoils, exercise)
    assert feedback(exercise.right, exercise) == RIGHT


def test_every_known_mistake_gets_its_own_hint(exercise):
    assert len(exercise.mistakes) >= 3
    for hint, mistake in exercise.mistakes.items():
        assert feedback(mistake, exercise) == f"{WRONG} {hint}"


def test_an_empty_function_is_not_answered_yet(exercise):
    assert feedback(lambda *_: None, exercise) == EMPTY


def test_exception_in_an_answer_is_reported(exercise):
    def fails(*_):
        raise IndexError("no such row")

    text = feedback(fails, exercise)
    assert text.startswith(WRONG)
    assert f"`{exercise.right.__name__}{inspect.signature(exercise.right)}`" in text
    line = inspect.getsourcelines(fails)[1] + 1
    assert text.endswith(f"it stops in line {line}: `IndexError: no such row`.")
    assert "it stops: `TypeError: " in feedback(3, exercise)


@pytest.mark.parametrize("result", [np.zeros((7, 7)), [1, [2, 3]], "words", np.nan])
def test_wrong_result_is_shown_beside_the_right_one(exercise, result):
    text = feedback(lambda *_: result, exercise)
    assert text.startswith(WRONG)
    assert all(f"`{name} = " in text for name in inspect.signature(exercise.right).parameters)
    assert len(text) < 900


@each_chapter
def test_a_chapter_grades_two_functions_or_more(path):
    """Each has an empty function of the solution's name and inputs, a grade, and the solution."""
    assert len(exercises(path)) >= 2
    for name, one in exercises(path).items():
        inputs = ", ".join(inspect.signature(one.right).parameters)
        assert name == one.right.__name__.upper()  # by which the page finds it
        empty = rf"^def {one.right.__name__}\({inputs}\):\n(?: .*\n|\n)*?    \.\.\.  # your"
        assert re.search(empty, code(path), re.M)
        assert f"grade({one.right.__name__}, {name})" in code(path)
        assert f"solution({name})" in code(path)
        assert 3 <= len(inspect.getsource(one.right).splitlines()) <= 12


# ---------------------------------------------------------------- ours is right


def fill(box_i, box_j, size_i, size_j, pixels):
    sizes, boxes = np.array([size_i, size_j]), np.array([box_i, box_j])
    regions = Appearance(sizes, boxes, np.zeros((2, 1)), np.zeros((2, 1)), pixels)
    return similarity(regions, np.array([[0, 1]]), (False, False, False, True)).item()


def machine(W, b=0.0, a=0.0, c=2):
    return CRBM(W[None, None], np.array([b]), np.array([a]), c)


def posterior_drawn(drives, die):
    block = np.pad(drives, (0, 4 - len(drives)), constant_values=-np.inf).reshape(1, 1, 2, 2)
    on, _ = machine(np.ones((1, 1))).posterior(block)
    return min((on.cumsum() < die).sum(), len(drives))


def widths(width, filter_width, block, layers):
    layer, sizes = machine(np.zeros((filter_width, filter_width)), c=block), []
    for _ in range(layers):
        width = layer.posterior(layer.trim(np.zeros((1, 1, width, width))))[1].shape[-1]
        sizes.append(width)
    return sizes


def least_pulls(torque, gain):
    lazy = 1e-4 * np.eye(len(gain))
    return nnls(np.vstack([gain, lazy]), np.append(torque, np.zeros(len(gain))))[0]


def rates(u, a, rise, fall):
    with patch.multiple(muscle, TAU_ACTIVATION=rise, TAU_DEACTIVATION=fall):
        return muscle.activation_rate(u, a)


LIBRARY = {
    "SIMILAR_FILL": fill,
    "ENERGY_OF": lambda v, h, W, b, a: (
        machine(W, b, a, 1).energy(v[None, None], h[None, None]).item()
    ),
    "UNIT_ON": posterior_drawn,
    "POOLED_WIDTHS": widths,
    "PRECISION_AND_RECALL": lambda chances, truth, threshold: [
        score(truth, chances > threshold) for score in (precision_score, recall_score)
    ],
    "ACTIVATION_RATES": rates,
    "NEAR_WEIGHTS": habitual_weights,
    "FAIR_VOTE": lambda rates, preferred: np.linalg.pinv(preferred) @ rates,
    "MISFIT": lambda points, targets, weights: np.sqrt(
        mean_squared_error(weights, habitual_weights(targets, points).T)
    ),
    "SHORTENED": lambda changes, longest: 2 * longest * offline._clip_norm(changes / longest / 2),
    "ONE_JOINT": least_pulls,
    "ON_THE_TABLE": lambda eye, direction, height: (
        Camera(1, np.zeros(2), np.outer([0, 0, 1], direction), eye)
        .back_project(np.zeros(2), height)
        .squeeze()
    ),
}


@pytest.mark.parametrize("name", LIBRARY)
def test_the_library_passes(name):
    assert feedback(LIBRARY[name], EVERY[name]) == RIGHT


def case(name):
    """Our solution, and the inputs of a case."""
    return EVERY[name].right, EVERY[name].draw(np.random.default_rng(7))


def test_engulfed_completes_the_chapters_loop():
    """The solution's own lines, after the chapter's cells that they need."""
    chapter = nbformat.read(CHAPTERS[1], as_version=4)
    cells = {cell.id: cell.source for cell in chapter.cells}
    [lines] = re.findall(r"```python\n(.*?)```", cells["9dad8286"], re.S)
    names = {"engulfed": EVERY["ENGULFED"].right}
    for id_ in ("e5241372", "cf8d25e7", "merge-start", "merge-core"):
        exec(cells[id_], names)  # noqa: S102
    exec(lines, names)  # noqa: S102
    boxes = names["regions"].boxes
    assert (boxes[:, 2:] > boxes[:, :2]).all()  # every row is filled: one region is left
    assert boxes[-1].tolist() == [0, 0, photos.WIDTH, photos.HEIGHT]


def test_a_posture_puts_the_hand_there():
    posture, (hand, upper, fore) = case("POSTURE")
    shoulder, elbow = posture(hand, upper, fore)
    forward, up = np.transpose([[np.sin(q), -np.cos(q)] for q in (shoulder, shoulder + elbow)])
    assert np.allclose([forward @ [upper, fore], up @ [upper, fore]], hand)


def test_activation_to_hold_balances_the_weight():
    hold, (mass, length, strongest) = case("ACTIVATION_TO_HOLD")
    a = hold(mass, length, strongest)
    pull, within = muscle.force(a, length, 0, strongest), (a > 0) & (a < 1)
    assert within.any()
    assert np.allclose(pull[within], 9.81 * mass[within])


def test_cd_step_lowers_the_energy_of_the_data():
    """What goes together is how the energy falls as a weight grows."""
    together, (v, h, *dream) = case("CD_STEP")
    tiny = 1e-6 * np.eye(9).reshape(9, 3, 3)
    energy = EVERY["ENERGY_OF"].right
    slope = [-(energy(v, h, W, 0, 0) - energy(v, h, 0 * W, 0, 0)) / 1e-6 for W in tiny]
    silent = [0 * one for one in dream]
    assert np.allclose(together(v, h, *silent), np.reshape(slope, (3, 3)))


def test_weights_in_a_cube_satisfy_eq_4():
    weigh, (place, corners) = case("CUBE_WEIGHTS")
    weights = weigh(place, corners)
    assert np.allclose(weights @ corners, place)
    assert weights.sum() == pytest.approx(1)


def test_self_motion_lies_in_the_null_space():
    move, (turning, jacobian) = case("SELF_MOTION")
    part = move(turning, jacobian)
    assert np.linalg.norm(part) > 0.1
    assert np.allclose(jacobian @ part, 0)
    assert part @ (turning - part) == pytest.approx(0)


# ---------------------------------------------------------------- what is shown


def test_a_grade_is_a_line_and_in_a_test_a_failure(outputs, monkeypatch):
    page, one = outputs(questions), EVERY["MIXED"]
    grade(one.right, one)
    grade(lambda *_: None, one)
    with pytest.raises(AssertionError, match="grade: ✗ Not yet"):
        grade(lambda *_: 0, one)
    monkeypatch.setenv("VMC_RENDER_MODE", "live")
    grade(lambda *_: "<b>`", one)
    assert [line.count('<p class="vmc-check"') for line in page] == [1, 1, 1]
    assert "✓ Right." in page[0]
    assert "returns nothing" in page[1]
    assert "&lt;b&gt;" in page[2]


def test_the_page_has_buttons_for_an_empty_function(outputs, monkeypatch):
    page = outputs(questions)
    monkeypatch.setenv("VMC_RENDER_MODE", "book")
    grade(lambda *_: None, EVERY["MIXED"])
    assert 'data-function="book.exercises.loop.mixed"' in page[0]


@pytest.mark.parametrize(("mode", "folds"), [("live", 1), ("book", 0)])
def test_a_solution_is_folded_once(outputs, monkeypatch, mode, folds):
    monkeypatch.setenv("VMC_RENDER_MODE", mode)
    texts = outputs(figures)
    solution(EVERY["MIXED"])
    assert texts[0].count("<details>") == folds
    assert "```python\ndef mixed(distances, commands):\n" in texts[0]


def test_the_trials_needed_are_counted_to_the_first_below():
    assert beyond.trials_needed(np.array([1e-2, 2e-4, 5e-5, 9e-5])) == 2
    with pytest.raises(ValueError, match=r"no bias .* is below 0.0001 m"):
        beyond.trials_needed(np.array([5.0, 1.0]))
