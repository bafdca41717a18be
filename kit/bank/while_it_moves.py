"""Questions on feedback control: delays, reflexes, forces on the way, and two memories."""

import numpy as np

from kit.bank.drawing import curves
from kit.question import choice, count, numeric, picture, steps
from vmc_lib.cerebellum.two_rates import Rates, adapt
from vmc_lib.motor.feedback import FeedbackGains, curl, feedback_acceleration
from vmc_lib.motor.inverse_dynamics import minimum_jerk_profile

# Of the fast and the slow memory: retention A, learning rate B (Smith et al. 2006)
A_FAST, A_SLOW = (0.5, 0.6, 0.7), (0.98, 0.99)
B_FAST, B_SLOW = (0.2, 0.25), (0.02, 0.03, 0.05)


def memories(a_fast, a_slow, b_fast, b_slow, reach):
    """What the fast and the slow memory hold before a reach in a world that is off by 1, (2,)."""
    return adapt(np.ones(reach), Rates((a_fast, a_slow), (b_fast, b_slow)))[-1]


@numeric("cm", "Speed × delay.")
def moved_unseen(speed=steps(0.2, 1.5, 0.1), delay=steps(60, 250, 10)):
    """The hand moves at {speed} m/s, and sight is {delay} ms late. How far has the hand moved from
    where it is seen?"""
    return 100 * speed * delay / 1000


@numeric("rad/s²", "gain × (error + damping × error of velocity)", tolerance=0.02)
def wanted_acceleration(
    gain=steps(10, 60, 5),
    damping=(0.1, 0.2, 0.25, 0.4),
    off=steps(0.02, 0.2, 0.02),
    slow=steps(0.1, 1, 0.1),
):
    """Feedback has the gain {gain} 1/s² and the damping {damping} s. A joint is {off} rad short of
    where it should be and {slow} rad/s slower than it should be. Which
    acceleration does it ask for?"""
    return feedback_acceleration(FeedbackGains(gain=gain, damping=damping), off, slow, 0.0, 0.0)


@numeric("N", "Swap the velocity's parts and turn the sign of the second.", tolerance=0.02)
def force_of_a_curl_field(
    strength=steps(5, 20, 1),
    speed=steps(0.1, 1, 0.1),
    way=range(4),
    axis=("x", "y"),
):
    """A curl field of {strength} N for each m/s pushes the hand clockwise of its way, (b v_y, -b
    v_x). The hand moves at ({velocity[0]}, {velocity[1]}) m/s. What is the force along {axis}?"""
    velocity = ((speed, 0), (0, speed), (speed, speed), (-speed, speed))[way]
    force = curl(strength)(0.0, np.array(velocity))
    return force[int(axis == "y")], {"velocity": velocity}


@numeric("cm/s", "1.875 × way / time, at half of the time.")
def fastest_moment(way=steps(10, 40, 2), seconds=steps(0.4, 1, 0.1)):
    """A minimum-jerk movement covers {way} cm in {seconds} s. How fast is it at its fastest?"""
    times = np.linspace(0, 1, 2001)
    return way / seconds * np.gradient(minimum_jerk_profile(times), times).max()


@count("steps", "Delay over step.")
def samples_of_a_delay(delay=steps(60, 240, 20), tick=(5, 10, 20)):
    """Sight is {delay} ms late, and a forward model foresees every {tick} ms. How many of its steps
    must it replay to know where the arm is now?"""
    return delay // tick


@numeric("Hz", "One over the period.")
def period_of_a_tremor(delay=steps(80, 240, 20), times=(4, 5, 6)):
    """Suppose that a loop swings with a period of {times} delays; its sight is {delay} ms late.
    What is the tremor's frequency?"""
    return 1000 / (times * delay)


@numeric(hint="held = kept × held + learned × error, and error = 1 - what both hold")
def two_memories(a_fast=A_FAST, a_slow=A_SLOW, b_fast=B_FAST, b_slow=B_SLOW, reach=(2, 3)):
    """A fast memory keeps {a_fast} and learns {b_fast} of the error, a slow one keeps {a_slow} and
    learns {b_slow}. Both begin at 0, and the world is off by 1 from the first reach on. What do
    they hold together before reach {reach}?"""
    return memories(a_fast, a_slow, b_fast, b_slow, reach).sum()


@choice(
    "the fast one",
    "the slow one",
    hint="Early the fast one, which forgets; later the slow one has caught up.",
)
def which_memory_holds_more(
    a_fast=A_FAST, a_slow=A_SLOW, b_fast=B_FAST, b_slow=B_SLOW, reach=(2, 5, 40, 100)
):
    """A fast memory keeps {a_fast} and learns {b_fast} of the error, a slow one keeps {a_slow} and
    learns {b_slow}. The world is off by 1 from the first reach on. Which of them holds more before
    reach {reach}?"""
    return memories(a_fast, a_slow, b_fast, b_slow, reach).argmax()


@numeric(hint="kept to the power of the reaches", tolerance=0.003)
def forgetting(retention=(0.6, 0.8, 0.9, 0.95, 0.99), reaches=(2, 5, 10, 20)):
    """A memory keeps {retention} of what it holds from reach to reach and sees no error. What share
    is left after {reaches} reaches?"""
    return retention**reaches


