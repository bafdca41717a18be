"""The chapters in JupyterLab, as a reader runs them: a real server, a real browser."""

import os
import re
import shutil
import socket
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from urllib.parse import unquote

import nbformat
import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import expect

from tests.conftest import AXE

pytestmark = pytest.mark.browser
ROOT = Path(__file__).parents[1]
CHAPTERS = {"02_candidates", "07_muscle", "08_arm"}  # plots, photos, an upload; scenes, the arm
NOTEBOOK = "const panel = jupyterapp.shell.currentWidget, notebook = panel.content;"
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
OURS = ".vmc-demo:not(.vmc-still), .vmc-live, .vmc-predict, .vmc-check"
OURS += ", .jp-OutputArea table, .jp-OutputArea details"  # folded numbers, exercises' verdicts


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    """The address and the folder of a JupyterLab of its own, with copies of some chapters."""
    home = tmp_path_factory.mktemp("lab")
    (home / "book").mkdir()
    for file in (*(f"{chapter}.ipynb" for chapter in CHAPTERS), "glossary.md"):
        shutil.copy(ROOT / "book" / file, home / "book")
    cells = map(nbformat.v4.new_code_cell, LONG_CHAPTER)
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3"}}
    long = nbformat.v4.new_notebook(cells=list(cells), metadata=kernel)
    nbformat.write(long, home / "book/long.ipynb")
    folders = ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTERLAB_WORKSPACES_DIR", "IPYTHONDIR")
    told = os.environ | {name: str(home / name) for name in folders}
    told |= {"JUPYTERLAB_SETTINGS_DIR": str(home / "settings"), "VMC_RENDER_MODE": ""}
    told |= {"PYTHONPATH": str(ROOT), "OMP_NUM_THREADS": "1"}
    told.pop("MPLBACKEND", None)  # a reader's plots stand below the cell
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    options = f"--no-browser --allow-root --ip=127.0.0.1 --port={port}"
    options += " --ServerApp.port_retries=0 --IdentityProvider.token=secret"
    options += f" --LabApp.expose_app_in_browser=True --ServerApp.root_dir={home / 'book'}"
    options += f" --LabApp.app_settings_dir={ROOT / '.binder'}"  # as make lab does
    command = [sys.executable, "-m", "jupyterlab", *options.split()]
    with open(home / "log", "w", encoding="utf-8") as log:
        lab = subprocess.Popen(command, env=told, stdout=log, stderr=log)
    while not listens(port):
        with suppress(subprocess.TimeoutExpired):
            lab.wait(0.1)  # to ask without a pause would take its processor
        assert lab.poll() is None, (home / "log").read_text(encoding="utf-8")
    yield f"http://127.0.0.1:{port}", home / "book"
    lab.terminate()
    lab.wait()


def listens(port):
    with socket.socket() as knock:
        return knock.connect_ex(("127.0.0.1", port)) == 0


@pytest.fixture(scope="module")
def window(chromium):
    """A browser window that reaches this machine alone, and keeps JupyterLab once it is loaded."""
    # all that is not on this machine leads nowhere
    nowhere = {"server": "http://127.0.0.1:9", "bypass": "127.0.0.1"}
    context = chromium.new_context(viewport={"width": 1200, "height": 900}, proxy=nowhere)
    context.set_default_timeout(600_000)  # ends a hang, never a busy machine's work
    yield context
    context.close()


@pytest.fixture
def visit(window, server):
    """A function that opens a chapter and returns the page."""
    pages = []

    def visit(chapter):
        page = window.new_page()
        pages.append(page)
        page.faults = []
        page.on("dialog", lambda dialog: dialog.accept())
        page.on("pageerror", lambda error: page.faults.append(f"{error} {error.stack}"))
        page.on(
            "console",
            lambda said: (
                said.type == "error" and page.faults.append(f"{said.text} {said.location['url']}")
            ),
        )
        page.goto(f"{server[0]}/lab/tree/{chapter}.ipynb?token=secret&reset")
        ready(page)
        page.evaluate("() => jupyterapp.shell.collapseLeft()")
        return page

    yield visit
    for page in pages:
        page.close()
        ours = [f for f in page.faults if re.search(r"vmc|blob:|anywidget|MeshCat|mujoco", f)]
        assert ours == []


