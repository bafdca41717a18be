"""Feedback-error learning: what had to be corrected on the way is commanded at once next time.

Granule cells sense where the arm should be and how fast; Purkinje cells sum them to an acceleration
that joins the plan. Their lesson, at each place of the way, is the acceleration that the feedback
asks for there: the climbing fibres carry a motor error (Kawato & Gomi 1992).
"""

import numpy as np

from vmc_lib.arm.kinematics import inverse_kinematics
from vmc_lib.cerebellum.adaptation import least_lesson
from vmc_lib.cerebellum.forward_model import FAST
from vmc_lib.cerebellum.online import GranuleCells
from vmc_lib.motor.feedback import SIGHT, TICK, Intention, accelerate, ask
from vmc_lib.motor.inverse_dynamics import SAMPLES, minimum_jerk
from vmc_lib.motor.templates import START


class FeedbackErrorLearning:
    """Learns, reach by reach, which push on the way to answer before it comes.

    A lone lesson takes a share 1 / (1 + caution) of what the feedback asked for.
    """

    caution = 0.3

    def __init__(self, template_set):
        ways = minimum_jerk(START, inverse_kinematics(template_set.points))
        places = mossy_fibres(Intention(ways, template_set.excitations)).reshape(-1, 4)
        self.cells = GranuleCells(width=0.5, cells=300).fit(places, np.zeros((len(places), 2)))
        self.purkinje = self.cells.purkinje_

    def correct(self, intention):
        """The `Intention` with what was learned added to its excitations."""
        active = self.cells.excite(mossy_fibres(intention).reshape(-1, 4))
        learned = np.zeros_like(intention.q[:, :-1])
        ticks = (active @ self.purkinje).reshape(len(learned), -1, 2)
        learned[:, :SAMPLES] = np.repeat(ticks, TICK, axis=1)
        place = intention.q[:, :-1], intention.velocity[:, :-1]
        return Intention(intention.q, accelerate(*place, learned, intention.excitations))

    def practise(self, intention, motion, senses=SIGHT):
        """Learn from how a batch of movements went that meant this intention."""
        path = intention.q, intention.velocity, motion.q, motion.velocity
        asked = ask(senses, *(x[:, :SAMPLES:TICK].reshape(-1, 2) for x in path))
        active = self.cells.excite(mossy_fibres(intention).reshape(-1, 4))
        self.purkinje = self.purkinje + least_lesson(active, asked, self.caution)
        return self


def mossy_fibres(intention):
    """Where the arm should be, and how fast, at every tick of the reach, (B, ticks, 4)."""
    path = intention.q, intention.velocity / FAST
    return np.concatenate([x[:, :SAMPLES:TICK] for x in path], axis=-1)
