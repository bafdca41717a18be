"""Questions on noise: of a pull, the best of many trials, senses, and what corrections cost."""

import numpy as np

from kit.bank.drawing import curves
from kit.question import choice, numeric, picture, steps
from vmc_lib.arm.muscle import force

ERROR = steps(1, 12, 0.5)


@numeric("N", "Eq. 10 is linear in the activation: the stronger the command, the noisier.")
def noise_of_a_pull(sigma=(0.05, 0.1, 0.2), strongest=(400, 600, 900), a=steps(0.1, 0.9, 0.1)):
    """A muscle is held still at its optimal length; its active part pulls with {pull:.1f} N. Its
    activation strays by {sigma:.0%} of itself. By how much does the force (Eq. 10)?"""
    pull = force(a, 1.0, 0.0, strongest) - force(0.0, 1.0, 0.0, strongest)
    return sigma * pull, {"pull": pull}


@numeric(hint="1 less the probability that it happens in none.")
def luck_of_the_best(n=(2, 5, 10, 20), p=(0.05, 0.1, 0.2)):
    """By noise alone, a trial looks better than it is with probability {p}. With what probability
    does this happen in at least one of {n} independent trials?"""
    return 1 - (1 - p) ** n


@numeric(hint="1 over the error's square for each; what is known of the model over the sum.")
def gain_of_one_report(model=ERROR, sense=ERROR):
    """A place is predicted with an error of {model} mm (standard deviation), and reported with one
    of {sense} mm. Of the difference between report and prediction, which share should the estimate
    take?"""
    return model**2 / (model**2 + sense**2)


@numeric("mm", "1 over the variance is the sum of 1 over each variance.")
def error_of_two_senses(eye=ERROR, skin=ERROR):
    """Two senses report the same place, with independent errors of {eye} mm and {skin} mm. How far
    off is the best estimate (its standard deviation)?"""
    return (1 / eye**2 + 1 / skin**2) ** -0.5


@numeric(hint="Minimise q (x − b k x)² + r (k x)² over k.", tolerance=0.003)
def gain_of_the_last_step(q=(1, 2, 4), r=(0.5, 1, 2, 4), b=(0.5, 1, 2)):
    """In its last step a deviation x becomes x − b k x, with b = {b}. What is left costs {q} times
    its square, the correction k x costs {r} times its square. Which k is best?"""
    return q * b / (r + q * b**2)


FORCES = np.linspace(20, 200, 10)  # N


def spreads(share, order):
    """Deviations in N of three noises over `FORCES`: a share, a constant, and both, (3, 10)."""
    return np.array([0 * FORCES + 110 * share, share * FORCES, share * FORCES / 2 + 55 * share])[
        order
    ]


def noises(axes, share, order):
    """The deviation of a force in N against its mean, 20 to 200 N, in three muscles: {said}."""
    curves(axes, FORCES, dict(zip("ABC", spreads(share, order), strict=True)), "mean (N)", "sd (N)")
    axes.set_ylim(0, None)


@picture(noises)
@choice("A", "B", "C", hint="By that law a stronger command is noisier.")
def against_noise_of_the_command(
    share=steps(0.02, 0.2, 0.01), order=lambda rng: rng.permutation(3)
):
    """Three muscles hold a force as evenly as they can. Which one speaks against noise that grows
    with the command?"""
    ends = spreads(share, order)[:, [0, -1]]
    said = (f"{n} from {a:.1f} to {b:.1f}" for n, (a, b) in zip("ABC", ends, strict=True))
    return int(np.flatnonzero(order == 0)[0]), {"said": "; ".join(said)}


PLACES = np.linspace(-30, 90, 481)  # mm


def two_bells(axes, model, sense, seen):
    """Two bells over a place in mm: what is predicted, around 0, with a deviation of {model} mm;
    what is reported, around {seen}, with one of {sense} mm."""
    named = {
        name: np.exp(-(((PLACES - middle) / deviation) ** 2) / 2) / deviation / (2 * np.pi) ** 0.5
        for name, middle, deviation in (("predicted", 0, model), ("reported", seen, sense))
    }
    curves(axes, PLACES, named, "place (mm)", "density")
    axes.set_xticks(np.arange(-30, 91, 10))


@picture(two_bells)
@numeric(
    "mm", "Of the way from 0 to the report, the share model² / (model² + sense²).", tolerance=2
)
def best_estimate(model=(6, 8, 10), sense=(6, 8, 10, 12), seen=(40, 50, 60)):
    """A place is predicted (around 0 mm, deviation {model} mm) and reported (around {seen} mm).
    Read how wide the report's bell is: at 0.61 of its height it is one deviation from its middle.
    Where does the best estimate lie?"""
    return seen * model**2 / (model**2 + sense**2)
