"""The ledger's rows on the whole chain, and how the chain fares on the test photos."""

from functools import cache

import numpy as np

from reproduce import paper, results
from reproduce.experiments import loop_evaluation as trials
from reproduce.ledger.entry import Quantity, Row, fixed, mean, share
from vmc_lib.loop import RULES


def _figure_1():
    scores = trial("rig")
    seen = scores["found"] & scores["named"]
    recall = paper.TABLE_2[1] * paper.TABLE_3["CDBN"][1]
    nearer = 1000 * (scores["planned"] - scores["published"])
    return [
        share(
            "photos whose shuttlecock is found and named",
            recall,
            seen.sum(),
            len(seen),
            better=1,
            rounding=paper.SHARE,
        ),
        mean("how much nearer calibration brings the hand (mm)", 0, nearer, better=1, bound=True),
        fixed("photos that end in a movement", 1, np.isfinite(scores["planned"]).mean()),
    ]


def _speed():
    rows = {row["stage"]: row["ms"] for row in results.records("bench/loop")["rows"]}
    ratio = rows["candidates and regions"] / rows["names"]
    return [Quantity("time for where over time for what", 1, ratio, better=-1, bound=True)]


@cache
def trial(level):
    """`trial` on the test photos of a level, run once."""
    return trials.trial(level)


def fate(level):
    """How the loop fares on a level: what is `told` of its `trial`, and every photo's scores."""
    scores = trial(level)
    kept = {k: [None if x != x else x for x in v.tolist()] for k, v in scores.items()}  # no NaN
    return told(scores) | {"scores": kept}


def told(scores):
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
