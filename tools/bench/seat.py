"""What one seat of a class needs: a JupyterLab server, and a kernel that runs any chapter.

.venv/bin/python -m tools.bench.seat        (the book's own environment: a seat has no other)
"""

import ast
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, sleep
from urllib.parse import quote

import nbformat
import psutil
from jupyter_client.manager import start_new_kernel
from jupyter_server.utils import fetch

from tools.bench.report import publish

BOOK = Path(__file__).parents[2] / "book"
CHAPTERS = sorted(path.stem for path in BOOK.glob("[0-9]*.ipynb"))
USAGE = "(lambda u: (u.ru_maxrss, u.ru_utime + u.ru_stime))(__import__('resource').getrusage(0))"


def server():
    """A JupyterLab server, on a Unix socket (no port is opened): its memory and time to start.

    The memory is that of a server which has handed out JupyterLab and every chapter.
    """
    with TemporaryDirectory() as folder:
        socket = Path(folder) / "lab.sock"
        options = [f"--ServerApp.sock={socket}", "--no-browser", "--allow-root"]
        options += ["--IdentityProvider.token="]
        command = [sys.executable, "-m", "jupyterlab", *options]
        began = perf_counter()
        lab = subprocess.Popen(command, stderr=subprocess.DEVNULL, cwd=BOOK)
        while not socket.exists():
            sleep(0.05)
        started = perf_counter() - began
        sleep(5)  # what it loads after it has answered
        for asked in ("lab", *(f"api/contents/{name}.ipynb" for name in CHAPTERS)):
            fetch(f"http+unix://{quote(str(socket), safe='')}/{asked}")
        memory = psutil.Process(lab.pid).memory_info().rss / 1e6
        lab.terminate()
        lab.wait()
    return row("JupyterLab's server", memory, started)


def kernel(what, cells):
    """A live kernel that runs `cells`: its peak memory, its first demo, its processor time."""
    began, demo = perf_counter(), None
    manager, client = start_new_kernel(cwd=BOOK)
    started = perf_counter() - began
    for source in cells:
        reply = client.execute_interactive(source, output_hook=lambda message: None)
        if reply["content"]["status"] != "ok":
            raise RuntimeError(f"{what}: {reply['content']['evalue']}")
        if demo is None and "explore(" in source:
            demo = perf_counter() - began
    reply = client.execute_interactive("", user_expressions={"usage": USAGE})
    usage = reply["content"]["user_expressions"]["usage"]["data"]["text/plain"]
    kilobytes, processor = ast.literal_eval(usage)
    client.stop_channels()
    manager.shutdown_kernel()
    return row(what, 1.024e-3 * kilobytes, started, demo, processor)


def row(what, memory, started=None, demo=None, processor=None):
    seconds = {"starts (s)": started, "first demo (s)": demo, "processor (s)": processor}
    rounded = {name: value and round(value, 1) for name, value in seconds.items()}
    return {"what": what, "memory (MB)": round(memory)} | rounded


def code(chapter):
    cells = nbformat.read(BOOK / f"{chapter}.ipynb", as_version=4).cells
    return [cell.source for cell in cells if cell.cell_type == "code"]


def imports(chapter):
    """All that a chapter's cells import, as a cell."""
    body = ast.parse("\n".join(code(chapter))).body
    return "\n".join(ast.unparse(s) for s in body if isinstance(s, ast.Import | ast.ImportFrom))


if __name__ == "__main__":
    rows = [server(), kernel("an empty kernel", [])]
    rows += [kernel(f"a kernel importing all of {name}", [imports(name)]) for name in CHAPTERS]
    rows += [kernel(f"a kernel running {name}", code(name)) for name in CHAPTERS]
    taken, *kernels = (each["memory (MB)"] for each in rows)
    second, first = sorted(kernels)[-2:]
    rows.append(row("a seat: server and kernel", taken + first))
    rows.append(row("a seat with two chapters open", taken + first + second))
    publish("seat", rows)
