"""A movement that is watched: a plan, corrected on its way by senses that are late.

The plan's excitations run as before. Two loops add to them. The *stretch reflex* excites every
muscle that is longer, or lengthens faster, than was meant; it takes 30 ms, through the spinal cord.
*Sight* compares where the arm is with where it should be and asks for an acceleration; it takes
four times as long. Late sight shakes the arm, unless a *forward model* foresees, from the commands
sent since, where the arm must be by now: a Smith predictor.

All movements of a batch begin at rest in `START`.
"""

from typing import NamedTuple

import numpy as np

from vmc_lib.arm.dynamics import paths, torque_for
from vmc_lib.arm.kinematics import inverse_kinematics
from vmc_lib.arm.model import STEP
from vmc_lib.arm.muscle import noisy
from vmc_lib.arm.simulate import UNDRAGGED, Motion, advance, begun, fibres
from vmc_lib.motor.inverse_dynamics import SAMPLES, minimum_jerk, muscle_gain, smooth
from vmc_lib.motor.templates import START

TICK = 10  # steps: sight corrects, and the model foresees, a hundred times a second


class Senses(NamedTuple):
    """How strongly, and how late, the arm corrects itself; what sets no gain has none."""

    gain: float = 30.0  # 1/s²: acceleration asked for, for each rad that the arm is off …
    damping: float = 0.25  # s: … and this times as much for each rad/s
    delay: float = 0.12  # s: from the eye to the muscle
    stretch: float = 1.0  # excitation for each optimal fibre length that a muscle is too long …
    rate: float = 0.1  # … and for each 2.5 lengths a second that it lengthens too fast
    spinal: float = 0.03  # s: the stretch reflex's delay


SIGHT = Senses()
BLIND = Senses(gain=0.0, stretch=0.0, rate=0.0)  # the plan alone, as in the chapters before


class Intention(NamedTuple):
    """What is meant, for a batch of B movements."""

    q: np.ndarray  # (B, T + 1, 2), rad: where the joints should be at every step
    excitations: np.ndarray  # (B, T, 6): what the plan tells the muscles

    @property
    def velocity(self):
        """How fast the joints should turn, (B, T + 1, 2), rad/s."""
        return np.gradient(self.q, STEP, axis=1)


def intend(plan, seconds=2.0):
    """The `Intention` of a batch of plans: the smoothest way to their targets, and a hold there.

    ValueError when it is shorter than the plan itself, or there is no batch.
    """
    if plan.target.ndim != 2:
        raise ValueError(f"a plan for {plan.target} is no batch; plan for targets (B, 2)")
    more = round(seconds / STEP) - SAMPLES
    if more < 0:
        raise ValueError(f"{seconds} s is too short for a reach; give 1 s or more")
    q = minimum_jerk(START, inverse_kinematics(plan.target), SAMPLES + more)
    held = np.pad(plan.excitations, ((0, 0), (0, more), (0, 0)), mode="edge")
    return Intention(q, held)


def switch(first, second, at):
    """The first intention until `at` s, then smoothly the second, after another 0.4 s."""
    share = smooth((np.arange(first.q.shape[1]) * STEP - at) / 0.4)[:, None]
    q = first.q + share * (second.q - first.q)
    return Intention(q, first.excitations + share[:-1] * (second.excitations - first.excitations))


