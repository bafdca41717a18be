"""Feedback-error learning: what had to be corrected on the way is commanded at once next time.

Granule cells sense where the arm should be and how fast; Purkinje cells sum them to an acceleration
that joins the plan. Their lesson, at each place of the way, is the acceleration that a feedback
without delay would have asked for there: the climbing fibres carry a motor error (Kawato & Gomi
1992, who take the command that the feedback really sends).
"""

from typing import Self

import numpy as np

from vmc_lib.arm.kinematics import inverse_kinematics
from vmc_lib.arm.simulate import Motion
from vmc_lib.cerebellum.adaptation import minimum_norm_update
from vmc_lib.cerebellum.forward_model import FAST
from vmc_lib.cerebellum.online import GranuleCells
from vmc_lib.checks import check_kind
from vmc_lib.motor.feedback import (
    SIGHT,
    TICK,
    ReferenceTrajectory,
    excitations_for_acceleration,
    feedback_acceleration,
)
from vmc_lib.motor.inverse_dynamics import SAMPLES, minimum_jerk
from vmc_lib.motor.planning import check_templates
from vmc_lib.motor.templates import START, TemplateSet


class FeedbackErrorLearning:
    """Learns, reach by reach, the acceleration that feedback asks for on the way.

    A single sample is learned by a share 1 / (1 + regularisation).
    """

    regularisation = 0.3

    def __init__(self, template_set: TemplateSet) -> None:
        check_templates(template_set)
        ways = minimum_jerk(START, inverse_kinematics(template_set.points))
        reaches = ReferenceTrajectory(ways, template_set.excitations)
        places = trajectory_inputs(reaches).reshape(-1, 4)
        self.cells = GranuleCells(width=0.5, cells=300).fit(places, np.zeros((len(places), 2)))
        self.purkinje = self.cells.purkinje_

    def correct(self, reference: ReferenceTrajectory) -> ReferenceTrajectory:
        """The `ReferenceTrajectory` with what was learned added to its excitations."""
        active = self.cells.excite(trajectory_inputs(reference).reshape(-1, 4))
        learned = np.zeros_like(reference.q[:, :-1])
        ticks = (active @ self.purkinje).reshape(len(learned), -1, 2)
        learned[:, :SAMPLES] = np.repeat(ticks, TICK, axis=1)
        place = reference.q[:, :-1], reference.velocity[:, :-1]
        u = excitations_for_acceleration(*place, learned, reference.excitations)
        return ReferenceTrajectory(reference.q, u)

    def update(self, reference: ReferenceTrajectory, motion: Motion) -> Self:
        """Learn from the motion of a batch of movements along this reference."""
        check_kind("reference", reference, ReferenceTrajectory, "reference_trajectory(plan)")
        check_kind("motion", motion, Motion, "simulate_feedback(reference)")
        if motion.q.shape != reference.q.shape:
            raise ValueError(
                f"motion of q {motion.q.shape} along a reference {reference.q.shape}: give what "
                "simulate_feedback made of it"
            )
        path = reference.q, reference.velocity, motion.q, motion.velocity
        wanted = feedback_acceleration(SIGHT, *(x[:, :SAMPLES:TICK].reshape(-1, 2) for x in path))
        active = self.cells.excite(trajectory_inputs(reference).reshape(-1, 4))
        self.purkinje = self.purkinje + minimum_norm_update(active, wanted, self.regularisation)
        return self


def trajectory_inputs(reference: ReferenceTrajectory) -> np.ndarray:
    """The mossy fibres' input: where the arm should be, and how fast, each tick, (B, ticks, 4)."""
    check_kind("reference", reference, ReferenceTrajectory, "reference_trajectory(plan)")
    path = reference.q, reference.velocity / FAST
    return np.concatenate([x[:, :SAMPLES:TICK] for x in path], axis=-1)
