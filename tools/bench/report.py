"""Where a benchmark's table goes: to the screen, and to the book's performance page."""

import os
import platform
from time import perf_counter

import numpy as np

from reproduce import results


def seconds(call, repeats=5, clock=perf_counter):
    """The least of several times of `call()`, in s: the one that noise disturbed least.

    By default on the wall; `process_time` for a clock counts the processor's instead.
    """
    times = []
    for _ in range(repeats):
        start = clock()
        call()
        times.append(clock() - start)
    return min(times)


def sgemm():
    """This machine's single-precision matrix multiply, in GFLOP/s: the yardstick of the rest."""
    size = 2048
    a = np.random.default_rng(0).random((size, size), dtype=np.float32)
    return 2e-9 * size**3 / seconds(lambda: a @ a)


def publish(name, rows):
    """Print rows (dictionaries with the same keys) and keep them in `reproduce/results/bench`."""
    machine = {
        "cores": os.cpu_count(),
        "machine": platform.machine(),
        "Python": platform.python_version(),
        "sgemm GFLOP/s": round(sgemm(), 1),
    }
    for row in rows:
        print("  ".join(f"{key} {value}" for key, value in row.items()))
    results.write(f"bench/{name}", {"machine": machine, "rows": rows})
