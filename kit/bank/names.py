"""Questions on names: from features to a probability, and how far to believe a table."""

import numpy as np

from kit.bank.drawing import curves
from kit.question import choice, count, numeric, picture, steps, successes, tenths
from vmc_lib.statistics import wilson
from vmc_lib.what.recogniser import NameClassifier


@numeric(hint="1 / (1 + exp(-(w · x + b)))", tolerance=0.002)
def chance_of_a_name(weights=tenths(-2, 2, 3), x=tenths(-2, 2, 3), bias=steps(-1, 1, 0.5)):
    """A classifier has the weights {weights} and the bias {bias}. What probability does it give for
    the features {x}?"""
    return NameClassifier(weights, bias).probability(x)


@numeric(hint="The logarithm of the odds, p / (1 - p).")
def score_of_a_chance(p=(0.1, 0.2, 0.25, 0.3, 0.6, 0.7, 0.75, 0.8, 0.9, 0.95)):
    """A sigmoid says {p}. What was the weighted sum before it?"""
    return np.log(p / (1 - p))


@numeric(hint="Where the weighted sum is 0, the probability is one half.", tolerance=0.005)
def feature_that_tips_it(weight=(0.5, 1.0, 2.0, 4.0), bias=steps(-3, -0.5, 0.25)):
    """One feature has the weight {weight}, the bias is {bias}, and all else is 0. From which value
    of the feature on is the name the likelier one?"""
    return -bias / weight


@numeric(hint="n / (n + z²), z = 1.96", tolerance=0.002)
def table_without_errors(n=(20, 40, 60, 80, 100, 160, 200)):
    """A recogniser makes no error in {n} photos. Where is the lower end of the share's 95 %
    interval, after Wilson?"""
    return wilson(n, n)[0]


@choice("no", "yes", hint="Work out both intervals first.")
def do_intervals_meet(right=successes((40, 80, 160), 2)):
    """One method is right in {right[0]} of {right[2]} photos, another in {right[1]} of {right[2]}
    other photos. Do their 95 % intervals, after Wilson, have a value in common?"""
    *counts, n = right
    lows, highs = zip(*(wilson(count, n) for count in counts), strict=True)
    return max(lows) <= min(highs)


@numeric("%", "Right calls over all calls.", tolerance=0.05)
def precision_with_cups(n=steps(40, 90, 5), wrong=steps(2, 6, 1)):
    """All {n} shuttlecocks are named, and {wrong} cups are named shuttlecock too. What is
    the precision, to a tenth of a per cent?"""
    return 100 * n / (n + wrong)


@count("crops", "That is what calibrated means.")
def honest_chances(p=(0.6, 0.7, 0.8, 0.9), n=(20, 50, 100, 200)):
    """A calibrated recogniser says {p} for each of {n} crops. How many of them does one expect to
    be shuttlecocks?"""
    return round(p * n)


def table_of_names(rng):
    """Crops by what they show (rows) and by what they are called (columns), (2, 2)."""
    return rng.integers([[50, 5], [5, 50]], [[90, 30], [30, 90]])


def confusion(axes, table):
    """A table of crops. Shuttlecocks: {table[0][0]} called shuttlecock, {table[0][1]} called cup.
    Cups: {table[1][0]} called shuttlecock, {table[1][1]} called cup."""
    axes.imshow(table, cmap="Blues", vmin=0, vmax=150)
    for (row, column), number in np.ndenumerate(table):
        axes.text(column, row, number, ha="center", va="center", fontsize=14)
    names = ["shuttlecock", "cup"]
    axes.set(xticks=[0, 1], xticklabels=names, yticks=[0, 1], yticklabels=names)
    axes.set(xlabel="called", ylabel="shows")


@picture(confusion)
@numeric(hint="Recall: along the row, of what there is. Precision: down the column, of the calls.")
def read_a_table(table=table_of_names, what=("recall", "precision")):
    """What {what} does this recogniser have for shuttlecocks?"""
    return table[0, 0] / (table[0] if what == "recall" else table[:, 0]).sum()


SAID = np.arange(0.55, 1, 0.1)  # what a recogniser says of its names


def share_right(bend, noise):
    """How often names that were said with these chances were right, (5,)."""
    return np.clip(SAID + bend * (SAID - 0.5) + noise, 0, 1).round(2)


def reliability(axes, bend, noise):
    """Said and came true: {pairs}. A dashed line shows where both are the same."""
    axes.plot(SAID, share_right(bend, noise), "o-", label="this recogniser")
    axes.plot([0.5, 1], [0.5, 1], "k--", label="said = came true")
    axes.set(xlabel="chance that it says", ylabel="share that is right")
    axes.grid(alpha=0.4)
    axes.legend()


@picture(reliability)
@choice(
    "it says more than comes true",
    "it says less than comes true",
    "what it says comes true",
    hint="Below the dashed line it promised more than came.",
)
def honest_or_not(
    bend=(-0.5, -0.4, 0.0, 0.3, 0.35), noise=lambda rng: rng.uniform(-0.02, 0.02, 5).round(3)
):
    """A recogniser's chances against how often they came true, each from hundreds of test crops.
    How honest is it?"""
    pairs = zip(SAID, share_right(bend, noise), strict=True)
    words = {"pairs": "; ".join(f"{said:.2f} and {true:.2f}" for said, true in pairs)}
    return (0 if bend < 0 else 1 if bend > 0 else 2), words


SIZES = np.array([15, 20, 30, 45, 70, 100])  # examples


def errors(seed):
    """Errors of lines fitted to more and more examples: on these, and on new ones, (2, 6)."""
    rng = np.random.default_rng(seed)
    weights = rng.standard_normal(10)

    def examples(n):
        x = rng.standard_normal((n, 10))
        return x, x @ weights + rng.standard_normal(n)

    def error(x, y, fit):
        return np.sqrt(np.mean((x @ fit - y) ** 2))

    rows = []
    for n in SIZES:
        seen, new = examples(n), examples(1000)
        fit = np.linalg.lstsq(*seen)[0]
        rows.append((error(*seen, fit), error(*new, fit)))
    return np.array(rows).T.round(2)


def learning_curves(axes, seed, swap):
    """Two errors against the number of training examples, 15 to 100. A: {a}. B: {b}."""
    curves(axes, SIZES, dict(zip("AB", errors(seed)[[swap, 1 - swap]], strict=True)), "", "error")
    axes.set_xlabel("training examples")


@picture(learning_curves)
@choice("A", "B", hint="What is learnt by heart looks best where there is little to learn.")
def held_out_of_two(seed=lambda rng: int(rng.integers(10**6)), swap=(0, 1)):
    """One of these curves is the error on the examples that were learnt from, the other on new
    ones. Which is the held-out curve?"""
    a, b = errors(seed)[[swap, 1 - swap]]
    return 1 - swap, {"a": a, "b": b}
