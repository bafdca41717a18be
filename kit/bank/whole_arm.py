"""Questions on a whole arm: redundancy, shared torques, and mixtures in space."""

import numpy as np
from scipy.optimize import nnls

from kit.bank.drawing import curves
from kit.question import choice, count, numeric, picture, steps
from reproduce.whole_arm.habits import invert_activation
from vmc_lib.motor.planning import exact_weights, habitual_weights

STRENGTH, ACTIVATION, COUNT = steps(10, 30, 2), steps(0.2, 0.8, 0.1), (2, 3, 4, 5, 6)


@count("dimensions", "Joints less what the place fixes.")
def freedom_to_spare(spare=(2, 3, 4, 6, 7, 9), space=(("a plane", 2), ("space", 3))):
    """An arm has {joints} joints that turn freely. Its tip must be at one place in
    {space[0]}. How many dimensions has the set of its postures?"""
    return spare, {"joints": spare + space[1]}


@count(
    "muscles",
    "One more than the joints: together they must be able to pull in every direction.",
)
def muscles_that_are_needed(joints=steps(2, 20, 1)):
    """Muscles only pull. How many are needed at least to turn {joints} joints, each both ways, with
    any combination of torques?"""
    return joints + 1


@numeric(
    hint="In proportion to what each can do: torque × its own, over the sum of the squares.",
    tolerance=0.003,
)
def shared_torque(torque=steps(2, 10, 0.5), first=STRENGTH, second=STRENGTH):
    """Two muscles bend one joint. Fully active, they give {first} and {second} N m. Together they
    must give {torque} N m with the least sum of squares of activation. How active is the first?"""
    return torque * first / (first**2 + second**2)


@numeric(
    hint="What opens the joint would only have to be outdone.",
    tolerance=0.002,
)
def none_below_zero(torque=steps(1, 8, 0.5), bends=STRENGTH, opens=steps(5, 30, 5)):
    """One muscle bends a joint with {bends} N m when fully active, another opens it with {opens} N
    m. {torque} N m of bending are needed, and no activation may be below zero. In static
    optimisation, how active is the one that bends?"""
    return nnls(np.array([[bends, -opens]]), [torque])[0][0]


@numeric("times", "It grows by itself: e to the power of stiffness × time over damping.")
def fall_from_a_posture(
    stiffness=steps(0.1, 0.5, 0.1), damping=steps(0.4, 1.2, 0.2), seconds=(1, 1.5, 2)
):
    """A joint with a stiffness of −{stiffness} N m/rad is nudged a little. It is damped with
    {damping} N m s/rad; neglect its inertia. How many times as far off is it after {seconds} s?
    """
    return np.exp(stiffness * seconds / damping)


@numeric("N m", "Forces add.")
def mixture_of_two_holds(
    first=steps(1, 5, 0.5), second=steps(1, 5, 0.5), share=steps(0.1, 0.9, 0.1)
):
    """Two commands turn a joint, held still, with {first} and {second} N m. Which torque does a
    mixture give that has the weight {share} for the first and {rest:.1f} for the second?"""
    return share * first + (1 - share) * second, {"rest": 1 - share}


@count("memories", "The product.")
def memories_in_space(forward=COUNT, up=COUNT, aside=COUNT):
    """Memories fill a zone in space: {forward} forward, {up} up and {aside} to the side. How many
    are they?"""
    return forward * up * aside


@numeric(hint="One over its distance, divided by the sum of all.", tolerance=0.003)
def nearness_in_space(cm=lambda rng: np.array([1, 2, 4, 5, 8, 10])[rng.integers(6, size=3)]):
    """Three memories end {cm[0]}, {cm[1]}, {cm[2]} cm from a target in space. What weight has the
    first by Eq. 5?"""
    return habitual_weights(np.zeros(3), np.outer(cm, [1.0, 0, 0]))[0]


@numeric(
    hint="Eq. 4 along that direction: their share times the side is where the target is.",
    tolerance=0.003,
)
def weight_by_equation_4(x=steps(1, 9, 1)):
    """Eight memories end in the corners of a cube of 10 cm. A target lies {x} cm from the near
    face, half-way in the other two directions. Weights that satisfy Eq. 4 sum to 1; how much of it
    do the four memories of the far face get together?"""
    corners = 10 * np.stack(np.meshgrid(*[[0.0, 1.0]] * 3), axis=-1).reshape(-1, 3)
    return exact_weights(np.array([x, 5, 5]), corners)[corners[:, 0] > 0].sum()


@choice(
    "more",
    "less",
    "just as much",
    hint="Activation lags: to rise it must be told more, to fall less.",
)
def slow_to_fall(active=ACTIVATION, wanted=ACTIVATION):
    """A muscle's activation is {active}, and in 20 ms it should be {wanted}. Is it told more
    excitation than that, less, or just as much?"""
    excitation = invert_activation(np.array([[active], [wanted]]))[0, 0]
    return 2 if np.isclose(excitation, wanted) else int(excitation < wanted)


SIZES = 2 ** np.arange(1, 7)  # joints, say


def growth(axes, power, first):
    """Seconds against size, both on logarithmic axes: a straight line through {first:g} s at 2 and
    {last:g} s at 64."""
    curves(axes, SIZES, {"": first * (SIZES / 2) ** power}, "size", "seconds")
    axes.plot(SIZES, first * (SIZES / 2) ** power, "C0o")
    axes.set(xscale="log", yscale="log", xticks=SIZES, xticklabels=SIZES)
    axes.tick_params("x", which="minor", bottom=False, labelbottom=False)
    axes.grid(alpha=0.4, which="both")


@picture(growth)
@numeric(
    hint="Slope: how many tens the time grows by, over how many tens the size does.", tolerance=0.1
)
def power_on_two_logarithms(power=(1, 1.5, 2, 2.5, 3), first=(0.1, 0.2, 0.5, 1)):
    """Measured times on two logarithmic axes. With which power of the size do they grow?"""
    return power, {"last": first * 32**power}


PUSHED = np.linspace(-20, 20, 41)  # degrees off a posture


def holds(slopes):
    """Torques of two muscle patterns against the deviation from a posture, N m, (2, 41)."""
    return np.array([slope * PUSHED / 20 for slope in slopes])


def two_holds(axes, slopes):
    """Torque in N m against how far the joint is off its posture, -20 to 20 degrees, for two muscle
    patterns, both 0 at 0. At 20 degrees A gives {slopes[0]:g}, B {slopes[1]:g}."""
    named = dict(zip("AB", holds(slopes), strict=True))
    curves(axes, PUSHED, named, "off (degrees)", "torque (N m)")
    axes.axhline(0, color="k", lw=0.5)
    axes.axvline(0, color="k", lw=0.5)


def two_slopes(rng):
    """At 20 degrees off, the torque that leads back is negative; one of each, N m, (2,)."""
    return rng.permutation([rng.integers(1, 10), -rng.integers(1, 10)]) / 2


@picture(two_holds)
@choice("A", "B", hint="A torque against the deviation leads back; one along with it leads on.")
def which_holds_by_itself(slopes=two_slopes):
    """Two patterns of muscles hold a joint in the same posture, without a reflex. A fly nudges it.
    With which pattern does it come back?"""
    return np.argmin(slopes)
