"""How soon every demo of the book answers in a live kernel: from a question to the whole reply.

It is the processor's time, on one thread: what a reader waits on a quiet core, without the browser,
which draws the reply.

.venv/bin/python -m tools.bench.live
"""

import json
import os
import subprocess
import sys
from pathlib import Path
from time import process_time
from types import SimpleNamespace

import nbformat
import numpy as np

from tools.bench.report import publish

BOOK = Path(__file__).parents[2] / "book"
STATES = 24  # of a demo, at most


def chapter(name):
    """A row for each demo of a chapter, which runs here, live."""
    from vmc_lib.show import demo

    demos, names, widget = [], {}, demo.widget
    still = SimpleNamespace(update=lambda item: None)
    demo.display = lambda *items, **_: still
    demo.widget = lambda *given, **named: demos.append(widget(*given, **named)) or demos[-1]
    for cell in nbformat.read(BOOK / f"{name}.ipynb", as_version=4).cells:
        if cell.cell_type == "code":
            exec(cell.source, names)  # noqa: S102
    for one in demos:
        if hasattr(one, "answers") and (times := latencies(one.answers["state"])):
            [[words, *_], *_] = one.first
            median, late = np.percentile(times, [50, 95])
            yield {"chapter": name, "demo": words[:40], "median": median, "95 %": late}


def latencies(answer):
    """Milliseconds of each of many answers: the state drawn, and the reply as text."""
    times = []
    for place in np.random.default_rng(0).permutation(200).tolist():
        began = process_time()
        try:
            json.dumps(answer(place))
        except IndexError:  # a smaller grid
            continue
        times.append(1000 * (process_time() - began))
        if len(times) == STATES:
            break
    return times


def main():
    """Measure all chapters, each in a process of its own; the slowest demo first."""
    rows = []
    for path in sorted(BOOK.glob("[0-9]*.ipynb")):
        command = [sys.executable, "-m", "tools.bench.live", path.stem]
        environment = os.environ | {"VMC_RENDER_MODE": "live"}
        done = subprocess.run(
            command, env=environment, check=True, capture_output=True, encoding="utf-8"
        )
        rows += json.loads(done.stdout.splitlines()[-1])
    rows.sort(key=lambda row: -row["median"])
    for row in rows:
        row |= {"median": round(row["median"], 1), "95 %": round(row["95 %"], 1)}
    publish("live", rows)


if __name__ == "__main__":
    print(json.dumps(list(chapter(sys.argv[1])))) if sys.argv[1:] else main()
