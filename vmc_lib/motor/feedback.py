"""Feedback control of a planned movement, with sensory delays: stretch reflex and visual feedback.

The plan's excitations run as before. Two loops add to them. The *stretch reflex* excites every
muscle that is longer, or lengthens faster, than the reference says; it takes 30 ms, through the
spinal cord. *Sight* compares where the arm is with where it should be and asks for an acceleration;
it takes four times as long. Late sight shakes the arm, unless a *forward model* predicts, from the
commands sent since, where the arm must be by now: a state predictor, akin to Smith's.

All movements of a batch begin at rest in `START`.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib.arm.dynamics import equation_12_torques, paths, terms
from vmc_lib.arm.engines import (
    NO_DRAG,
    activations,
    allocate_trajectory,
    fibres,
    step_trajectory,
)
from vmc_lib.arm.kinematics import inverse_kinematics
from vmc_lib.arm.model import STEP
from vmc_lib.arm.muscle import noisy
from vmc_lib.arm.simulate import Motion, check_sane
from vmc_lib.checks import as_numbers, check_function, check_kind, is_within
from vmc_lib.motor.inverse_dynamics import SAMPLES, minimum_jerk, minimum_jerk_profile, muscle_gain
from vmc_lib.motor.planning import Plan, check_batch
from vmc_lib.motor.templates import START
from vmc_lib.short_repr import short

Model = Callable[..., np.ndarray]  # a forward model: q, velocity, activation → acceleration
TICK = 10  # steps: sight corrects, and the model predicts, a hundred times a second


def proportional_derivative(
    reference_q: np.ndarray,
    reference_velocity: np.ndarray,
    q: np.ndarray,
    velocity: np.ndarray,
    gain: float,
    damping: float,
) -> np.ndarray:
    """Proportional-derivative feedback toward the reference, (…, 2), rad/s²."""
    return gain * (reference_q - q + damping * (reference_velocity - velocity))


def predict_state(
    model: Model, q: np.ndarray, velocity: np.ndarray, activations: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Predict the present state from delayed feedback by a forward model.

    It replays the activations (ticks, B, 6) that follow, by Eq. 9, from the commands sent since the
    arm was at q (B, 2) with this velocity: an efference copy, without the motor noise.
    """
    for activation in activations:
        velocity = velocity + TICK * STEP * model(q, velocity, activation)
        q = q + TICK * STEP * velocity
    return q, velocity


class FeedbackGains(NamedTuple):
    """How strongly, and how late, the arm corrects itself."""

    gain: float = 30.0  # 1/s²: acceleration asked for, for each rad that the arm is off …
    damping: float = 0.25  # s: … and this times as much for each rad/s
    delay: float = 0.12  # s: from the eye to the muscle
    stretch: float = 0.5  # excitation for each optimal fibre length that a muscle is too long …
    rate: float = 0.05  # … and for each 2.5 lengths a second that it lengthens too fast
    spinal: float = 0.03  # s: the stretch reflex's delay
    law: Callable = proportional_derivative  # of sight
    predict: Callable = predict_state  # by the forward model


SIGHT = FeedbackGains()
REFLEX = SIGHT._replace(gain=0.0)  # the stretch reflex alone
OPEN_LOOP = REFLEX._replace(stretch=0.0, rate=0.0)  # the plan alone, as in the chapters before


class ReferenceTrajectory(NamedTuple):
    """Where the arm should be, and the commands for it, for a batch of B movements."""

    q: np.ndarray  # (B, T + 1, 2), rad
    excitations: np.ndarray  # (B, T, 6): the plan's

    @property
    def velocity(self) -> np.ndarray:
        """How fast the joints should turn, (B, T + 1, 2), rad/s."""
        return np.gradient(self.q, STEP, axis=1)


