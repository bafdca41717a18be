"""The whole arm: its physics by what must hold, its memories, and that mixing meets its bars."""

import mujoco
import numpy as np
import pytest

from reproduce.whole_arm import experiment, habits, plant
from vmc_lib.cerebellum.offline import broyden_calibration
from vmc_lib.motor.planning import plan
from vmc_lib.motor.templates import mean_speed

STILL = np.zeros(7)


@pytest.fixture(scope="module")
def nerves():
    return habits.muscle_synergies()


def test_model_has_63_muscles_and_7_free_joints():
    assert len(plant.MUSCLES) == len(set(plant.MUSCLES)) == 63
    assert plant.JOINT_COUPLING.shape == (18, 7)
    np.testing.assert_array_equal(plant.JOINT_COUPLING[plant.FREE], np.eye(7))


def test_a_posture_puts_the_finger_on_its_goal():
    for goal in habits.goal_grid(2):
        at, _ = plant.tip_and_jacobian(habits.reach_posture(goal))
        np.testing.assert_allclose(at, goal, atol=2e-3)


def test_jacobian_equals_finite_differences():
    at, slopes = plant.tip_and_jacobian(habits.START)
    nudged = [plant.tip_and_jacobian(habits.START + step)[0] for step in 1e-6 * np.eye(7)]
    np.testing.assert_allclose((np.array(nudged) - at).T / 1e-6, slopes, atol=1e-5)


def test_rest_commands_hold_the_arm(nerves):
    motion = nerves.move(np.tile(nerves.rest, (plant.TICKS, 1)))
    assert np.linalg.norm(motion.endpoint - plant.tip_and_jacobian(habits.START)[0]) < 0.005
    joints = motion.joints[-1]
    np.testing.assert_allclose(
        joints, plant.JOINT_COUPLING @ joints[plant.FREE], atol=np.radians(0.5)
    )


def test_static_optimisation_gives_the_required_torque(nerves):
    torque, gain = plant.required_torque(habits.START, STILL, STILL)
    assert nerves.rest.min() >= 0
    np.testing.assert_allclose(gain @ nerves.rest, torque, atol=0.01)


def test_activation_is_bounded_when_torque_is_out_of_reach(nerves):
    pull = nerves.share(habits.START, STILL, np.full(7, 300.0))
    assert pull.max() == pytest.approx(1)
    assert pull.min() > -1e-9


def test_stiffness_is_what_a_nudge_brings_back(nerves):
    slack, active = plant.stiffness(habits.START)
    matrix = slack + active @ nerves.rest
    np.testing.assert_allclose(matrix, matrix.T, atol=1e-5)
    for nudge in 1e-3 * np.eye(7):
        torque, gain = plant.required_torque(habits.START + nudge, STILL, STILL)
        torque -= plant.required_torque(habits.START, STILL, STILL)[0]
        gain -= plant.required_torque(habits.START, STILL, STILL)[1]
        np.testing.assert_allclose(torque - gain @ nerves.rest, matrix @ nudge, atol=1e-4)


def test_co_contraction_holds_the_same_posture_and_brings_the_arm_back(nerves):
    torque, gain = plant.required_torque(habits.START, STILL, STILL)
    slack, active = plant.stiffness(habits.START)
    strong = habits.stiff_activation(habits.START)
    np.testing.assert_allclose(gain @ strong, torque, atol=0.01)
    assert 0 <= strong.min()
    assert strong.max() <= 1
    for activation, steady in ((nerves.rest, False), (strong, True)):
        assert (np.linalg.eigvalsh(slack + active @ activation)[0] > 0.25) == steady
        away = experiment.nudge(activation, count=2).mean(axis=0)
        assert (away[-1] < 0.3 * away[0]) == steady


def test_dampers_slow_the_fall(nerves):
    few, all_of_them = (experiment.nudge(nerves.rest, share, count=2)[:, -1] for share in (0.3, 1))
    assert (few > 1.5 * all_of_them).all()


def test_a_movement_ends_in_a_hold():
    """The last command is kept on, and the end point is the mean of what is then seen."""
    past = habits.load_templates()
    motion = past.reach(past.excitations[:2])
    assert motion.joints.shape == (2, plant.TICKS + plant.HOLD, 18)
    np.testing.assert_allclose(
        motion.hold[:, 0], plant.fingertip(motion.joints[:, plant.TICKS - 1])
    )
    np.testing.assert_allclose(motion.endpoint, motion.hold.mean(axis=1))
    np.testing.assert_allclose(motion.activation[:, -1], past.excitations[:2, -1], atol=1e-3)


