"""Adaptation: a changed world is learned from errors, leaves an after-effect, and washes out."""

from functools import partial

import numpy as np
import pytest

from reproduce.measures.changed_worlds import (
    PERTURBATIONS,
    adaptation_curve,
    error_clamp,
    train_aim_correction,
)
from vmc_lib.cerebellum.adaptation import Adaptation, silent_endpoint, weight_correction
from vmc_lib.cerebellum.online import AimCorrection
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, plan


@pytest.fixture(scope="module")
def skill(template_set):
    return train_aim_correction(template_set, np.random.default_rng(0), 75)


@pytest.mark.parametrize(
    ("perturbation", "corrects", "share"),
    [("a load of 0.5 kg", "pull", 0.5), ("a viscous field", "aim", 0.7), ("a prism", "aim", 0.2)],
)
def test_adaptation_learns_and_washes_out(perturbation, corrects, share, template_set, skill):
    learner, rng = Adaptation(skill, template_set, corrects), np.random.default_rng(1)
    curve = adaptation_curve(learner, template_set, rng, PERTURBATIONS[perturbation])
    before, first, last = curve.error[1], curve.error[2], curve.error[7:10].mean()
    after_effect, washed_out = curve.error[10], curve.error[-1]
    assert first > 5 * before
    assert last < share * first
    assert after_effect > 5 * before
    assert washed_out < 0.5 * after_effect


def test_adaptation_to_a_load_raises_the_sum_of_weights(template_set, skill):
    learner, load = Adaptation(skill, template_set, "pull"), PERTURBATIONS["a load of 0.5 kg"]
    adaptation_curve(learner, template_set, np.random.default_rng(2), load, blocks=(0, 8, 0))
    reaches = plan(draw_targets(template_set, 20, np.random.default_rng(3)), template_set)
    assert learner.correct(reaches).weights.sum(axis=-1).mean() > 1.2


def test_adaptation_starts_at_the_trained_correction(template_set, skill):
    reaches = plan(draw_targets(template_set, 20, np.random.default_rng(4)), template_set)
    expected = skill.correct(reaches).weights
    for corrects in ("aim", "pull"):
        beginner = Adaptation(skill, template_set, corrects)
        np.testing.assert_allclose(beginner.correct(reaches).weights, expected, atol=1e-12)


def test_a_single_error_is_learned_by_its_share(template_set):
    learner = Adaptation(AimCorrection(template_set), template_set, regularisation=1.0)
    reach = plan(np.array([[0.1, -0.4]]), template_set)
    error = reach.target - learner.update(reach, partial(execute, prism=0.1)).endpoint
    correction = learner.cells.excite(reach.target) @ learner.purkinje
    np.testing.assert_allclose(correction, error / 2)


def test_weight_correction_satisfies_equation_4():
    pulls = np.array([[(0.0, 0.1), (0.1, 0.1), (0.1, 0.2), (0.0, 0.2)]])
    shift = np.array([[0.01, 0.03]])
    change = weight_correction(pulls, shift)
    np.testing.assert_allclose((change[:, None] @ pulls)[:, 0], shift)
    assert change.sum() > 0


def test_in_silence_the_hand_ends_where_the_weights_sum_to_nothing(template_set):
    reach = plan(np.array([[0.15, -0.4]]), template_set)
    silence = execute(reach.with_weights(0 * reach.weights))
    np.testing.assert_allclose(silence.endpoint[0], silent_endpoint(template_set))


def test_adaptation_curves_have_new_targets(template_set, skill):
    learner, rng = Adaptation(skill, template_set), np.random.default_rng(5)
    curve = adaptation_curve(learner, template_set, rng, PERTURBATIONS["a prism"], (1, 1, 1), 4)
    assert curve.target.shape == curve.endpoint.shape == (3, 4, 2)
    assert len(np.unique(curve.target.reshape(-1, 2), axis=0)) == 12


def test_a_clamped_error_makes_the_hand_drift_by_a_share_of_it(template_set, skill):
    """Away from what is seen, twice as fast for twice the clamp; and it fades afterwards."""
    small, large = (
        error_clamp(skill, template_set, np.random.default_rng(6), clamp, (1, 2, 3))
        for clamp in (0.02, 0.04)
    )
    assert np.abs(small[:2]).max() < 0.002  # the first clamped block is made before its lesson
    assert small[2] < -0.01
    assert large[2] / small[2] == pytest.approx(2, abs=0.3)
    assert abs(small[-1]) < 0.2 * abs(small[3])


def test_unknown_corrections_are_refused(template_set, skill):
    with pytest.raises(ValueError, match="'push'"):
        Adaptation(skill, template_set, "push")