def reference_trajectory(plan: Plan, seconds: float = 2.0) -> ReferenceTrajectory:
    """The `ReferenceTrajectory` of a batch of plans: minimum jerk to the targets, and a hold there.

    ValueError when it is shorter than the plan itself, or there is no batch.
    """
    check_batch(plan)
    if not is_within(seconds, SAMPLES * STEP, np.inf):
        raise ValueError(f"{short(seconds)} s is too short for a reach; give 1 s or more")
    more = round(seconds / STEP) - SAMPLES
    q = minimum_jerk(START, inverse_kinematics(plan.target), SAMPLES + more)
    u = np.pad(plan.excitations, ((0, 0), (0, more), (0, 0)), mode="edge")
    return ReferenceTrajectory(q, u)


def switch(
    first: ReferenceTrajectory, second: ReferenceTrajectory, at: float
) -> ReferenceTrajectory:
    """The first reference until `at` s, then over 0.4 s, smoothly, to the second."""
    for reference in (first, second):
        check_kind("reference", reference, ReferenceTrajectory, "reference_trajectory(plan)")
    as_many = len(first.q) == len(second.q) or 1 in (len(first.q), len(second.q))
    alike = as_many and first.q.shape[1:] == second.q.shape[1:]
    if not (alike and np.isfinite(as_numbers("at", at)).all()):
        raise ValueError(
            f"from {first.q.shape} to {second.q.shape} at {short(at)} s: give two references of "
            "one length, for as many movements, and seconds"
        )
    share = minimum_jerk_profile((np.arange(first.q.shape[1]) * STEP - at) / 0.4)[:, None]
    q = first.q + share * (second.q - first.q)
    u = first.excitations + share[:-1] * (second.excitations - first.excitations)
    return ReferenceTrajectory(q, u)


def simulate_feedback(
    reference: ReferenceTrajectory,
    gains: FeedbackGains = SIGHT,
    model: Model | None = None,
    disturbance: "Disturbance | None" = None,
    noise: float = 0.0,
    rng: np.random.Generator | None = None,
    errors: ArrayLike = 0.0,
) -> Motion:
    """Simulate a batch of movements that feedback corrects on their way.

    Parameters
    ----------
    reference : ReferenceTrajectory
        What the B movements should be.
    gains : FeedbackGains
        How strongly, and how late, the arm corrects itself.
    model : callable, optional
        The forward model: accelerations (B, 2) in rad/s² from q, velocity and activation. Without
        one, late sight is taken for the present.
    disturbance : Disturbance, optional
        What pushes the hand.
    noise : float
        The share of `muscle.noisy`. The forward model knows the commands, not their noise.
    rng : numpy.random.Generator, optional
        Draws the noise.
    errors : array
        Of what the eye reports, to be broadcast to (ticks, B, 4): of q in rad, of velocity in
        rad/s.

    Returns
    -------
    Motion
        Trajectories (B, T + 1, …).

    Raises
    ------
    ValueError
        When there is noise but no `rng`; a delay is not a whole number of ticks, for the reflex one
        or more; a gain, the noise, an error or the disturbance is not finite; or a movement blows
        up.

    References
    ----------
    Miall, R. C. et al. (1993). Is the cerebellum a Smith predictor? J. Motor Behavior 25:203.

    Examples
    --------
    >>> from vmc_lib.motor.planning import plan
    >>> from vmc_lib.motor.templates import load
    >>> reference = reference_trajectory(plan(np.array([[0.15, -0.4]]), load()), seconds=1.0)
    >>> simulate_feedback(reference).q.shape
    (1, 1001, 2)
    """
    check_kind("reference", reference, ReferenceTrajectory, "reference_trajectory(plan)")
    _check_senses(gains, model, noise, rng)
    late, spinal = _steps(gains.delay), _steps(gains.spinal, least=TICK)
    target, target_velocity, planned = reference.q, reference.velocity, reference.excitations
    lengths, rates = fibres(*paths(target), target_velocity)
    u, path = np.empty(planned.shape), allocate_trajectory(planned, target[:, 0], 0, planned[:, 0])
    q, velocity, activation = path
    commanded = activation.copy() if noise else activation  # efference copy: without the noise
    disturbance = Disturbance() if disturbance is None else disturbance
    push = _push_over_time(disturbance, *planned.shape[:2])
    steps = planned.shape[1]
    ticks = range(0, steps, TICK)
    for k, off in zip(ticks, _sight_errors(errors, len(ticks), len(planned)), strict=True):
        seen, tick = max(k - late, 0), np.arange(k, min(k + TICK, steps))
        sent = np.swapaxes(commanded[:, seen:k:TICK], 0, 1)
        here = q[:, seen] + off[:, :2], velocity[:, seen] + off[:, 2:]
        here = gains.predict(model, *here, sent) if model else here
        wanted = feedback_acceleration(gains, target[:, k], target_velocity[:, k], *here)
        sight = excitations_for_acceleration(*here, wanted, planned[:, k]) - planned[:, k]
        felt = np.maximum(tick - spinal, 0)
        reflex = _reflex(gains, q[:, felt], velocity[:, felt], lengths[:, felt], rates[:, felt])
        now = np.clip(np.swapaxes(planned[:, tick] + sight[:, None] + reflex, 0, 1), 0, 1)
        u[:, tick] = np.swapaxes(noisy(now, noise, rng) if rng is not None and noise else now, 0, 1)
        if noise:
            after = slice(k, tick[-1] + 2)
            commanded[:, after] = activations(np.swapaxes(now, 0, 1), commanded[:, k])
        step_trajectory(u, path, tick, push=push, drag=disturbance.drag)
        check_sane(q[:, tick + 1], first=tick[0] + 1)  # or the next tick is of what blew up
    return Motion(*path)


