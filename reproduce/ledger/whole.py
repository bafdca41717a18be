"""The ledger's row on the whole chain, and how the chain fares on the test photos."""

from functools import cache

import numpy as np

from reproduce import trial as trials
from reproduce.ledger.entry import SHARE, Quantity, Row
from vmc_lib.loop import RULES


def _figure_1():
    share = np.isfinite(trial("rig")["planned"]).mean()
    return [Quantity("photos that end in a reach", 1, share, tolerance=SHARE, better=1)]


@cache
def trial(level):
    """`trial` on the test photos of a level, run once."""
    return trials.trial(level)


def fate(level):
    """`summary` of a level, and the stage at which each photo's reach went wrong first."""
    scores = trial(level)
    failures = {rule: trials.first_failure(scores, rule).tolist() for rule in RULES}
    return {"summary": trials.summary(scores), "failures": failures}


ROWS = (
    Row(
        "Fig. 1",
        "The steps make one chain, from photo to movement.",
        "01_loop",
        _figure_1,
    ),
)
