"""Adaptation: when hand, arm or eyes have changed, learn from the error itself.

`AimCorrection` learns by hindsight what its arm does. Let the hand hold a weight, and hindsight is
slow: it teaches about the places where the hand ends, not about those that it is meant for. So each
miss becomes an error at its *target*, and the Purkinje weights make the smallest change that takes
a share of it away (Albus, 1971). The error alone does not say what is wrong. It can be corrected

- in the **aim**, as behind a prism: plan for another place, with the templates there;
- in the **pull**, as with a weight: give the same templates other weights, which need not sum to
  one. To do nothing is a template too, and the hand then hangs straight down.
"""

from dataclasses import replace

import numpy as np

from vmc_lib.cerebellum.online import GranuleCells
from vmc_lib.motor.planning import Plan, plan, surrounded
from vmc_lib.motor.templates import REACH, TemplateSet

SILENT = np.array([0.0, -REACH])  # where the hand ends when every muscle is silent
CORRECTIONS = ("aim", "pull")
SHARES = np.linspace(1, 0, 41)  # of a shift of the aim: the largest that experience allows is made


class Adaptation:
    """A skilled learner in a world that may change; its plans are batches.

    The skill is an `AimCorrection` or a `WeightCorrection`.
    A lesson alone takes a share 1 / (1 + caution) of its error away.
    """

    def __init__(self, skill, template_set: TemplateSet, corrects="aim", caution=0.3):
        if corrects not in CORRECTIONS:
            raise ValueError(f"cannot correct {corrects!r}; choose one of {CORRECTIONS}")
        self.skill, self.template_set = skill, template_set
        self.corrects, self.caution = corrects, caution
        nothing = np.zeros_like(template_set.points)
        self.cells = GranuleCells(width=0.1, cells=300).fit(template_set.points, nothing)
        self.purkinje = self.cells.purkinje_

    def correct(self, plan: Plan):
        """The plan as the skill corrects it, and with what was learned since."""
        shift = self.shift(plan)
        if self.corrects == "aim":
            return self._aimed(plan, plan.target + shift)
        skilled = self.skill.correct(plan)
        return skilled.with_weights(skilled.weights + pull(plan.points, shift))

    def practise(self, plan: Plan):
        """Move, and learn from the error that is seen. Returns where it ended.

        The batch is learned at once: all its movements are made before the first lesson. What
        should have been done is what was done and the error more. What could not be done is thus
        forgotten, or it would pile up with every miss: *windup*, as engineers call it.
        """
        reached, active = self.correct(plan).reached(), self.cells.excite(plan.target)
        lesson = self.shift(plan) + plan.target - reached - active @ self.purkinje
        self.purkinje = self.purkinje + least_lesson(active, lesson, self.caution)
        return reached

    def shift(self, plan: Plan):
        """How far to shift the hand, (B, 2), as learned; an aim is kept where templates are."""
        shift = self.cells.excite(plan.target) @ self.purkinje
        if self.corrects == "pull":
            return shift
        shares = SHARES[:, None, None] * shift
        known = surrounded(plan.target + shares, self.template_set.points)
        return shares[known.argmax(axis=0), np.arange(len(shift))]

    def _aimed(self, habit, place):
        """The skilled plan for another place, with the templates there."""
        there = self.skill.correct(plan(place, self.template_set))
        return replace(habit, chosen=there.chosen, weights=there.weights)


def least_lesson(active, missing, caution):
    """The smallest change of Purkinje weights (cells, k) that takes away what is `missing` (n, k).

    `active` (n, cells) says which granule cells took part; of a lone lesson, a share
    1 / (1 + caution) is learned.
    """
    overlap = active @ active.T
    overlap += caution * np.diag(np.diag(overlap))
    return active.T @ np.linalg.solve(overlap, missing)


def pull(points, shift):
    """The smallest Δw (…, N) that shifts the hand by `shift` (…, 2), by Eq. 4 from `SILENT`.

    It sums to more than zero where the hand must be lifted: more of everything.
    """
    return (np.linalg.pinv(np.swapaxes(points - SILENT, -1, -2)) @ shift[..., None])[..., 0]
