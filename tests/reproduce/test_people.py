"""People beside the model: what is stored of each, and that the model's curves are its own."""

import numpy as np
import pytest

from reproduce import people
from reproduce.experiments import forgetting_adaptation as forgetting
from reproduce.measures.changed_worlds import Observation, turn_between
from reproduce.measures.reach_statistics import direction_scatter, speed_shape
from vmc_lib.arm.dynamics import hand
from vmc_lib.cerebellum.adaptation import Adaptation
from vmc_lib.motor.execution import rotate
from vmc_lib.motor.planning import plan
from vmc_lib.motor.templates import load

SOURCES = [value for value in vars(people).values() if isinstance(value, people.Source)]


@pytest.fixture(scope="module")
def stored():
    return forgetting.load_results()


def test_each_number_of_people_says_where_it_is_from():
    assert len(SOURCES) >= 4
    for source in SOURCES:
        assert all(source)
        assert source.url.startswith("https://")


@pytest.mark.parametrize("group", people.MEASUREMENTS["clamp"].values())
def test_an_error_clamps_curve_has_a_mean_and_an_error_for_every_cycle(group):
    assert group["n"] == 16
    assert len(group["mean"]) == len(group["sem"]) == len(forgetting.CLAMP)
    assert min(group["sem"]) > 0


def test_the_rotations_curve_has_the_models_cycles():
    curve = people.MEASUREMENTS["rotation"]
    cycles = len(forgetting.ROTATION) + len(forgetting.REBOUND)
    assert len(curve["mean"]) == len(curve["sem"]) == cycles


def test_the_stored_curves_are_those_of_a_run(stored):
    """The first cycles of one setting, which take seconds; the rest is remade with `make`."""
    share, forgets = 3, 4
    make = lambda: forgetting.learner_and_plans(  # noqa: E731 - twice
        forgetting.SHARES[share], forgetting.FORGETS[forgets]
    )
    clamp = forgetting.clamp_angles(*make(), forgetting.CLAMP[:6])
    np.testing.assert_allclose(clamp, stored["clamp"][share, forgets, :6], atol=0.01)
    rotation = forgetting.rotation_angles(*make(), forgetting.ROTATION[:6], [])
    np.testing.assert_allclose(rotation, stored["rotation"][share, forgets, :6], atol=0.01)


def test_without_forgetting_it_is_the_books_learner():
    learner, plans = forgetting.learner_and_plans(forgetting.SHARES[-1], 0)
    ours = Adaptation(learner.trained_correction, load())
    for one in (learner, ours):
        one.update(plans, lambda _: Observation(rotate(plans.target, 0.1, forgetting.HOME)))
    np.testing.assert_allclose(learner.purkinje, ours.purkinje)


def test_the_rest_is_kept():
    learner, plans = forgetting.learner_and_plans(0.5, 0.25)
    learner.update(plans, lambda _: Observation(rotate(plans.target, 0.1, forgetting.HOME)))
    before = learner.purkinje
    learner.forget()
    np.testing.assert_allclose(learner.purkinje, 0.75 * before)


def test_turns_about_home():
    places = forgetting.targets()
    turned = rotate(places, 0.2, forgetting.HOME)
    np.testing.assert_allclose(turn_between(turned, places, forgetting.HOME), 0.2)
    np.testing.assert_allclose(
        np.linalg.norm(turned - forgetting.HOME, axis=1), forgetting.DISTANCE
    )


def test_a_misfit_is_in_peoples_standard_errors():
    group = people.MEASUREMENTS["clamp"][people.MISSES]
    curve = np.add(group["mean"], 2 * np.array(group["sem"]))
    assert forgetting.misfits(curve, group, forgetting.CLAMPED) == pytest.approx(2)


def test_the_fit_is_the_setting_of_the_least_misfit_inside_the_grid():
    misfit = np.ones((3, 4))
    misfit[1, 2] = 0.5
    assert forgetting.nearest_setting(misfit) == (1, 2)
    assert forgetting.nearest_setting(misfit[1:2]) == (0, 2)
    for edge in (misfit[:2], misfit[1:], misfit[:, :3], misfit[:, 2:]):
        with pytest.raises(ValueError, match="at an edge"):
            forgetting.nearest_setting(edge)


def test_the_stored_fits_lie_inside_the_grid(stored):
    grid = len(forgetting.SHARES), len(forgetting.FORGETS)
    assert stored["clamp"].shape[:2] == grid
    for place in forgetting.fitted_settings(stored["clamp"], stored["rotation"]):
        assert (np.array(place) > 0).all()
        assert (np.array(place) < np.subtract(grid, 1)).all()


def test_no_setting_swings_back_across_the_target_as_people_do(stored):
    """A statement of the page: one memory can fade, but cannot change its side."""
    first, last = (stored["rotation"][..., k] for k in (-len(forgetting.REBOUND), -1))
    assert (first * last > 0).all()
    curve = people.MEASUREMENTS["rotation"]["mean"]
    assert curve[len(forgetting.ROTATION) - 1] < -10
    assert curve[-1] > 5


def test_a_minimum_jerk_reach_is_fastest_half_way():
    """Its speed's peak over its mean is 15 / 8 over the whole, and less where its ends are cut."""
    s = np.linspace(0, 1, 1001)
    way = 10 * s**3 - 15 * s**4 + 6 * s**5
    joint = np.stack([1e-4 * way, np.ones_like(way)], axis=-1)[None]
    assert np.ptp(hand(joint), axis=1).max() > 0
    [share], [ratio] = speed_shape(joint, still=1e-6)
    assert share == pytest.approx(0.5, abs=0.01)
    assert ratio == pytest.approx(15 / 8, rel=0.01)


def test_without_noise_no_reach_scatters():
    plans = plan(forgetting.targets(), load())
    still = direction_scatter(plans, forgetting.HOME, 0.0, 2, np.random.default_rng(0))
    np.testing.assert_allclose(still, 0, atol=1e-9)
    noisy = direction_scatter(plans, forgetting.HOME, 0.05, 4, np.random.default_rng(0))
    assert (noisy > 0.1).all()