def _check_senses(gains, model, noise, rng):
    """Raise ValueError for gains, a model or noise with which nobody can move."""
    check_kind("gains", gains, FeedbackGains, "SIGHT, or SIGHT._replace(gain=30.0)")
    if not (model is None or callable(model)):
        raise ValueError(
            f"model {short(model)} predicts nothing: give a ForwardModel, or arm_copy()"
        )
    if not is_within(noise, 0, np.inf):
        raise ValueError(f"noise of {short(noise)} times the signal: give a number, 0 or more")
    if noise and rng is None:
        raise ValueError(f"noise of {noise} needs an rng; give np.random.default_rng(seed)")
    for name, each in zip(gains._fields[-2:], gains[-2:], strict=True):
        check_function(f"gains' {name}", each, "one of the arguments of SIGHT's")
    delays = all(is_within(each, -np.inf, np.inf) for each in (gains.delay, gains.spinal))
    if not (delays and all(np.isfinite(as_numbers("gains", each)).all() for each in gains[:-2])):
        raise ValueError(f"{gains} with noise of {noise}: give finite numbers")


def feedback_acceleration(
    gains: FeedbackGains,
    reference_q: np.ndarray,
    reference_velocity: np.ndarray,
    q: np.ndarray,
    velocity: np.ndarray,
) -> np.ndarray:
    """The acceleration (…, 2) that sight asks for, by its law, rad/s²."""
    return gains.law(reference_q, reference_velocity, q, velocity, gains.gain, gains.damping)


def excitations_for_acceleration(
    q: np.ndarray, velocity: np.ndarray, acceleration: np.ndarray, excitations: np.ndarray
) -> np.ndarray:
    """Excitations (…, 6) changed so that muscles add this acceleration (…, 2), where they can.

    The minimum-norm change, by the pseudo-inverse. Muscles cannot push: what clipping to [0, 1]
    takes from one is asked of the others, twice.
    """
    now = terms(q)
    still = equation_12_torques(now, *velocity.T, 0, 0, STEP)
    torque = equation_12_torques(now, *velocity.T, *acceleration.T, STEP)
    torque = np.subtract(torque, still).T
    gain = muscle_gain(q, velocity)[1]
    share, u = np.linalg.pinv(gain), excitations
    for _ in range(3):
        missing = torque - (gain @ (u - excitations)[..., None])[..., 0]
        u = np.clip(u + (share @ missing[..., None])[..., 0], 0, 1)
    return u


