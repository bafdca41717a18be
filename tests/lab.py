"""A JupyterLab of its own on this machine, and what tests ask a chapter that is open in it."""

import os
import re
import shutil
import socket
import subprocess
import sys
from contextlib import contextmanager, suppress

import nbformat
import numpy as np

from tests.pages import AXE, ROOT
from tests.project import listens

LONG_CHAPTER = [  # a demo, and a cell that runs until the reader says so
    """import time
from pathlib import Path
import matplotlib.pyplot as plt
from vmc_lib.show import Slider, explore""",
    """def draw(k):
    fig, ax = plt.subplots()
    ax.plot([0, k])
    ax.set(xlim=(0, 0.5))
    return fig
explore(draw, "c", lambda k: f"up to {k}", k=Slider([1, 2, 3], "k"))""",
    """Path("running").touch()
while not Path("go on").exists():
    time.sleep(0.05)
plt.plot([0, 1]);""",
]
OURS = ".vmc-demo:not(.vmc-still), .vmc-live, .vmc-check"
OURS += ", .jp-OutputArea table, .jp-OutputArea details"  # folded numbers, exercises' verdicts


@contextmanager
def serve(home, *files):
    """The address of a JupyterLab in the folder `home`, with copies of some of the book's files."""
    book = home / "book"
    book.mkdir()
    for file in files:
        shutil.copy(ROOT / "book" / file, book)
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3"}}
    cells = [*map(nbformat.v4.new_code_cell, LONG_CHAPTER)]
    nbformat.write(nbformat.v4.new_notebook(cells=cells, metadata=kernel), book / "long.ipynb")
    profile = home / "IPYTHONDIR" / "profile_default"
    profile.mkdir(parents=True)
    shutil.copy(ROOT / ".binder" / "ipython_kernel_config.py", profile)
    folders = ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTERLAB_WORKSPACES_DIR", "IPYTHONDIR")
    environment = os.environ | {name: str(home / name) for name in folders}
    environment |= {"JUPYTERLAB_SETTINGS_DIR": str(home / "settings"), "VMC_RENDER_MODE": ""}
    environment |= {"PYTHONPATH": str(ROOT), "OMP_NUM_THREADS": "1"}
    environment.pop("MPLBACKEND", None)  # a reader's plots stand below the cell
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    options = f"--no-browser --allow-root --ip=127.0.0.1 --port={port}"
    options += " --ServerApp.port_retries=0 --IdentityProvider.token=secret"
    options += f" --LabApp.expose_app_in_browser=True --ServerApp.root_dir={book}"
    options += " --JupyterNotebookApp.expose_app_in_browser=True"
    options += f" --LabApp.app_settings_dir={ROOT / '.binder'}"  # as make lab does
    command = [sys.executable, "-m", "jupyterlab", *options.split()]
    with open(home / "log", "w", encoding="utf-8") as log:
        lab = subprocess.Popen(command, env=environment, stdout=log, stderr=log)
    while not listens(port):
        with suppress(subprocess.TimeoutExpired):
            lab.wait(0.1)  # to ask without a pause would take its processor
        assert lab.poll() is None, (home / "log").read_text(encoding="utf-8")
    yield f"http://127.0.0.1:{port}"
    lab.terminate()
    lab.wait()


def run(page, script, asked=None):
    """Run a script that may use the open `panel`, its `notebook` and `kernel`, and `asked`."""
    given = "const panel = jupyterapp.shell.currentWidget, notebook = panel.content;"
    given += "const kernel = panel.sessionContext.session?.kernel;"
    return page.evaluate(f"async (asked) => {{ {given} {script} }}", asked)


def command(page, name, **options):
    """Start one of JupyterLab's commands, and go on at once."""
    script = "([name, options]) => void jupyterapp.commands.execute(name, options)"
    page.evaluate(script, [name, options])


def wait_until_open(page):
    page.wait_for_selector(".jp-NotebookPanel .jp-Cell")
    page.evaluate("() => jupyterapp.restored")
    run(
        page,
        """await panel.context.ready; await panel.revealed; await panel.sessionContext.ready;
        await panel.sessionContext.session.kernel.info;""",
    )


def outputs(page, kind):
    """All outputs of a kind in the notebook, as JSON."""
    script = """return notebook.widgets.flatMap((cell) => cell.model.outputs?.toJSON() ?? [])
      .filter((output) => output.output_type === asked);"""
    return run(page, script, kind)


def execute(page, code):
    """Run code in the chapter's kernel, as a reader's new cell would."""
    run(page, "await kernel.requestExecute({ code: asked }).done;", code)


