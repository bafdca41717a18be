"""A second plant, a robot: its dynamics, and its learning by the same functions."""

import numpy as np
import pytest

from reproduce.measures import second_plant as plant
from vmc_lib.arm.simulate import Perturbation
from vmc_lib.cerebellum.offline import broyden_calibration
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, plan


@pytest.fixture(scope="module")
def past():
    return plant.torque_templates()


def test_a_posture_puts_the_tip_where_it_should():
    np.testing.assert_allclose(plant.tip(plant.posture(plant.GOALS)), plant.GOALS)


def test_many_trials_of_many_movements_move_as_each_alone(past):
    torques = past.excitations[:6].reshape(2, 3, plant.SAMPLES, 2)
    np.testing.assert_allclose(plant.reach(torques).endpoint.reshape(6, 2), past.points[:6])


@pytest.mark.parametrize("world", [{"load": 1.0}, {"field": np.eye(2)}])
def test_a_load_or_field_that_it_does_not_know_is_refused(past, world):
    movement = execute(plan(plant.GOALS[0], past), Perturbation(**world))
    with pytest.raises(ValueError, match=r"knows no Perturbation"):
        _ = movement.error


def test_kinetic_energy_is_kept_without_friction(monkeypatch):
    """A push is given at once; then the energy v·M v / 2 stays."""
    monkeypatch.setattr(plant, "VISCOSITY", 0.0)
    q, velocity, energy, step = plant.START, np.array([1.0, -2.0]), [], 1e-4
    for _ in range(2000):
        mass, drag = plant.mass_and_drag(q, velocity)
        energy.append(velocity @ mass @ velocity / 2)
        velocity = velocity - step * np.linalg.solve(mass, drag)
        q = q + step * velocity
    np.testing.assert_allclose(energy, energy[0], rtol=1e-3)


def test_the_mass_matrix_is_symmetric_and_positive():
    q = np.random.default_rng(0).uniform(-3, 3, (50, 2))
    mass, _ = plant.mass_and_drag(q, np.zeros((50, 2)))
    np.testing.assert_allclose(mass, np.swapaxes(mass, -1, -2))
    assert (np.linalg.eigvalsh(mass) > 0).all()


def test_templates_end_on_their_goals(past):
    np.testing.assert_allclose(past.points, plant.GOALS, atol=1e-6)


def test_other_laws_try_as_often_as_the_paper_s():
    left = plant.experiment(0, {"the plan alone": lambda plan, *_, rng: 0 * plan.weights})
    assert left["the plan alone"] == left["the plan alone, two tries"] == pytest.approx(1)
    assert left["own online"] < left["exact weights"] < left["off-line, published"] < 1


def test_the_same_functions_plan_and_calibrate_it(past):
    habit = plan(draw_targets(past, 10, np.random.default_rng(0)), past)
    assert habit.excitations.shape == (10, plant.SAMPLES, 2)
    assert habit.excitations.min() < 0, "a torque may be negative; a nerve may not"
    planned, _, second = broyden_calibration(habit).error.mean(axis=1)
    assert 0 < second < 0.1 * planned
