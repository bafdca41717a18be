"""Questions on a muscle: its lag (Eq. 9) and its force (Eq. 10 and 11)."""

import numpy as np

from kit.bank.drawing import curves
from kit.question import choice, numeric, picture, steps
from vmc_lib.arm import muscle
from vmc_lib.arm.model import F0, L0, MUSCLES, SLACK

RISE, FALL = (1000 * tau for tau in (muscle.TAU_ACTIVATION, muscle.TAU_DEACTIVATION))
LAG = f"(Eq. 9, time constants {RISE:g} and {FALL:g} ms)"
EACH = range(len(MUSCLES))


@numeric("1/s", "(u - a)[u/τ_act + (1 - u)/τ_deact]")
def rate_of_rising(a=steps(0, 0.5, 0.05), more=steps(0.1, 0.5, 0.05)):
    """A muscle's activation is {a} and its excitation {u}. How fast does activation rise, per
    second {LAG}?"""
    u = round(a + more, 2)
    return muscle.activation_rate(u, a), {"u": u}


@numeric("1/s", "(u - a)/τ_deact")
def rate_of_falling(u=steps(0, 0.4, 0.05), more=steps(0.1, 0.5, 0.05)):
    """A muscle's activation is {a} and its excitation {u}. How fast does activation change, per
    second (negative: it falls) {LAG}?"""
    a = round(u + more, 2)
    return muscle.activation_rate(u, a), {"a": a}


@numeric(hint="Add the rate times the step, in seconds.", tolerance=0.002)
def one_step_of_euler(u=steps(0.6, 1, 0.1), a=steps(0.1, 0.5, 0.1), ms=(1, 2)):
    """Activation is {a}, excitation {u}. What is the activation {ms} ms later, by one step of
    Euler's method {LAG}?"""
    return a + ms / 1000 * muscle.activation_rate(u, a)


@numeric(hint="It falls exponentially: a exp(-t/τ_deact).", tolerance=0.002)
def silence(a=steps(0.3, 1, 0.1), ms=steps(10, 100, 10)):
    """A muscle at activation {a} is told nothing more. What is it {ms} ms later {LAG}?"""
    return a * np.exp(-ms / FALL)


@numeric(hint="What goes up while u = 1 comes down while u = 0.")
def flicker(on=steps(0.1, 0.9, 0.05)):
    """Excitation flickers very fast between 0 and 1 and is 1 for {on:.0%} of the time. To which
    value does activation settle {LAG}?"""
    return on / RISE / (on / RISE + (1 - on) / FALL)


@numeric(hint="Solve Eq. 9 for u: a quadratic while it rises.", tolerance=0.005)
def excitation_wanted(a=steps(0.1, 0.7, 0.1), rate=steps(1, 10, 1)):
    """Activation is {a} and must rise by {rate} per second. Which excitation does it {LAG}?"""
    return muscle.excitation_for(a, float(rate))


@numeric(hint="Solve Eq. 9 for u: linear while it falls.", tolerance=0.002)
def excitation_to_fall(a=steps(0.3, 0.9, 0.1), rate=steps(0.5, 5, 0.5)):
    """Activation is {a} and must fall by {rate} per second. Which excitation does it {LAG}?"""
    return muscle.excitation_for(a, -rate)


@numeric(hint="exp(-40 (l - 0.95)⁴ + (l - 0.95)²)", tolerance=0.002)
def force_of_length(length=steps(0.4, 1.6, 0.05)):
    """What is f1 (Eq. 11), the active force in units of F0, at {length} of the optimal length?"""
    return muscle.force_length(length)


@numeric(
    hint=f"v = speed / {muscle.MAX_VELOCITY}; 1.6 - 1.6 exp(-1.1/(1-v)⁴ + 0.1/(1-v)²)",
    tolerance=0.005,
)
def force_of_velocity(speed=steps(-5, 2, 0.25)):
    """A muscle changes its length by {speed} optimal lengths a second (positive: it lengthens).
    What is f2 (Eq. 11)?"""
    return muscle.force_velocity(speed / muscle.MAX_VELOCITY)


@numeric("N", "F0 (f1(l) f2(v) a + f3(l))")
def pull_of_a_muscle(
    k=EACH, a=steps(0.1, 1, 0.1), length=steps(0.7, 1.3, 0.05), v=steps(-0.8, 0.4, 0.1)
):
    """{name} (F0 = {strongest:.1f} N) has the activation {a}, the length l = {length} and the
    velocity v = {v}. How hard does it pull (Eq. 10)?"""
    return muscle.force(a, length, v, F0[k]), {"name": MUSCLES[k], "strongest": F0[k]}


