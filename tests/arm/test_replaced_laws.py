"""Replacing a constant or a law of the muscle changes every engine and all that uses it."""

import numpy as np
import pytest

from vmc_lib.arm import engines, model, muscle, simulate
from vmc_lib.motor import feedback
from vmc_lib.motor.inverse_dynamics import muscle_gain

START = np.radians([-20.0, 95.0])
WILD = np.repeat(np.random.default_rng(0).random((2, 3, 6)), 50, axis=1)


def feeble(activation, length, velocity, maximum):
    return 0.3 * maximum * activation * (1 + 0 * length * velocity)


def slow(excitation, activation):
    return 9.0 * (excitation - activation)


def scalar(excitation, activation, fall=0.05):  # as chapter 7 writes it, for numbers alone
    if excitation < activation:
        return (excitation - activation) / fall
    return (excitation - activation) / 0.02


def run(engine):
    return simulate.simulate(WILD, START, engine=engine)


@pytest.mark.parametrize(
    ("name", "other"),
    [
        ("TAU_ACTIVATION", 0.05),
        ("TAU_DEACTIVATION", 0.2),
        ("MAX_VELOCITY", 10.0),
        ("VELOCITY_RANGE", (-0.1, 0.1)),
        ("activation_rate", slow),
        ("force", feeble),
        ("force_length", lambda length: 0.2 + 0 * length),
    ],
)
def test_replaced_constants_and_laws_change_every_engine(monkeypatch, name, other):
    before = run("compiled").q
    monkeypatch.setattr(muscle, name, other)
    after, reference = run("compiled"), run("mujoco")
    assert np.abs(after.q - before).max() > 1e-3
    assert np.abs(after.q - reference.q).max() < 1e-6
    np.testing.assert_allclose(after.activation, reference.activation, atol=1e-12)
    monkeypatch.undo()
    np.testing.assert_array_equal(run("compiled").q, before)


def test_arm_constants_cannot_be_changed_in_place():
    """Compiled loops freeze them: whoever wants other ones sets another array."""
    for array in (model.F0, model.L0, model.SLACK, model.LIMITS, model.DAMPING):
        with pytest.raises(ValueError, match="read-only"):
            array *= 2


def test_a_scalar_law_is_compiled(monkeypatch):
    before = run("compiled").activation
    monkeypatch.setattr(muscle, "activation_rate", scalar)
    assert np.abs(run("compiled").activation - before).max() > 0.1


def test_law_that_numba_cannot_compile_warns(monkeypatch):
    gains = {}  # what a compiled loop cannot read
    monkeypatch.setattr(muscle, "activation_rate", lambda u, a: gains.get("gain", 9.0) * (u - a))
    few = WILD[:1, :20]
    with pytest.warns(UserWarning, match="runs as plain Python"):
        odd = simulate.simulate(few, START)
    monkeypatch.setattr(muscle, "activation_rate", slow)
    np.testing.assert_allclose(odd.q, simulate.simulate(few, START).q, atol=1e-12)


@pytest.mark.parametrize("engine", ["compiled", "mujoco"])
def test_a_law_that_gives_no_number_is_an_error(monkeypatch, engine):
    monkeypatch.setattr(muscle, "passive_force", lambda length: np.nan * length)
    with pytest.raises(ValueError, match="blows up: at step 1 a joint is at nan rad"):
        run(engine)


def test_compiled_step_equals_plain_python(monkeypatch):
    fast = run("compiled")
    monkeypatch.setattr(engines, "_step", engines._step.__wrapped__)
    plain = run("compiled")
    for ours, theirs in zip(vars(fast).values(), vars(plain).values(), strict=True):
        np.testing.assert_allclose(ours, theirs, atol=1e-12)


def test_replaced_laws_change_inverse_dynamics_and_feedback(monkeypatch):
    still = np.zeros((1, 2))
    path = feedback.ReferenceTrajectory(np.tile(START, (1, 101, 1)), WILD[:1, :100])
    before = (
        muscle_gain(START + still, still)[1],
        feedback.simulate_feedback(path, feedback.OPEN_LOOP),
    )
    monkeypatch.setattr(muscle, "force", feeble)
    monkeypatch.setattr(muscle, "activation_rate", slow)
    after = (
        muscle_gain(START + still, still)[1],
        feedback.simulate_feedback(path, feedback.OPEN_LOOP),
    )
    assert np.abs(after[0] - before[0]).max() > 0.1
    expected = simulate.simulate(path.excitations, START)
    np.testing.assert_allclose(after[1].q, expected.q, atol=1e-9)
    assert np.abs(after[1].q - before[1].q).max() > 1e-3