class Disturbance(NamedTuple):
    """What pushes the hand in its plane: a drag that grows with its velocity, and a short push."""

    drag: np.ndarray = NO_DRAG  # (2, 2), N for each m/s
    force: np.ndarray | float = 0.0  # (2,) or (B, 2), N, from …
    at: np.ndarray | float = 0.0  # … this time on, one or (B, 1), s, for 50 ms

    def __call__(self, time: np.ndarray, velocity: np.ndarray) -> np.ndarray:
        """The force (…, 2) in N on hands that move at this velocity (…, 2) in m/s."""
        pushed = (self.at <= time) & (time < self.at + 0.05)
        return velocity @ np.transpose(self.drag) + self.force * pushed


def curl(strength: float) -> Disturbance:
    """A curl field: it pushes a moving hand aside, clockwise, by `strength` N for each m/s."""
    strength = as_numbers("strength", strength)
    if not is_within(strength[()], -np.inf, np.inf):
        raise ValueError(f"a curl of {short(strength)} N s / m: give one number, a finite one")
    return Disturbance(drag=strength * np.array([[0.0, 1.0], [-1.0, 0.0]]))


def push(force: ArrayLike, at: float | np.ndarray) -> Disturbance:
    """A push of the hand by `force` (2,) in N, from `at` s on, for 50 ms.

    Each of a batch may have its own: forces (B, 2), and times (B, 1).
    """
    force, at = as_numbers("force", force), as_numbers("at", at)
    if force.shape[-1:] != (2,):
        raise ValueError(f"a force {force} N: give (forward, up), in the arm's plane")
    if not (np.isfinite(force).all() and np.all((at >= 0) & (at < np.inf))):
        raise ValueError(
            f"a push of {short(force)} N at {short(at)} s: give finite numbers, 0 s or later"
        )
    return Disturbance(force=force, at=at[()])


def _push_over_time(disturbance, batch, steps):
    """What a disturbance pushes a hand at rest with, (batch, steps, 2), N.

    ValueError for one that is not for so many movements, or not finite.
    """
    check_kind("disturbance", disturbance, Disturbance, "curl(strength), or push(force, at)")
    drag = as_numbers("drag", disturbance.drag)
    if drag.shape != (2, 2) or not np.isfinite(drag).all():
        raise ValueError(f"drag {disturbance.drag} must be a finite (2, 2) matrix in N s / m")
    _check_push(disturbance, batch)
    times = STEP * np.arange(steps)[:, None, None]
    pushes = disturbance(times, np.zeros((steps, batch, 2)))
    if not np.isfinite(pushes).all():
        raise ValueError(f"a push of {disturbance.force} N at {disturbance.at} s must be finite")
    return np.ascontiguousarray(np.swapaxes(pushes, 0, 1))


def _check_push(disturbance, batch):
    """Raise ValueError where a push is not for so many movements."""
    force, at = as_numbers("force", disturbance.force), as_numbers("at", disturbance.at)
    try:
        fits = np.broadcast_shapes(force.shape, at.shape, (batch, 2)) == (batch, 2)
    except ValueError:
        fits = False
    if not fits:
        raise ValueError(
            f"a push {force.shape} at {at.shape} of {batch} movements: give one for all, or "
            f"forces ({batch}, 2) and times ({batch}, 1)"
        )


def _sight_errors(errors, ticks, batch):
    """What the eye errs by at each tick, (ticks, batch, 4); ValueError where it cannot be so."""
    errors, shape = as_numbers("errors", errors), (ticks, batch, 4)
    try:
        each = np.broadcast_to(errors, shape)
    except ValueError:
        raise ValueError(f"errors {errors.shape}: give one number, or {shape}") from None
    if not np.isfinite(errors).all():
        raise ValueError("errors of what the eye reports: give finite numbers")
    return each


def _reflex(gains, q, velocity, reference_length, reference_rate):
    """What the stretch reflex adds to the excitations, (B, 6)."""
    length, rate = fibres(*paths(q), velocity)
    return gains.stretch * (length - reference_length) + gains.rate * (rate - reference_rate)


def _steps(delay, least=0):
    steps = TICK * round(delay / (TICK * STEP))
    if steps < least or not np.isclose(steps * STEP, delay):
        unit, low = TICK * STEP, least * STEP
        raise ValueError(f"a delay of {delay} s: give a multiple of {unit:g} s, from {low:g} s on")
    return steps
