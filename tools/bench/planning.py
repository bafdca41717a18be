"""What planning and calibrating cost beside the exact optimiser, in one run on one core.

`.bench/bin/python -m tools.bench.planning` writes the performance page's table. It counts processor
time, which a busy machine does not stretch; all of it is one thread: what a reader waits for.
"""

from time import process_time

import numpy as np
from threadpoolctl import threadpool_limits

from reproduce.measures.changed_worlds import train_aim_correction
from reproduce.peers import optimal_control
from tools.bench.report import publish, seconds
from vmc_lib.cerebellum.offline import algorithm_1, broyden_calibration
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, plan

template_set = templates.load()
targets = draw_targets(template_set, 25, np.random.default_rng(0))
target = optimal_control.TARGETS[10]  # above the table, as an optimum must be
habit = plan(target, template_set)
cerebellum = train_aim_correction(template_set, np.random.default_rng(1), 25)

WORK = {  # what -> (call, how often, simulated movements)
    "habitual plan": (lambda: plan(target, template_set).excitations, 20, 0),
    "25 habitual plans": (lambda: plan(targets, template_set).excitations, 20, 0),
    "one movement": (lambda: execute(plan(target, template_set)).endpoint, 5, 1),
    "Algorithm 1, one target, n = 0..20": (lambda: algorithm_1(habit), 5, 22),
    "Algorithm 1, 25 targets, n = 0..20": (
        lambda: algorithm_1(plan(targets, template_set)),
        3,
        550,
    ),
    "own rule, one target, two trials": (lambda: broyden_calibration(habit), 5, 3),
    "own rule, 25 targets, two trials": (
        lambda: broyden_calibration(plan(targets, template_set)),
        3,
        75,
    ),
    "online correction, one target": (lambda: cerebellum.correct(habit), 20, 0),
    "25 movements, learned online": (lambda: cerebellum.update(plan(targets, template_set)), 5, 25),
    "optimal control, one target": (lambda: optimal_control.solve(target), 2, None),
}


if __name__ == "__main__":
    threadpool_limits(1)  # one core, or its time would count twice
    spent = {
        what: seconds(call, repeats, process_time) for what, (call, repeats, _) in WORK.items()
    }
    slowest = spent["optimal control, one target"]
    publish(
        "planning",
        [
            {
                "task": what,
                "movements": "hundreds" if movements is None else movements,
                "ms of one core": round(1000 * spent[what], 3),
                "× faster than optimal control": round(slowest / spent[what], 1),
            }
            for what, (_, _, movements) in WORK.items()
        ],
    )
