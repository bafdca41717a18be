"""Optimal control: stays at the target, above the table, with less effort than habit."""

import numpy as np
import pytest

from reproduce.experiments import muscle_weakness
from reproduce.peers import minimum_variance, optimal_control
from vmc_lib.arm.model import MUSCLES
from vmc_lib.camera import TABLE
from vmc_lib.motor import templates
from vmc_lib.motor.inverse_dynamics import MOVING
from vmc_lib.motor.planning import exact_weights, plan

INNER = optimal_control.TARGETS[optimal_control.INNER]
WEAKENED = muscle_weakness.load_results()["least effort"].astype(float)
OPTIMA = {
    "least effort": (optimal_control.optimal_excitations(), optimal_control.TARGETS),
    "steadiest": (minimum_variance.least_variance_excitations(), INNER),
    **{
        f"least effort, {muscle} weak": (optimal_control.excitations_from_knots(knots), INNER)
        for muscle, knots in zip(MUSCLES, WEAKENED, strict=True)
    },
}


@pytest.mark.parametrize("name", OPTIMA)
def test_every_optimum_stays_at_its_target_and_above_the_table(name):
    """At every ms from when a template is there to the end of the hold; there it hardly moves."""
    excitations, targets = OPTIMA[name]
    motion = templates.reach(excitations)
    away = np.linalg.norm(motion.hand[:, MOVING:, :2] - targets[:, None], axis=-1)
    assert away.shape[1] == 801
    assert away.max() < 0.005
    assert np.linalg.norm(motion.endpoint - targets, axis=-1).max() < 0.001
    assert minimum_variance.kinematic_measures(motion, targets)["speed"].max() < 2.5
    assert motion.hand[..., 1].min() > TABLE


def test_every_optimum_costs_less_than_habit():
    efforts = optimal_control.effort(optimal_control.optimal_excitations())
    for rule in (None, exact_weights):
        habit = plan(optimal_control.TARGETS, templates.load(), *([rule] if rule else []))
        share = efforts / optimal_control.effort(habit.excitations)
        assert share.max() < 1
        assert np.median(share) < 0.6


def test_mixed_optima_cost_little_more():
    """The price of habit is its templates', not the mixing's."""
    cheap = optimal_control.mix_optima()
    np.testing.assert_allclose(cheap.weights, 0.25, atol=1e-3)  # half-way between all four
    efforts = optimal_control.effort(optimal_control.optimal_excitations())[optimal_control.INNER]
    habit = plan(cheap.target, templates.load())
    mixed, shipped = (
        np.mean(optimal_control.effort(p.excitations) / efforts) for p in (cheap, habit)
    )
    assert mixed < 1.5 < 1.8 < shipped


def test_shipped_optima_are_reproducible():
    effort = optimal_control.effort(optimal_control.solve(optimal_control.TARGETS[12]))
    shipped = optimal_control.effort(optimal_control.optimal_excitations()[12])
    np.testing.assert_allclose(effort, shipped, rtol=0.01)


def test_gradients_equal_finite_differences():
    x = np.random.default_rng(0).uniform(0.02, 0.2, 6 * optimal_control.KNOTS)
    step = 1e-5 * np.random.default_rng(1).normal(size=x.size)
    more, less = (optimal_control._task(x + way * step, INNER[0]) for way in (1, -1))
    slopes = optimal_control._task_gradients(x, INNER[0])
    np.testing.assert_allclose(2 * slopes @ step, more - less, atol=2e-6)


def test_effort_is_the_mean_square():
    assert optimal_control.effort(np.full((3, 10, 6), 0.5)) == pytest.approx([0.25] * 3)


def test_targets_outside_are_refused():
    with pytest.raises(ValueError, match="not surrounded"):
        optimal_control.solve(np.array([0.5, -0.4]))
