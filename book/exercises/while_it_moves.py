"""Exercises of the chapter on movements that are watched."""

import numpy as np

from vmc_lib.grading import Exercise


def delay_signal(signal, steps):
    then = np.arange(len(signal)) - steps
    return signal[np.maximum(then, 0)]


DELAY_SIGNAL = Exercise(
    delay_signal,
    lambda rng: (rng.normal(size=rng.integers([4, 1], [9, 4])).round(1), int(rng.integers(1, 4))),
    {
        "The end of the movement comes in at its beginning: an index below zero counts from "
        "the end. Before the first report, the first value holds.": (
            lambda signal, steps: np.roll(signal, steps, axis=0)
        ),
        "Before the first report you say zero, as if the hand were at the shoulder. It rests "
        "at its first place.": lambda signal, steps: np.concatenate(
            [0 * signal[:steps], signal[:-steps]]
        ),
        "You look ahead: at step $t$ the report is of step $t - $ `steps`.": (
            lambda signal, steps: delay_signal(signal[::-1], steps)[::-1]
        ),
        "Your result is shorter than the movement. There is a report at every step: at first, of "
        "the first place.": lambda signal, steps: signal[:-steps],
    },
)


def smith(report, model, steps):
    then = np.maximum(np.arange(len(model)) - steps, 0)
    return model + (report - model[then])


SMITH = Exercise(
    smith,
    lambda rng: (*rng.normal(size=(2, rng.integers(4, 9))).round(1), int(rng.integers(1, 4))),
    {
        "That trusts the model alone, however wrong it is. Correct it by what the eye reports.": (
            lambda report, model, steps: model
        ),
        "You compared the report with what the model says *now*. The report is old: compare it "
        "with what the model said then.": lambda report, model, steps: report,
        "Mind the sign: add the report, less what the model said then.": (
            lambda report, model, steps: 2 * model - smith(report, model, steps)
        ),
        "A mean of report and model is late by half. Let the model tell what has happened since "
        "the report, and add it.": lambda report, model, steps: (report + model) / 2,
    },
)