@pytest.fixture
def run_all(visit):
    """A function that opens a chapter, reads its prose, runs all of it, and returns the page."""

    def run_all(chapter):
        page = visit(chapter)
        assert_prose(page)
        page.evaluate("() => jupyterapp.commands.execute('notebook:run-all-cells')")
        assert outputs(page, "error") == []
        page.wait_for_function(
            "() => document.querySelectorAll('.vmc-demo[data-ready]').length > 1"
            " && !document.querySelector('.vmc-demo[data-closed]')"
        )
        return page

    return run_all


def ready(page):
    page.wait_for_selector(".jp-NotebookPanel .jp-Cell")
    page.evaluate(
        "async () => { await jupyterapp.restored; "
        + NOTEBOOK
        + """
          await panel.context.ready; await panel.revealed; await panel.sessionContext.ready;
          await panel.sessionContext.session.kernel.info; }"""
    )


def outputs(page, kind):
    """All outputs of a kind in the notebook, as JSON."""
    return page.evaluate(
        "(kind) => { "
        + NOTEBOOK
        + """
          return notebook.widgets.flatMap((cell) => cell.model.outputs?.toJSON() ?? [])
            .filter((output) => output.output_type === kind); }""",
        kind,
    )


def execute(page, code):
    """Run code in the chapter's kernel, as a reader's new cell would."""
    page.evaluate(
        "(code) => { "
        + NOTEBOOK
        + """
          return panel.sessionContext.session.kernel.requestExecute({ code }).done; }""",
        code,
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
    for theme in ("Light", "Dark"):
        page.evaluate(
            "(theme) => jupyterapp.commands.execute('apputils:change-theme', { theme })",
            f"JupyterLab {theme}",
        )
        page.wait_for_function(
            "(light) => document.body.dataset.jpThemeLight === light"
            " && document.querySelector('.vmc-predict')",
            arg=str(theme == "Light").lower(),
        )
        page.evaluate("() => document.querySelectorAll('details').forEach((d) => (d.open = true))")
        if not page.evaluate("() => 'axe' in window"):
            page.evaluate(AXE.read_text(encoding="utf-8"))
        found = page.evaluate(
            "(ours) => axe.run({ include: ours.split(', ').filter((one) =>"
            " document.querySelector(one)).map((one) => [one]) },"
            " { runOnly: ['color-contrast'], preload: false }).then((all) => all.violations)",
            OURS,
        )
        assert [node["html"] for rule in found for node in rule["nodes"]] == []
        colours = page.evaluate(
            """() => {
              const style = (where, name) =>
                [...document.querySelectorAll(where)].map((one) => getComputedStyle(one)[name]);
              return [style(".jp-NotebookPanel .jp-Notebook", "backgroundColor")[0],
                style(".vmc-demo svg text:not([paint-order])", "fill")]; }"""
        )
        ground, texts = luminance(colours[0]), {*map(luminance, colours[1])}
        ratios = [(max(ground, t) + 0.05) / (min(ground, t) + 0.05) for t in texts]
        assert ratios
        assert min(ratios) >= 4.5


def luminance(colour):
    """The relative luminance of a colour "rgb(r, g, b)"."""
    channel = np.array(re.findall(r"[\d.]+", colour)[:3], float) / 255
    linear = np.where(channel <= 0.04045, channel / 12.92, ((channel + 0.055) / 1.055) ** 2.4)
    return linear @ [0.2126, 0.7152, 0.0722]


PROSE = """async () => {
  const { content: notebook } = jupyterapp.shell.currentWidget, shown = [];
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
  return shown; }"""


def assert_prose(page):
    """The text shows no markup."""
    shown = page.evaluate(PROSE)
    assert len(shown) > 10
    assert not re.findall(r"\{[a-z-]+\}|```|:::|\]\(|\$|:[a-z]+: ", "\n".join(shown))


def test_links_open_as_something_to_read(visit):
    page = visit("07_muscle")
    for href, opened, words in (
        ("08_arm.ipynb", ".jp-NotebookPanel", "six muscles on two joints"),
        ("glossary.md", ".jp-MarkdownViewer", "excitation¶"),  # the term, not the page's top
    ):
        page.get_by_role("tab", name="07_muscle.ipynb").click()
        # "/files/" stands in a link that has its handler
        page.wait_for_function(  # one within a fold, too
            "(link) => { link = document.querySelector(link); link?.click(); return link; }",
            arg=f".jp-RenderedMarkdown a[href*='/files/{href}']",
        )
        said = page.locator(f"{opened}:visible").get_by_text(words).filter(visible=True)
        expect(said.first).to_be_in_viewport(timeout=600_000)  # its source is there too, and hidden


def test_a_quiz_is_answered_without_a_kernel(visit):
    page = visit("07_muscle")
    question = "resists. What resists"
    page.evaluate(
        "(question) => { "
        + NOTEBOOK
        + """ notebook.activeCellIndex = notebook.widgets.findIndex((cell) =>
            cell.model.sharedModel.getSource().includes(question));
          notebook.scrollToItem(notebook.activeCellIndex, "center"); }""",
        question,
    )
    quiz = page.locator(".jp-MarkdownCell", has_text=question)
    spring = quiz.locator("details", has_text="The passive spring")
    assert not spring.get_by_text("✓").is_visible()
    spring.locator("summary").click()
    assert spring.get_by_text("✓").is_visible()


def test_a_plot_moves_fails_aloud_and_leaves_a_still(run_all):
    page = run_all("07_muscle")
    slider = page.locator(".vmc-demo[data-ready] input[type=range]").first
    demo = move(page, slider)
    here = demo.locator(".vmc-pictures").inner_html()
    move(page, slider)
    execute(page, "muscle.TAU_DEACTIVATION = 0.2")  # change a line, see it move
    move(page, slider)
    assert demo.locator(".vmc-pictures").inner_html() != here
    execute(page, "def no_paper(*_, **__): raise OSError('no paper left')")
    execute(page, "panels, figures.panels = figures.panels, no_paper")
    move(page, slider)
    said = demo.locator(".vmc-error").text_content()
    assert "OSError: no paper left" in said
    assert "It was asked for {" in said
    execute(page, "figures.panels = panels")
    push(slider)
    page.wait_for_function(
        "(demo) => !demo.querySelector('.vmc-error').textContent", arg=demo.element_handle()
    )
    assert "Not answered yet." in page.locator(".vmc-check").first.text_content()
    folded = page.evaluate(
        "() => { "
        + NOTEBOOK
        + """ const draws = (cell) => /explore\\(/.test(cell.model.sharedModel.getSource());
          return notebook.widgets.filter((cell) => cell.model.type === "code" && draws(cell))
            .map((cell) => cell.inputHidden); }"""
    )
    assert all(folded)
    assert_readable(page)
    line = demo.locator(".vmc-picture path").last.get_attribute("d")
    number = demo.get_attribute("id")
    page.wait_for_function(  # what the reader rests on has been kept
        "([name, line]) => decodeURIComponent(document.getElementById(name + '-still').innerHTML)"
        ".includes(line)",
        arg=[number, line],
    )
    page.evaluate(
        "async () => { "
        + NOTEBOOK
        + """
          await panel.context.save(); await panel.sessionContext.session.kernel.restart(); }"""
    )
    page.reload()
    ready(page)
    still = page.locator(f"#{number}-still")
    still.scroll_into_view_if_needed()
    still.get_by_text("Run > Run All Cells to make it move").wait_for()
    assert line in unquote(still.inner_html())
    assert not page.get_by_text("model not found").first.is_visible()


def test_scenes_and_the_arm_move_and_leave_nothing_behind(run_all):
    page = run_all("08_arm")
    scene = page.locator(".vmc-demo[data-ready]:has(.vmc-scene)").first
    scene.scroll_into_view_if_needed()
    scene.locator(".vmc-scene canvas").wait_for()
    capture = "(demo) => vmcScene(demo.querySelector('.vmc-scene')).viewer.capture_image()"
    before = scene.evaluate(capture)
    slider = scene.locator("input[data-stride][type=range]").first
    slider.focus()
    slider.press("End")
    page.wait_for_function(
        f"([demo, before]) => ({capture})(demo) !== before", arg=[scene.element_handle(), before]
    )
    heap = []
    for _ in range(4):  # run, and run again three times
        arm = page.locator(".vmc-live[data-ready]").first
        arm.scroll_into_view_if_needed()
        arm.locator("[name=main]").click()
        page.wait_for_function(
            "() => /running/.test(document.querySelector('.vmc-live [role=status]').textContent)"
        )
        heap.append(heap_used(page))
        page.evaluate(
            "() => { "
            + NOTEBOOK
            + """
              notebook.activeCellIndex = notebook.widgets.findIndex((cell) =>
                /live_arm\\(/.test(cell.model.sharedModel.getSource()));
              return jupyterapp.commands.execute("notebook:run-cell"); }"""
        )
    assert heap[-1] - heap[0] < 15e6, heap
    assert_readable(page)


def heap_used(page):
    """Bytes of the page's objects that are still needed."""
    session = page.context.new_cdp_session(page)
    session.send("HeapProfiler.collectGarbage")
    used = session.send("Runtime.getHeapUsage")["usedSize"]
    session.detach()
    return used


def test_photos_move_and_the_readers_own_is_seen_whatever_its_size(run_all, tmp_path):
    page = run_all("02_candidates")
    move(page, page.locator(".vmc-demo[data-ready]:has(image) input[type=range]").first)
    noise = np.random.default_rng(0).integers(0, 255, (3000, 4000, 3), np.uint8)
    Image.fromarray(noise).save(tmp_path / "phone.jpg", quality=95)
    assert (tmp_path / "phone.jpg").stat().st_size > 10e6
    upload = page.locator(".vmc-demo:has(input[type=file]:not([hidden]))")
    upload.locator("input").set_input_files(tmp_path / "phone.jpg")
    upload.locator("svg image").wait_for()
    assert upload.locator("[role=status]").text_content() == "phone.jpg: seen."
    (tmp_path / "words.jpg").write_text("no picture", encoding="utf-8")
    upload.locator("input").set_input_files(tmp_path / "words.jpg")
    upload.get_by_text("cannot read it").wait_for()
    assert upload.locator("svg").count() == 0
    assert_readable(page)


def test_a_chapter_that_is_closed_keeps_no_kernel(visit, server):
    page = visit("08_arm")
    session = "() => jupyterapp.shell.currentWidget.sessionContext.session?.kernel"
    page.wait_for_function(session)

    def runs():
        running = page.request.get(f"{server[0]}/api/sessions?token=secret").json()
        return "08_arm.ipynb" in [each["name"] for each in running]

    assert runs()
    page.evaluate("() => jupyterapp.commands.execute('docmanager:save')")  # or it asks whether to
    page.evaluate("() => void jupyterapp.commands.execute('application:close')")
    for _ in range(600):  # ends a hang, never a busy machine's work
        if runs():
            page.wait_for_timeout(1000)
    assert not runs()


RUN_ALL = "() => void jupyterapp.commands.execute('notebook:run-all-cells')"  # and go on at once


@pytest.fixture
def long_chapter(visit, server):
    """A chapter whose last cell runs until its `go on` lies in the folder: its page, that file."""
    page, folder = visit("long"), server[1]
    page.evaluate(RUN_ALL)
    yield page, folder / "go on"
    for mark in ("running", "go on"):
        (folder / mark).unlink(missing_ok=True)


def move_only_demo(page):
    """Move the demo's slider as soon as it can be: what it then shows, in words."""
    page.wait_for_selector("input[type=range]:enabled")
    demo = move(page, page.locator("input[type=range]"))
    return demo.locator(".vmc-pictures").get_attribute("aria-label")


def test_a_demo_moves_while_the_chapter_still_runs(long_chapter):
    page, go_on = long_chapter
    assert move_only_demo(page) == "up to 3"
    assert (go_on.parent / "running").exists()
    assert outputs(page, "error") == []
    go_on.touch()
    last = f"() => {{ {NOTEBOOK} return notebook.widgets.at(-1).model.outputs.length; }}"
    page.wait_for_function(last)
    pictures = [out for out in outputs(page, "display_data") if "image/png" in out["data"]]
    assert len(pictures) == 1  # the cell's own


def test_a_restart_in_the_middle_leaves_no_dead_demo(long_chapter):
    page, go_on = long_chapter
    page.wait_for_selector(".vmc-demo[data-ready]")
    restart = f"async () => {{ {NOTEBOOK} await panel.sessionContext.session.kernel.restart(); }}"
    page.evaluate(restart)
    page.get_by_text("The kernel has gone: Run > Run All Cells").wait_for()
    assert page.locator("input[type=range]").is_disabled()
    page.evaluate(RUN_ALL)
    page.get_by_text("The kernel has gone").wait_for(state="detached")
    assert move_only_demo(page) == "up to 3"
    assert not go_on.exists()