def add_cell(page, code):
    """Write code into a new cell at the notebook's end, and run it."""
    run(
        page,
        """notebook.activeCellIndex = notebook.widgets.length - 1;
        await jupyterapp.commands.execute("notebook:insert-cell-below");
        notebook.activeCell.model.sharedModel.setSource(asked);
        await jupyterapp.commands.execute("notebook:run-cell");""",
        code,
    )


def wait_for_controls(page):
    """Wait until the kernel has answered all demos: until then their controls take no key."""
    page.wait_for_function(
        "() => document.querySelectorAll('.vmc-demo[data-ready]').length > 1"
        " && !document.querySelector('.vmc-demo[data-closed]')"
    )


def choose_cell(page, words):
    """Make the cell whose source has these words the active one, in sight."""
    script = """notebook.activeCellIndex = notebook.widgets.findIndex((cell) =>
        cell.model.sharedModel.getSource().includes(asked));
      notebook.scrollToItem(notebook.activeCellIndex, "center");"""
    run(page, script, words)


def prose(page):
    """The text of each cell of prose, but for code and formulas that are set."""
    return run(
        page,
        """const shown = [];
        for (const [i, cell] of notebook.widgets.entries()) {
          if (cell.model.type !== "markdown" || cell.inputHidden) continue;
          await notebook.scrollToItem(i);
          const words = () => {
            const prose = cell.node.querySelector(".jp-RenderedMarkdown")?.cloneNode(true);
            prose?.querySelectorAll("code, mjx-container").forEach((part) => part.remove());
            return prose?.textContent.trim();
          };
          for (let frames = 600; frames-- && (!words() || words().includes("$")); )
            await new Promise(requestAnimationFrame); // formulas are set a little later
          shown.push(words());
        }
        return shown;""",
    )


def push(control):
    """Move a slider to its end, or where it stands there, to its beginning."""
    control.focus()
    control.press(control.evaluate("(input) => input.value === input.max ? 'Home' : 'End'"))


def move(page, control):
    """Push a slider until its demo, which is returned, shows another picture or an error."""
    demo = control.locator("xpath=ancestor::figure")
    before = demo.locator(".vmc-pictures").inner_html()
    push(control)
    page.wait_for_function(
        "([demo, before]) => !demo.hasAttribute('aria-busy') && (demo.querySelector('.vmc-error')"
        ".textContent || demo.querySelector('.vmc-pictures').innerHTML !== before)",
        arg=[demo.element_handle(), before],
    )
    return demo


def assert_readable(page):
    """Every text of ours has a contrast of at least 4.5, in the light theme and in the dark."""
    if not page.evaluate("() => 'axe' in window"):
        page.evaluate(AXE)
    for theme in ("Light", "Dark"):
        command(page, "apputils:change-theme", theme=f"JupyterLab {theme}")
        page.wait_for_function(
            "(light) => document.body.dataset.jpThemeLight === light"
            " && document.querySelector('.vmc-demo')",
            arg=str(theme == "Light").lower(),
        )
        page.evaluate("() => document.querySelectorAll('details').forEach((d) => (d.open = true))")
        found = page.evaluate(
            "(ours) => axe.run({ include: ours.split(', ').filter((one) =>"
            " document.querySelector(one)).map((one) => [one]) },"
            " { runOnly: ['color-contrast'], preload: false }).then((all) => all.violations)",
            OURS,
        )
        assert [node["html"] for rule in found for node in rule["nodes"]] == []
        ground, texts = page.evaluate(
            """() => {
              const style = (where, name) =>
                [...document.querySelectorAll(where)].map((one) => getComputedStyle(one)[name]);
              return [style(".jp-NotebookPanel .jp-Notebook", "backgroundColor")[0],
                style(".vmc-demo svg text:not([paint-order])", "fill")]; }"""
        )
        pairs = [sorted(map(luminance, (ground, text))) for text in {*texts}]
        assert pairs
        assert min((light + 0.05) / (dark + 0.05) for dark, light in pairs) >= 4.5


def luminance(colour):
    """The relative luminance of a colour "rgb(r, g, b)"."""
    channel = np.array(re.findall(r"[\d.]+", colour)[:3], float) / 255
    linear = np.where(channel <= 0.04045, channel / 12.92, ((channel + 0.055) / 1.055) ** 2.4)
    return linear @ [0.2126, 0.7152, 0.0722]


def heap_used(page):
    """Bytes of the page's objects that are still needed."""
    session = page.context.new_cdp_session(page)
    session.send("HeapProfiler.collectGarbage")
    used = session.send("Runtime.getHeapUsage")["usedSize"]
    session.detach()
    return used
