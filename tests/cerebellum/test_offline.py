"""Off-line calibration, as published and better."""

from dataclasses import replace
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

from vmc_lib.arm.simulate import Perturbation
from vmc_lib.cerebellum.offline import (
    algorithm_1,
    algorithm_1_change,
    broyden_calibration,
    calibrate,
    gauss_newton_calibration,
)
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, plan
from vmc_lib.motor.templates import TemplateSet


@pytest.fixture(scope="module")
def reaches(template_set):
    return plan(draw_targets(template_set, 60, np.random.default_rng(10)), template_set)


def share_left(trials):
    return trials.error.mean(axis=1) / trials.error[0].mean()


def test_equations_6_and_7_by_hand(template_set):
    reach = plan([0.15, -0.4], template_set)
    hand, n = np.array([0.14, -0.41]), 3
    for w, p in zip(algorithm_1_change(reach, hand, n), reach.points, strict=True):
        e, r = reach.target - hand, p - hand
        cosine = e @ r / np.linalg.norm(e) / np.linalg.norm(r)
        d_i = np.linalg.norm(p)
        k = np.linalg.norm(e) / np.linalg.norm(hand)
        k *= 1 + n * (np.linalg.norm(reach.target) - d_i) / d_i
        np.testing.assert_allclose(w, k * cosine)


def test_algorithm_1_reduces_the_error_by_a_third(reaches):
    trials = algorithm_1(reaches)
    np.testing.assert_allclose(trials.error[0], execute(reaches).error)
    assert trials.error.min(axis=0).mean() < 0.7 * trials.error[0].mean()
    best = execute(reaches.with_weights(trials.best_weights)).error
    np.testing.assert_allclose(best, trials.error.min(axis=0), atol=1e-12)


def test_the_other_sign_of_the_error_does_not_help(reaches):
    wrong = algorithm_1(reaches, sign=-1)
    assert wrong.error[1:].min(axis=0).mean() > wrong.error[0].mean()


def test_broyden_calibration_meets_its_bars(reaches):
    trials = broyden_calibration(reaches, n_trials=4)
    left, bias = share_left(trials), [movement.bias.mean() for movement in trials.movements]
    assert left[1] < 0.27
    assert left[2] < 0.16
    assert left[4] > 0.1, "four weights that sum to one hold a place, not still"
    assert bias[4] < 0.001 * bias[0]


def test_gauss_newton_holds_the_hand_still(reaches):
    trials = gauss_newton_calibration(reaches)
    assert len(trials.error) == 1 + 4 + 4
    best = execute(reaches.with_weights(trials.best_weights))
    assert best.error.mean() < 0.06 * trials.error[0].mean()
    assert best.speed.mean() < 0.7 * trials.movements[0].speed.mean()


def test_gauss_newton_solves_a_linear_arm(template_set):
    """Where the hold follows the weights linearly, and there are enough of them."""
    slopes = np.random.default_rng(0).normal(size=(4, 2, 2))  # of the hand at two moments

    def reach(commands, _=None):
        return SimpleNamespace(hold=np.einsum("...tm,mnd->...nd", commands[..., :1, :4], slopes))

    commands = np.eye(6)[:4, None]
    linear = TemplateSet(template_set.points[:4], commands, (-np.inf, np.inf), reach)
    error = gauss_newton_calibration(plan([0.05, -0.1], linear, rows=np.arange(4)), 2).error
    assert error[-1] < 0.01 * error[0]


def test_the_error_is_the_mean_distance_and_the_bias_the_mean_places(template_set):
    """A hand that swings round its target is not on it."""
    round_it = 0.01 * np.array([[1, 0], [0, 1], [-1, 0], [0, -1]])
    swinging = replace(
        template_set, reach=lambda *_: SimpleNamespace(hold=np.add([0.05, -0.42], round_it))
    )
    movement = execute(plan([0.05, -0.42], swinging))
    assert movement.error == pytest.approx(0.01)
    assert movement.bias == pytest.approx(0)


def test_broyden_updates_beat_a_fixed_jacobian(reaches):
    learning, repeating = (
        [m.bias.mean() for m in broyden_calibration(reaches, 3, broyden=b).movements]
        for b in (True, False)
    )
    assert learning[3] < 0.5 * repeating[3]


def test_broyden_calibration_starts_from_the_jacobian_it_is_given(reaches):
    """Were the hand to move twice as far, half the change would do."""
    twice = 2 * np.swapaxes(reaches.points, -1, -2)
    whole, half = (
        np.diff(broyden_calibration(reaches, 1, guarded=False, jacobian=j).weights, axis=0)
        for j in (None, twice)
    )
    np.testing.assert_allclose(half, whole / 2, atol=1e-12)


def test_corrections_are_finite_on_a_target_and_on_a_template(template_set):
    reach = plan([0.15, -0.4], template_set)
    np.testing.assert_allclose(algorithm_1_change(reach, reach.target, 5), 0)
    assert np.all(np.isfinite(algorithm_1_change(reach, reach.points[0], 5)))
    exact = plan(template_set.points[6], template_set)
    np.testing.assert_allclose(broyden_calibration(exact).weights, [exact.weights] * 3, atol=1e-6)


def test_guards_limit_the_error_with_a_load(reaches):
    loaded = partial(execute, perturbation=Perturbation(load=0.5))
    trials = [broyden_calibration(reaches, 4, guarded=g, execute=loaded) for g in (True, False)]
    guarded, bold = (each.error for each in trials)
    np.testing.assert_array_equal(guarded[0], bold[0])
    assert bold[1:].max() > 1.3 * bold[0].max()  # what the guards are there for
    assert guarded[1:].max() < 1.2 * guarded[0].max()
    careful, wild = (np.linalg.norm(np.diff(t.weights, axis=0), axis=-1) for t in trials)
    assert wild.max() > 0.5
    assert careful[0].max() <= 0.5 + 1e-12


def test_ten_thousand_corrections_are_bounded(template_set):
    rng = np.random.default_rng(12)
    many = plan(draw_targets(template_set, 10_000, rng), template_set)
    p_a = many.target + rng.normal(0, 0.03, many.target.shape)
    for n in (0, 20):
        assert np.abs(algorithm_1_change(many, p_a, n)).max() < 3
    few = many[:500].with_weights((many.weights + algorithm_1_change(many, p_a, 20))[:500])
    motion = execute(few).motion
    assert np.all(np.abs(motion.q) < np.pi)
    assert few.excitations.min() >= 0
    assert few.excitations.max() <= 1


def test_nan_weights_are_refused(template_set):
    reach = plan([0.15, -0.4], template_set)
    with pytest.raises(ValueError, match="nan"):
        _ = execute(reach.with_weights(reach.weights * np.nan)).endpoint


def test_algorithm_1_needs_a_gain(reaches):
    with pytest.raises(ValueError, match="name at least one n"):
        algorithm_1(reaches, gains=())


def test_calibrate_refuses_rules_that_return_no_trials(reaches):
    assert calibrate(reaches, broyden_calibration).error.shape == (3, 60)

    def mine(plan):
        return plan.weights

    with pytest.raises(ValueError, match="rule mine returned a ndarray: it must return Trials"):
        calibrate(reaches, mine)


def test_a_rule_goes_by_its_name_too(reaches):
    for name, rule in (("published", algorithm_1), ("own", broyden_calibration)):
        np.testing.assert_array_equal(calibrate(reaches, name).error, rule(reaches).error)
