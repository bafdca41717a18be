"""Simulation of the arm: two engines agree, and refuse wrong inputs."""

import warnings

import numpy as np
import pytest

from reproduce.peers.muscle_models import LAWS
from reproduce.results import arrays
from vmc_lib.arm.dynamics import forward_dynamics, hand, paths
from vmc_lib.arm.engines import (
    ENGINES,
    NO_PUSH,
    allocate_trajectory,
    muscle_torque,
    step_trajectory,
    stop_torque,
)
from vmc_lib.arm.model import LIMITS, STEP
from vmc_lib.arm.simulate import Perturbation, constant_excitation, simulate

START = np.radians([-20.0, 95.0])
QUIET = np.zeros((10, 6))


def random_excitations(count, steps, rng):
    return np.repeat(rng.uniform(0, 1, (count, steps // 100, 6)) ** 2, 100, axis=1)


def test_engines_agree():
    rng = np.random.default_rng(0)
    excitations = random_excitations(100, 800, rng)
    starts = rng.uniform(np.radians([-50, 20]), np.radians([20, 100]), (100, 2))
    fast, reference = (simulate(excitations, starts, engine=e) for e in ("compiled", "mujoco"))
    assert np.abs(fast.q - reference.q).max() < 1e-6
    np.testing.assert_array_equal(fast.activation, reference.activation)


def test_engines_agree_with_a_load_in_a_force_field():
    excitations = random_excitations(5, 800, np.random.default_rng(3))
    perturbation = Perturbation(load=0.5, field=((-1, 2), (-2, -1)))
    fast, reference, bare = (
        simulate(excitations, START, engine=e, perturbation=w)
        for e, w in [
            ("compiled", perturbation),
            ("mujoco", perturbation),
            ("compiled", Perturbation()),
        ]
    )
    assert np.abs(fast.q - reference.q).max() < 1e-6
    assert np.abs(fast.q - bare.q).max() > 0.01


def test_a_drag_acts_without_a_push():
    u = random_excitations(1, 300, np.random.default_rng(5))
    drag, paths = 5 * np.eye(2), []
    for push in (NO_PUSH, np.zeros((1, 300, 2))):
        paths.append(allocate_trajectory(u, START, 0, u[:, 0]))
        step_trajectory(u, paths[-1], range(300), push=push, drag=drag)
    np.testing.assert_array_equal(*(q for q, *_ in paths))
    assert np.abs(paths[0][0] - simulate(u, START, u[:, 0]).q).max() > 0.01


def test_all_arms_at_once_equal_the_loop(monkeypatch):
    rng = np.random.default_rng(0)
    u, push = random_excitations(3, 100, rng), rng.normal(size=(3, 100, 2))
    apart, together = (allocate_trajectory(u, np.radians([0, 90]), 0, u[:, 0]) for _ in range(2))
    world = 1.5, [[0, 0.2], [-0.2, 0]], push, [[0, 5], [-5, 0]]
    step_trajectory(u, apart, range(100), *world)
    monkeypatch.setattr("vmc_lib.arm.engines.AVAILABLE", False)  # no numba, as in the page
    step_trajectory(u, together, range(100), *world)
    for one, other in zip(apart, together, strict=True):
        np.testing.assert_allclose(one, other, atol=1e-12)


def test_hand_forces_act_through_the_jacobian():
    """A push, and a drag that grows with the hand's velocity, held against a numeric Jacobian."""
    rng = np.random.default_rng(4)
    u, push = random_excitations(3, 300, rng), rng.normal(scale=10, size=(3, 300, 2))
    drag, path = rng.normal(scale=5, size=(2, 2)), allocate_trajectory(u, START, 0, u[:, 0])
    step_trajectory(u, path, range(100), push=push, drag=drag)
    step_trajectory(u, path, range(100, 300), push=push, drag=drag)
    for t in (0, 50, 99, 100, 299):
        q, velocity, activation = (x[:, t] for x in path)
        there, back = (hand(q[:, None] + side * np.eye(2))[..., :2] for side in (1e-6, -1e-6))
        slopes = (there - back) / 2e-6  # (arms, joints, 2)
        force = push[:, t] + (velocity[:, None] @ slopes)[:, 0] @ drag.T
        torque = (slopes @ force[..., None])[..., 0] + stop_torque(q, velocity)
        torque += muscle_torque(activation, *paths(q), velocity)
        change = (path[1][:, t + 1] - velocity) / STEP
        np.testing.assert_allclose(change, forward_dynamics(q, velocity, torque), rtol=1e-5)


def test_movement_with_thelen_muscles_is_near_opensim():
    """Its tendons are stiff, not rigid, and its long biceps runs elsewhere by half a millimetre."""
    levels, expected = (arrays("opensim")[name] for name in ("levels", "rigid"))
    start = np.radians([0, 60])
    thelen, paper = (
        simulate(constant_excitation(levels, 0.6), start, muscle=LAWS[m]).q[:, 10::10]
        for m in ("Thelen 2003", "the paper (Eq. 9–11)")
    )
    assert np.abs(thelen - expected).max() < 0.012
    assert np.abs(paper - expected).max() > 0.05


def test_smaller_steps_converge_in_both_engines():
    levels = np.repeat([[0.05, 0.1]], 3)
    coarse, fine, finer = (
        simulate(constant_excitation(levels, 0.3, s), START, engine="mujoco", step=s).q[-1]
        for s in (1e-3, 1e-4, 5e-5)
    )
    fast = simulate(constant_excitation(levels, 0.3, 1e-4), START, step=1e-4).q[-1]
    assert np.abs(fine - finer).max() < 0.15 * np.abs(coarse - finer).max()
    assert np.abs(coarse - finer).max() < 2e-3
    np.testing.assert_allclose(fast, fine, atol=1e-6)


def test_simulating_a_batch_equals_one_by_one():
    excitations = random_excitations(6, 200, np.random.default_rng(1))
    batch = simulate(excitations.reshape(2, 3, 200, 6), START)
    assert batch.hand.shape == (2, 3, 201, 3)
    alone = simulate(excitations[4], START)
    np.testing.assert_allclose(batch.q[1, 1], alone.q, atol=1e-12)
    np.testing.assert_allclose(batch.endpoint[1, 1], alone.hand[-1, :2], atol=1e-12)


def test_joint_stops_limit_the_angles():
    everything = np.eye(6).repeat(1500, axis=0).reshape(6, 1500, 6)
    motion = simulate(everything, START, np.zeros(6))
    assert np.all(motion.q > LIMITS[:, 0] - 0.35)
    assert np.all(motion.q < LIMITS[:, 1] + 0.35)


@pytest.mark.parametrize(
    ("excitations", "complaint"),
    [
        (QUIET + 1.1, "clip"),
        (QUIET - 0.1, "clip"),
        (QUIET * np.nan, "clip"),
        (QUIET[:, :5], "shape"),
        (QUIET[:0], "shape"),
        (QUIET[0], "shape"),
    ],
)
def test_wrong_excitations_are_refused(excitations, complaint):
    with pytest.raises(ValueError, match=complaint):
        simulate(excitations, START)


def test_constant_excitation_has_the_duration():
    levels = np.arange(12).reshape(2, 6) / 12
    excitations = constant_excitation(levels, 0.05)
    assert excitations.shape == (2, 50, 6)
    np.testing.assert_array_equal(excitations[:, 31], levels)


@pytest.mark.parametrize("duration", [-0.5, 0, 1e-4, np.nan, np.inf])
def test_wrong_durations_are_refused(duration):
    with pytest.raises(ValueError, match="at least"):
        constant_excitation(np.zeros(6), duration)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(
    ("named", "complaint"),
    [
        ({"start": np.zeros(3)}, r"start .* shape \(3,\)"),
        ({"start": (30.0, 60.0)}, r"start \[30. 60.\] rad .* np.radians"),
        ({"start": START + np.array([0, 2])}, "beyond the joints' limits"),
        ({"activation": np.full(6, np.inf)}, "activation must be finite"),
        ({"activation": np.full(6, -5.0)}, r"activation: values in \[-5, 0\]; clip"),
        ({"activation": np.full(6, 1.5)}, r"activation: .*\[0, 1\]"),
        ({"perturbation": Perturbation(load=-1)}, "cannot be held"),
        ({"perturbation": Perturbation(field=3.0)}, r"field 3.0 must be a finite \(2, 2\)"),
        ({"perturbation": Perturbation(field=((0, np.nan), (0, 0)))}, "field"),
    ],
)
def test_both_engines_refuse_wrong_inputs(engine, named, complaint):
    with pytest.raises(ValueError, match=complaint):
        simulate(QUIET, **{"start": START, "engine": engine} | named)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("strength", [60.0, 1e4])
def test_both_engines_refuse_movements_that_blow_up(engine, strength, tmp_path, monkeypatch):
    """Without a word in the reader's folder."""
    monkeypatch.chdir(tmp_path)
    world = Perturbation(field=strength * np.eye(2))
    with pytest.raises(ValueError, match=r"movement 0 blows up: at step .*weaken"):
        simulate(np.full((300, 6), 0.2), START, engine=engine, perturbation=world)
    assert not [*tmp_path.iterdir()]


def test_a_wrong_argument_does_not_slow_down_later_calls():
    simulate(QUIET, START)
    with warnings.catch_warnings(action="error"):
        with pytest.raises(ValueError, match="field"):
            simulate(QUIET, START, perturbation=Perturbation(field=3.0))
        simulate(QUIET, START)


@pytest.mark.parametrize("step", [0, -0.001, 0.1, np.nan])
def test_unstable_steps_are_refused(step):
    with pytest.raises(ValueError, match=r"Euler's method needs one in \(0, 0.01\] s"):
        simulate(QUIET, START, step=step)


def test_engines_that_cannot_be_used_are_named():
    with pytest.raises(ValueError, match="compiled"):
        simulate(QUIET, START, engine="opensim")
    with pytest.raises(ValueError, match="leave the engine out"):
        simulate(QUIET, START, engine="compiled", muscle=LAWS["MuJoCo"])
