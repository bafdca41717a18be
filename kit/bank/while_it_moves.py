"""Questions on feedback control: delays, reflexes, forces on the way, and two memories."""

import numpy as np

from kit.question import choice, numeric, steps
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


@numeric("steps", "Delay over step.", tolerance=0)
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
