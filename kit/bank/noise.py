"""Questions on noise: of a pull, the best of many trials, senses, and what corrections cost."""

from kit.question import numeric, steps
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