def test_memories_hold_better_than_their_way_alone(nerves):
    """The last command holds where the arm is, not where it should be."""
    goals = habits.goal_grid()[[37, 62, 87]]
    way = np.array([nerves.commands(habits.reach_posture(goal)) for goal in goals])
    strays = [mean_speed(nerves.move(u).hold) for u in (way, nerves.hold(way))]
    assert strays[1].sum() < 0.8 * strays[0].sum()


@pytest.mark.parametrize("ticks", [1, 30])
def test_excitations_give_the_activations_that_are_wanted(ticks):
    activations = np.linspace([0.2, 0.6], [0.4, 0.5], ticks + 1)
    active = activations[0].copy()
    for excitations in habits.invert_activation(activations):
        for _ in range(plant.STEPS):
            rate = [
                mujoco.mju_muscleDynamics(u, a, np.array([0.01, 0.04, 0]))
                for u, a in zip(excitations, active, strict=True)
            ]
            active += plant.MODEL.opt.timestep * np.array(rate)
    np.testing.assert_allclose(active, activations[-1], atol=0.02)


@pytest.mark.parametrize("count", [1, 6, 14, 34, 63])
def test_every_muscle_obeys_one_command(count):
    groups = habits.muscle_synergies(count).groups
    assert groups.shape == (63, count)
    np.testing.assert_array_equal(groups.sum(axis=1), 1)


def test_many_reaches_move_as_each_alone():
    past = habits.load_templates()
    both = past.reach(past.excitations[:4].reshape(2, 2, plant.TICKS, -1)).endpoint
    np.testing.assert_allclose(both.reshape(4, 3), past.points[:4], atol=1e-9)


def test_the_same_functions_plan_and_correct_it():
    """Three targets of a fresh draw: the plan is near, two corrections nearer."""
    past = habits.load_templates()
    targets = experiment.draw_targets_3d(past, count=3, rng=np.random.default_rng(77))
    errors = broyden_calibration(plan(targets, past)).error.mean(axis=1)
    assert errors[0] < 0.1 * np.linalg.norm(targets, axis=1).mean()
    assert errors[2] < 0.5 * errors[0]


def test_place_and_drift_are_corrected_together():
    """Eight weights meet six demands: the finger ends nearer, and slower."""
    past = habits.load_templates()
    target = experiment.draw_targets_3d(past, count=2, rng=np.random.default_rng(8))[1]
    trials = experiment.stop_calibration(plan(target, past), trials=3)
    first, *_, last = trials.movements
    assert np.linalg.norm(last.endpoint[:3] - target) < 0.2 * np.linalg.norm(
        first.endpoint[:3] - target
    )
    assert last.speed < 0.4 * first.speed


def test_shipped_results_meet_the_bars():
    results = experiment.load_results()
    assert results["real time"] >= 5
    dense = results[f"{len(habits.load_templates().points)} memories"]
    assert dense["planned / reach"].size * experiment.COUNT >= 100
    assert dense["planned / reach"].mean() <= 0.10
    assert dense["planned / way"].mean() <= 0.25
    assert dense["2 corrections"].mean() <= 0.3
    assert np.median(results["after 3 s"]) < 0.005
    both, place = (results["stop"][f"{name}, speed"] for name in ("place and drift", "place"))
    assert both.mean() < 0.5 * place.mean()


@pytest.mark.audit
def test_shipped_results_are_reproducible():
    """The cheapest of its experiments again, one draw."""
    errors = experiment.online_errors(habits.load_templates(), 0)
    for name, error in errors.items():
        assert error == pytest.approx(experiment.load_results()["online"][name][0], rel=1e-3)


def test_error_is_a_share_of_reach_and_of_way():
    """Both shares are of the same miss, and the finger starts nearer to its targets."""
    targets = experiment.draw_targets_3d(
        habits.load_templates(), count=2, rng=np.random.default_rng(5)
    )
    errors = experiment.planned_errors(habits.load_templates(), targets)
    way = np.linalg.norm(targets - plant.tip_and_jacobian(habits.START)[0], axis=1).mean()
    longer = np.linalg.norm(targets, axis=1).mean() / way
    assert errors["planned / way"] == pytest.approx(longer * errors["planned / reach"])
    assert longer > 2