@numeric(hint="(whole - tendon) / optimal fibre")
def length_of_a_fibre(k=EACH, length=steps(0.6, 1.3, 0.05)):
    """{name} is {whole_cm:.2f} cm long, its slack tendon {slack_cm:.2f} cm, its optimal fibre
    {optimal_cm:.2f} cm. What is its normalised length l?"""
    whole = round(float(SLACK[k] + L0[k] * length), 4)
    words = {"whole_cm": 100 * whole, "slack_cm": 100 * SLACK[k], "optimal_cm": 100 * L0[k]}
    return (whole - SLACK[k]) / L0[k], words | {"name": MUSCLES[k]}


@numeric(hint=f"In optimal lengths a second, over {muscle.MAX_VELOCITY}.")
def speed_of_a_fibre(k=EACH, speed=steps(-0.3, 0.3, 0.02, zero=0.1)):
    """{name} has an optimal fibre of {optimal_cm:.2f} cm and lengthens at {speed} m/s (negative: it
    shortens). What is v of Eq. 11, in the book's reading?"""
    return speed / L0[k] / muscle.MAX_VELOCITY, {"name": MUSCLES[k], "optimal_cm": 100 * L0[k]}


@choice(
    *(f"{{speeds[{k}]:+g}} l0/s" for k in range(3)),
    hint="f2 grows with v: a stretched muscle pulls harder, a shortening one less.",
)
def when_does_it_pull_hardest(
    speeds=lambda rng: np.sort(rng.choice(np.arange(-8, 4), 3, replace=False) / 4),
):
    """A fully active muscle of optimal length moves at one of three speeds (positive: it
    lengthens): {speeds[0]:+g} l0/s, {speeds[1]:+g} l0/s, {speeds[2]:+g} l0/s. At which one does it
    pull hardest?"""
    return np.argmax(muscle.force_velocity(speeds / muscle.MAX_VELOCITY))


LENGTHS = np.linspace(0.4, 1.6, 121)  # of the best length


def length_curve(axes, length):
    """The active force against the fibre's length, a bell that is highest near 1, with a mark on
    it at the length {length}."""
    curves(axes, LENGTHS, {"": muscle.force_length(LENGTHS)}, "length / best length", "force / F0")
    axes.plot(length, muscle.force_length(length), "ko")
    axes.set_yticks(np.arange(0, 1.1, 0.1))


@picture(length_curve)
@numeric("N", "Read the height at the mark; take that share of F0, and of it the activation.", 20)
def pull_at_the_mark(
    length=steps(0.6, 1.3, 0.05), a=(0.3, 0.4, 0.5, 0.6), strongest=(600, 800, 1000)
):
    """A still muscle (F0 = {strongest} N) has the length of the mark and the activation {a}. The
    curve is for full activation. How hard does its active part pull?"""
    return strongest * a * muscle.force_length(length)


TIMES = np.arange(0, 200.0)  # ms


def fall(tau):
    """Activation (200,) that nothing keeps up, from 1 on; τ in ms."""
    return np.exp(-TIMES / tau)


def one_fall(axes, tau):
    """Activation against time, from 1 at 0 ms, falling less and less steeply towards 0. After 20 ms
    it is {after:.2f}."""
    curves(axes, TIMES, {"": fall(tau)}, "time (ms)", "activation")
    axes.set(xticks=np.arange(0, 201, 20), yticks=np.arange(0, 1.1, 0.1))


@picture(one_fall)
@numeric("ms", "Where it is down to 1/e, 0.37, of its beginning.", tolerance=4)
def time_constant_of_a_fall(tau=steps(30, 90, 2)):
    """Excitation ended at 0 ms. What is the time constant of this muscle's fall?"""
    return tau, {"after": fall(tau)[20]}


def two_falls(axes, taus):
    """Activation of two muscles against time, both from 1 at 0 ms, falling towards 0 at different
    speeds. After 40 ms A has {after[0]:.2f}, B {after[1]:.2f}."""
    curves(axes, TIMES, dict(zip("AB", map(fall, taus), strict=True)), "time (ms)", "activation")


@picture(two_falls)
@choice("A", "B", hint="A fast flicker is smoothed most by the muscle that changes slowest.")
def which_smooths_more(
    taus=lambda rng: 10 * rng.permutation(np.arange(3, 10))[:2], pulses=(5, 8, 10, 12)
):
    """Excitation ended at 0 ms. Both muscles rise alike. Which one keeps the more even force when
    it gets {pulses} short pulses a second?"""
    return np.argmax(taus), {"after": [fall(tau)[40] for tau in taus]}
