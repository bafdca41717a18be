"""A whole arm: redundancy, shared torques, and mixtures in space."""

import numpy as np
from scipy.optimize import nnls

from kit.question import between, choice, count, number, pick
from reproduce.whole_arm.habits import invert_activation
from vmc_lib.motor.planning import exact_weights, habitual_weights


def freedom_to_spare(rng):
    joints, space = pick(rng, 2, 3, 4, 6, 7, 9), pick(rng, 1, 2, 3)
    return count(
        f"An arm has {joints + space} joints that turn freely. Its tip must be at one place in a "
        f"space of {space} dimensions. How many dimensions has the set of its postures?",
        joints,
        "dimensions",
        "Joints less what the place fixes.",
    )


def muscles_that_are_needed(rng):
    joints = pick(rng, 1, 2, 3, 4, 5, 6, 7)
    return count(
        f"Muscles only pull. How many are needed at least to turn {joints} joints, each both ways, "
        "with any combination of torques?",
        joints + 1,
        "muscles",
        "One more than the joints: together they must be able to pull in every direction.",
    )


def shared_torque(rng):
    torque, arms = between(rng, 2, 10, 0.5), (between(rng, 10, 30, 2), between(rng, 10, 30, 2))
    gain = np.array(arms)
    return number(
        f"Two muscles bend one joint. Fully active, they give {arms[0]} and {arms[1]} N m. "
        f"Together they must give {torque} N m with the least sum of squares of activation. How "
        "active is the first?",
        torque * gain[0] / (gain @ gain),
        hint="In proportion to what each can do: torque × its own, over the sum of the squares.",
        tolerance=0.003,
    )


def none_below_zero(rng):
    torque, bends, opens = (between(rng, *size) for size in ((1, 8, 0.5), (10, 30, 2), (5, 30, 5)))
    pulls = nnls(np.array([[bends, -opens]]), [torque])[0]
    k = pick(rng, 0, 1)
    return number(
        f"One muscle bends a joint with {bends} N m when fully active, another opens it with "
        f"{opens} N m. {torque} N m of bending are needed, and no activation may be below zero. In "
        f"static optimisation, how active is the one that {('bends', 'opens')[k]}?",
        pulls[k],
        hint="What opens the joint would only have to be outdone.",
        tolerance=0.002,
    )


def mixture_of_two_holds(rng):
    first, second = between(rng, 1, 5, 0.5), between(rng, 1, 5, 0.5)
    share = between(rng, 0.1, 0.9, 0.1)
    return number(
        f"Two commands turn a joint, held still, with {first} and {second} N m. Which torque does "
        f"a mixture give that has the weight {share} for the first and {1 - share:.1f} for the "
        "second?",
        share * first + (1 - share) * second,
        "N m",
        "Forces add.",
    )


def memories_in_space(rng):
    sides = [pick(rng, 2, 3, 4, 5, 6) for _ in range(3)]
    return count(
        f"Memories fill a zone in space: {sides[0]} forward, {sides[1]} up and {sides[2]} to the "
        "side. How many are they?",
        np.prod(sides),
        "memories",
        "The product.",
    )


def nearness_in_space(rng):
    distances = np.array([pick(rng, 1, 2, 4, 5, 8, 10) for _ in range(3)])
    points = np.stack([distances, 0 * distances, 0 * distances], axis=-1).astype(float)
    return number(
        f"Three memories end {', '.join(map(str, distances))} cm from a target in space. What "
        "weight has the first by Eq. 5?",
        habitual_weights(np.zeros(3), points)[0],
        hint="One over its distance, divided by the sum of all.",
        tolerance=0.003,
    )


def weight_by_equation_4(rng):
    x, side = between(rng, 1, 9, 1), 10
    corners = side * np.stack(np.meshgrid(*[[0.0, 1.0]] * 3), axis=-1).reshape(-1, 3)
    weights = exact_weights(np.array([x, side / 2, side / 2]), corners)
    return number(
        f"Eight memories end in the corners of a cube of {side} cm. A target lies {x} cm from the "
        "near face, half-way in the other two directions. Weights that satisfy Eq. 4 sum to 1; "
        "how much of it do the four memories of the far face get together?",
        weights[corners[:, 0] > 0].sum(),
        hint="Eq. 4 along that direction: their share times the side is where the target is.",
        tolerance=0.003,
    )


def slow_to_fall(rng):
    active, want = between(rng, 0.2, 0.8, 0.1), between(rng, 0.2, 0.8, 0.1)
    told = invert_activation(np.array([[active], [want]]))[0, 0]
    names = ("more", "less", "just as much")
    return choice(
        f"A muscle's activation is {active}, and in 20 ms it should be {want}. Is it told more "
        "excitation than that, less, or just as much?",
        names,
        names[int(told < want) if not np.isclose(told, want) else 2],
        "Activation lags: to rise it must be told more, to fall less.",
    )
