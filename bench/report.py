"""Where a benchmark's table goes: to the screen, and to the book's performance page."""

import json
import os
import platform
from pathlib import Path
from time import perf_counter

import numpy as np

RESULTS = Path(__file__).parent / "results"


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


def sgemm(size=2048):
    """This machine's single-precision matrix multiply, in GFLOP/s: the yardstick of the rest."""
    a = np.random.default_rng(0).random((size, size), dtype=np.float32)
    return 2e-9 * size**3 / seconds(lambda: a @ a)


def publish(name, rows):
    """Print rows (dictionaries with the same keys) and keep them as results/<name>.json."""
    machine = {
        "cores": os.cpu_count(),
        "machine": platform.machine(),
        "Python": platform.python_version(),
        "sgemm GFLOP/s": round(sgemm(), 1),
    }
    for row in rows:
        print("  ".join(f"{key} {value}" for key, value in row.items()))
    RESULTS.mkdir(exist_ok=True)
    text = json.dumps({"machine": machine, "rows": rows}, indent=1)
    (RESULTS / f"{name}.json").write_text(text + "\n")