def held_states(a_fast, a_slow, b_fast, b_slow):
    """What the fast and the slow memory hold in 30 reaches in a world that is off by 1, (2, 30)."""
    return adapt(np.ones(30), Rates((a_fast, a_slow), (b_fast, b_slow))).T


def two_states(axes, a_fast, a_slow, b_fast, b_slow, swap):
    """What two memories hold, against the reach. In the tenth A holds {tenth[0]:.2f} and B
    {tenth[1]:.2f}, in the last A {last[0]:.2f} and B {last[1]:.2f}."""
    a, b = held_states(a_fast, a_slow, b_fast, b_slow)[[swap, 1 - swap]]
    curves(axes, range(1, 31), {"A": a, "B": b}, "reach", "held")


@picture(two_states)
@choice("A", "B", hint="The fast one leads at first, and gives way as the other takes over.")
def which_memory_is_fast(a_fast=A_FAST, a_slow=A_SLOW, b_fast=B_FAST, b_slow=B_SLOW, swap=(0, 1)):
    """A world is off by 1 in all 30 reaches, and two memories learn from the same errors. After the
    last reach comes a pause in which much is forgotten. Which memory forgets most of what it
    holds?"""
    states = held_states(a_fast, a_slow, b_fast, b_slow)[[swap, 1 - swap]]
    return swap, {"tenth": states[:, 9], "last": states[:, -1]}


SECONDS = np.linspace(0, 1, 201)


def seen_and_true(axes, way, delay):
    """The hand's way in cm against time, from 0 to {way} cm in 0.6 s, and the same as it is seen,
    later by a constant time. The hand is half way at 300 ms, what is seen {half} ms."""
    true = way * minimum_jerk_profile(np.clip(SECONDS / 0.6, 0, 1))
    late = way * minimum_jerk_profile(np.clip((SECONDS - delay / 1000) / 0.6, 0, 1))
    curves(axes, 1000 * SECONDS, {"hand": true, "seen": late}, "time (ms)", "way (cm)")
    axes.set_xticks(np.arange(0, 1001, 100))


@picture(seen_and_true)
@numeric("ms", "The way along the time axis from one curve to the other.", tolerance=15)
def delay_of_sight(way=(10, 20, 30, 40), delay=steps(160, 300, 20)):
    """The way of a hand, and the same as it is seen. How late is sight?"""
    return delay, {"half": f"at {300 + delay:g}"}


STARTS = (35, 45, 80, 90, 140, 160)  # ms after a push


def after_a_push(axes, start, reflex, sight):
    """How far a push at 0 ms takes a hand off its way, in mm, against time: it rises evenly, and
    from {start} ms on less and less. Dashed lines: the delay of the reflex, {reflex} ms, and of
    sight, {sight} ms."""
    times = np.arange(0, 181)
    off = times / 10 - np.clip(times - start, 0, None) ** 2 / 1500
    curves(axes, times, {"": off}, "time after the push (ms)", "off its way (mm)")
    axes.plot(start, start / 10, "ko")
    for name, delay in {"reflex": reflex, "sight": sight}.items():
        axes.axvline(delay, color="C1", ls="--")
        axes.annotate(name, (delay, 0), (3, 0), textcoords="offset points")
    axes.set_xticks(np.arange(0, 181, 20))


@picture(after_a_push)
@choice(
    "the tissue's own stiffness alone",
    "that, or the reflex; not sight",
    "any of the three",
    hint="What is late cannot have begun it: a cause does not come after its effect.",
)
def what_slowed_it(start=STARTS, reflex=(55, 60, 65), sight=(110, 120, 130)):
    """A hand is pushed. From the dot on it is slowed down; the dashed lines say how late the reflex
    and sight are. Which of muscle stiffness, reflex and sight can have begun it?"""
    return int(start >= reflex) + int(start >= sight)


def guided_recoveries(learned, opposite, order):
    """What is held in 20 guided reaches after a world and its opposite: by two memories, by one
    that forgets, and by none: (3, 20)."""
    world = np.concatenate([np.ones(learned), -np.ones(opposite), np.full(20, np.nan)])
    both = adapt(world).sum(axis=1)[-20:]
    return np.array([both, both[0] * 0.8 ** np.arange(20), np.zeros(20)])[order]


def recoveries(axes, learned, opposite, order):
    """What is held in 20 guided reaches, three curves. {said}."""
    named = dict(zip("ABC", guided_recoveries(learned, opposite, order), strict=True))
    curves(axes, range(1, 21), named, "guided reach", "held")
    axes.set_xticks(range(2, 21, 2))


@picture(recoveries)
@choice("A", "B", "C", hint="The fast memory forgets the opposite; the slow one answers the first.")
def which_needs_two_memories(
    learned=steps(40, 120, 5), opposite=(4, 5, 6), order=lambda rng: rng.permutation(3)
):
    """A hand learns a world in {learned} reaches, the opposite one in {opposite}, and is then
    guided straight, without errors. Which result cannot come from one memory that only forgets?"""
    ends = guided_recoveries(learned, opposite, order)[:, [0, -1]]
    said = (f"{n} goes from {a:.2f} to {b:.2f}" for n, (a, b) in zip("ABC", ends, strict=True))
    return int(np.flatnonzero(order == 0)[0]), {"said": "; ".join(said)}
