"""Adaptation: a changed world is learned from errors, leaves an after-effect, and washes out."""

import numpy as np
import pytest

from vmc_lib.cerebellum.adaptation import HANGING, Adaptation, pull
from vmc_lib.cerebellum.experiment import WORLDS, adapt, skilled
from vmc_lib.cerebellum.online import Aim
from vmc_lib.motor.planning import draw_targets, plan
from vmc_lib.motor.templates import load


@pytest.fixture(scope="module")
def library():
    return load()


@pytest.fixture(scope="module")
def skill(library):
    return skilled(library, np.random.default_rng(0), 75)


@pytest.mark.parametrize(
    ("world", "corrects", "left"),
    [("a load of 0.5 kg", "pull", 0.5), ("a viscous field", "aim", 0.7), ("a prism", "aim", 0.2)],
)
def test_a_changed_world_is_learned(world, corrects, left, library, skill):
    curve = adapt(
        Adaptation(skill, library, corrects), library, np.random.default_rng(1), WORLDS[world]
    )
    before, first, last = curve.error[1], curve.error[2], curve.error[7:10].mean()
    after_effect, washed_out = curve.error[10], curve.error[-1]
    assert first > 5 * before
    assert last < left * first
    assert after_effect > 5 * before
    assert washed_out < 0.5 * after_effect


def test_the_weight_is_lifted_by_more_of_everything(library, skill):
    learner, world = Adaptation(skill, library, "pull"), WORLDS["a load of 0.5 kg"]
    adapt(learner, library, np.random.default_rng(2), world, blocks=(0, 8, 0))
    reaches = plan(draw_targets(library, 20, np.random.default_rng(3)), library)
    assert learner.correct(reaches).weights.sum(axis=-1).mean() > 1.2


def test_a_beginner_is_only_skilled(library, skill):
    reaches = plan(draw_targets(library, 20, np.random.default_rng(4)), library)
    expected = skill.correct(reaches).weights
    for corrects in ("aim", "pull"):
        beginner = Adaptation(skill, library, corrects)
        np.testing.assert_allclose(beginner.correct(reaches).weights, expected, atol=1e-12)


def test_a_lone_lesson_takes_its_share_away(library):
    learner = Adaptation(Aim(library), library, caution=1.0)
    reach = plan(np.array([[0.1, -0.4]]), library).under(prism=0.1)
    error = reach.target - learner.practise(reach)
    learned = learner.cells.excite(reach.target) @ learner.purkinje
    np.testing.assert_allclose(learned, error / 2)


def test_a_pull_shifts_as_equation_4_says():
    points = np.array([[(0.0, -0.4), (0.1, -0.4), (0.1, -0.3), (0.0, -0.3)]])
    shift = np.array([[0.01, 0.03]])
    change = pull(points, shift)
    np.testing.assert_allclose((change[:, None] @ (points - HANGING))[:, 0], shift)
    assert change.sum() > 0


def test_curves_hold_new_targets_only(library, skill):
    learner, rng = Adaptation(skill, library), np.random.default_rng(5)
    curve = adapt(learner, library, rng, WORLDS["a prism"], (1, 1, 1), 4)
    assert curve.target.shape == curve.reached.shape == (3, 4, 2)
    assert len(np.unique(curve.target.reshape(-1, 2), axis=0)) == 12


def test_nothing_else_can_be_corrected(library, skill):
    with pytest.raises(ValueError, match="'push'"):
        Adaptation(skill, library, "push")
