"""Adaptation: when hand, arm or eyes have changed, learn from the error itself.

`AimCorrection` learns by hindsight what its arm does. Let the hand hold a weight, and hindsight is
slow: it teaches about the places where the hand ends, not about those that it is meant for. So each
miss becomes an error at its *target*, and the Purkinje weights make the smallest change that takes
a share of it away (Albus, 1971). The error alone does not say what is wrong. It can be corrected

- in the **aim**, as behind a prism: plan for another place, with the templates there;
- in the **pull**, as with a load: give the same templates other weights, which need not sum to
  one. To do nothing is a template too, and the hand then drops.
"""

from dataclasses import replace
from typing import Literal

import numpy as np

from vmc_lib.cerebellum.online import AimCorrection, GranuleCells, WeightCorrection
from vmc_lib.checks import as_numbers, is_positive
from vmc_lib.motor.execution import Execute, Movement, execute
from vmc_lib.motor.planning import Plan, check_batch, check_templates, is_surrounded, plan
from vmc_lib.motor.templates import TemplateSet
from vmc_lib.short_repr import short

CORRECTIONS = ("aim", "pull")
SHARES = np.linspace(1, 0, 41)  # of a shift of the aim: the largest that experience allows is made


class Adaptation:
    """Error-based learning on top of a trained correction, in a world that may change.

    Parameters
    ----------
    trained_correction : AimCorrection or WeightCorrection
        What was learned before the change.
    template_set : TemplateSet
        The remembered reaches.
    corrects : {"aim", "pull"}
        What to change about a plan.
    regularisation : float
        A single error is reduced by a share 1 / (1 + regularisation).

    Examples
    --------
    >>> from vmc_lib.cerebellum.online import AimCorrection
    >>> from vmc_lib.motor.templates import load
    >>> learner = Adaptation(AimCorrection(load()), load())
    >>> plans = plan(np.array([[0.15, -0.4], [0.12, -0.38]]), load())
    >>> learner.update(plans).endpoint.shape
    (2, 2)
    """

    def __init__(
        self,
        trained_correction: AimCorrection | WeightCorrection,
        template_set: TemplateSet,
        corrects: Literal["aim", "pull"] = "aim",
        regularisation: float = 0.3,
    ) -> None:
        check_templates(template_set)
        if corrects not in CORRECTIONS:
            raise ValueError(f"cannot correct {corrects!r}; choose one of {CORRECTIONS}")
        if not hasattr(trained_correction, "correct"):
            raise ValueError(
                f"trained_correction {short(trained_correction)} corrects nothing: give an "
                "AimCorrection"
            )
        if not is_positive(regularisation):
            raise ValueError(f"regularisation = {short(regularisation)}: give more than 0")
        self.trained_correction, self.template_set = trained_correction, template_set
        self.corrects, self.regularisation = corrects, regularisation
        self.silent = silent_endpoint(template_set)
        nothing = np.zeros_like(template_set.points)
        self.cells = GranuleCells(width=0.1, cells=300).fit(template_set.points, nothing)
        self.purkinje = self.cells.purkinje_

    def correct(self, plan: Plan) -> Plan:
        """The plan with the trained correction, and with what was learned since."""
        shift = self.shift(plan)
        if self.corrects == "aim":
            return self._aimed(plan, plan.target + shift)
        trained = self.trained_correction.correct(plan)
        change = weight_correction(plan.points - self.silent, shift)
        return trained.with_weights(trained.weights + change)

    def update(self, plan: Plan, execute: Execute = execute) -> Movement:
        """Move, and learn from the error that is seen. Returns the `Movement`.

        The batch is learned at once: all its movements are made before. The right shift is the one
        that was made plus the error. So a shift that could not be made is forgotten; else it would
        pile up with every error: *windup*, as engineers call it.
        """
        check_batch(plan)
        movement, active = execute(self.correct(plan)), self.cells.excite(plan.target)
        missing = self.shift(plan) + plan.target - movement.endpoint - active @ self.purkinje
        self.purkinje = self.purkinje + minimum_norm_update(active, missing, self.regularisation)
        return movement

    def shift(self, plan: Plan) -> np.ndarray:
        """How far to shift the hand, (B, 2), as learned; an aim is kept where templates are."""
        check_batch(plan)
        shift = self.cells.excite(plan.target) @ self.purkinje
        if self.corrects == "pull":
            return shift
        shares = SHARES[:, None, None] * shift
        known = is_surrounded(plan.target + shares, self.template_set.points)
        return shares[known.argmax(axis=0), np.arange(len(shift))]

    def _aimed(self, habit, place):
        """The corrected plan for another place, with the templates there."""
        there = self.trained_correction.correct(plan(place, self.template_set))
        return replace(habit, rows=there.rows, weights=there.weights)


def minimum_norm_update(
    active: np.ndarray, missing: np.ndarray, regularisation: float
) -> np.ndarray:
    """Regularised least-squares (NLMS) update (cells, k) of Purkinje weights, for errors (n, k).

    `active` (n, cells) says which granule cells took part; a single sample is learned by a share
    1 / (1 + regularisation).
    """
    if np.ndim(active) != 2 or np.shape(missing)[:1] != np.shape(active)[:1]:
        raise ValueError(
            f"active {np.shape(active)} and missing {np.shape(missing)}: give (n, cells) and (n, k)"
        )
    overlap = active @ active.T
    overlap += regularisation * np.diag(np.diag(overlap))
    return active.T @ np.linalg.solve(overlap, missing)


def silent_endpoint(template_set: TemplateSet) -> np.ndarray:
    """Where the hand ends, (2,), in m, when every muscle is silent."""
    check_templates(template_set)
    return template_set.reach(np.zeros_like(template_set.excitations[:1])).endpoint[0]


def weight_correction(pulls: np.ndarray, shift: np.ndarray) -> np.ndarray:
    """The smallest Δw (…, N) that shifts the hand by `shift` (…, 2), by Eq. 4.

    `pulls` (…, N, 2) is how far each template brings the hand from where it ends in silence. Δw
    sums to more than zero where the hand must be lifted: more of everything.
    """
    pulls, shift = as_numbers("pulls", pulls), as_numbers("shift", shift)
    if shift.shape[-1:] != pulls.shape[-1:]:
        raise ValueError(f"shift {short(shift)}: give (…, 2) in the arm's plane, in m")
    return (np.linalg.pinv(np.swapaxes(pulls, -1, -2)) @ shift[..., None])[..., 0]
