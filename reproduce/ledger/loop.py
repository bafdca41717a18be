"""The ledger's rows on the closed loop, and its results on the test photos."""

from functools import cache

import numpy as np

from reproduce import paper, results
from reproduce.experiments import loop_evaluation as trials
from reproduce.ledger.entry import Quantity, Row, mean, share, trivial_quantity
from vmc_lib.loop import RULES


def _figure_1():
    scores = level_scores("rig")
    named = scores["found"] & scores["named"]
    recall = paper.TABLE_2[1] * paper.TABLE_3["CDBN"][1]
    nearer = 1000 * (scores["planned"] - scores["published"])
    return [
        share(
            "photos whose shuttlecock is found and named",
            recall,
            named.sum(),
            len(named),
            better=1,
            rounding=paper.SHARE,
        ),
        mean("how much nearer calibration brings the hand (mm)", 0, nearer, better=1, bound=True),
        trivial_quantity("photos that end in a movement", 1, np.isfinite(scores["planned"]).mean()),
    ]


def _speed():
    rows = {row["stage"]: row["ms"] for row in results.records("bench/loop")["rows"]}
    ratio = rows["candidates and regions"] / rows["names"]
    return [Quantity("time for where over time for what", 1, ratio, better=-1, bound=True)]


@cache
def level_scores(level):
    """`level_scores` on the test photos of a level, run once."""
    return trials.evaluate(level)


def loop_results(level):
    """The closed loop on a level: its `outcomes`, and the scores of every photo."""
    scores = level_scores(level)
    kept = {k: [None if x != x else x for x in v.tolist()] for k, v in scores.items()}  # no NaN
    return outcomes(scores) | {"scores": kept}


def outcomes(scores):
    """The `summary` of scores, and the stage at which each photo's reach went wrong first."""
    failures = {rule: trials.first_failure(scores, rule).tolist() for rule in RULES}
    return {"summary": trials.summary(scores), "failures": failures}


ROWS = (
    Row(
        "Fig. 1",
        "The steps make one chain, from photo to movement.",
        "01_loop",
        _figure_1,
        note="The paper gives no number for the whole: its recall in Table II times that in Table "
        "III stands in for one.",
    ),
    Row(
        "II A, speed",
        "The dorsal stream responds in real time.",
        "performance",
        _speed,
        differs="Our model is serial: a region must be found before it can be named, and finding "
        "takes {q[time for where over time for what].obtained:.1f} times as long as naming. In the "
        "brain the two pathways work side by side.",
    ),
)