def move(intention, senses=SIGHT, model=None, world=None, noise=0.0, rng=None):
    """The `Motion` of the arm when it means this `Intention`, (B, T + 1, …).

    `model(q, velocity, activation)`, the accelerations (B, 2) that it expects, is the forward
    model; without one, late sight is taken for the present. The `world` is a `World`. `noise` is
    the share of `muscle.noisy`, drawn from `rng`. ValueError when there is noise but no `rng`, or a
    delay is not a whole number of ticks, for the reflex one or more.
    """
    if noise and rng is None:
        raise ValueError(f"noise of {noise} needs an rng; give np.random.default_rng(seed)")
    late, spinal = _steps(senses.delay), _steps(senses.spinal, least=TICK)
    meant, meant_velocity, told = intention.q, intention.velocity, intention.excitations
    lengths, rates = fibres(*paths(meant), meant_velocity)
    u, path = np.empty(told.shape), begun(told, meant[:, 0], 0, told[:, 0])
    q, velocity, activation = path
    world = world or World()
    times = STEP * np.arange(told.shape[1])[:, None, None]
    pushes = world(times, np.zeros((len(times), len(told), 2)))  # on a hand at rest
    push = np.ascontiguousarray(np.swapaxes(pushes, 0, 1))
    for k in range(0, len(times), TICK):
        seen, tick = max(k - late, 0), np.arange(k, min(k + TICK, len(times)))
        sent = np.swapaxes(activation[:, seen:k:TICK], 0, 1)
        here = foresee(model, q[:, seen], velocity[:, seen], sent)
        wish = ask(senses, meant[:, k], meant_velocity[:, k], *here)
        sight = accelerate(*here, wish, told[:, k]) - told[:, k]
        felt = np.maximum(tick - spinal, 0)
        reflex = _reflex(senses, q[:, felt], velocity[:, felt], lengths[:, felt], rates[:, felt])
        now = np.clip(np.swapaxes(told[:, tick] + sight[:, None] + reflex, 0, 1), 0, 1)
        u[:, tick] = np.swapaxes(noisy(now, noise, rng) if noise else now, 0, 1)
        advance(u, path, tick, push=push, drag=world.drag)
    return Motion(*path)


def foresee(model, q, velocity, activations):
    """Where an arm is now that was seen at q (B, 2), at this velocity, some ticks ago.

    From there the model replays the muscles' activations (ticks, B, 6) since.
    """
    for activation in activations if model else ():
        velocity = velocity + TICK * STEP * model(q, velocity, activation)
        q = q + TICK * STEP * velocity
    return q, velocity


def ask(senses, meant_q, meant_velocity, q, velocity):
    """The acceleration (…, 2) in rad/s² that sight asks for: a damped spring to what is meant."""
    return senses.gain * (meant_q - q + senses.damping * (meant_velocity - velocity))


def accelerate(q, velocity, acceleration, excitations):
    """Excitations (…, 6) changed so that muscles add this acceleration (…, 2), where they can.

    Muscles cannot push: what one could not give is asked of the others, twice.
    """
    still = torque_for(q, velocity, np.zeros_like(acceleration))
    torque = torque_for(q, velocity, acceleration) - still
    gain = muscle_gain(q, velocity)[1]
    share, u = np.linalg.pinv(gain), excitations
    for _ in range(3):
        missing = torque - (gain @ (u - excitations)[..., None])[..., 0]
        u = np.clip(u + (share @ missing[..., None])[..., 0], 0, 1)
    return u


class World(NamedTuple):
    """What pushes the hand in its plane: a drag that grows with its velocity, and a short push."""

    drag: np.ndarray = UNDRAGGED  # (2, 2), N for each m/s
    force: np.ndarray | float = 0.0  # (2,) or (B, 2), N, from …
    at: np.ndarray | float = 0.0  # … this time on, one or (B, 1), s, for 50 ms

    def __call__(self, time, velocity):
        """The force (…, 2) in N on hands that move at this velocity (…, 2) in m/s."""
        pushed = (self.at <= time) & (time < self.at + 0.05)
        return velocity @ np.transpose(self.drag) + self.force * pushed


def curl(strength):
    """A world that pushes a moving hand aside, clockwise of its way: N for each m/s."""
    return World(drag=strength * np.array([[0.0, 1.0], [-1.0, 0.0]]))


def push(force, at):
    """A world that pushes the hand once, by `force` (2,) in N, from `at` s on, for 50 ms.

    Each of a batch may have its own: forces (B, 2), and times (B, 1).
    """
    return World(force=np.array(force), at=at)


def _reflex(senses, q, velocity, meant_length, meant_rate):
    """What the stretch reflex adds to the excitations, (B, 6)."""
    length, rate = fibres(*paths(q), velocity)
    return senses.stretch * (length - meant_length) + senses.rate * (rate - meant_rate)


def _steps(delay, least=0):
    steps = TICK * round(delay / (TICK * STEP))
    if steps < least or not np.isclose(steps * STEP, delay):
        unit, low = TICK * STEP, least * STEP
        raise ValueError(f"a delay of {delay} s: give a multiple of {unit:g} s, from {low:g} s on")
    return steps
