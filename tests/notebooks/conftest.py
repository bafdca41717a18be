"""A JupyterLab with chapters of photos, plots and scenes, and a browser that visits it."""

import re

import pytest

from tests import lab
from tests.pages import observe

CHAPTERS = ("02_candidates", "07_muscle", "08_arm", "16_noise", "your_demo")
FILES = (*(f"{name}.ipynb" for name in CHAPTERS), "glossary.md")
ERROR = re.compile("vmc|blob:|anywidget|MeshCat|mujoco")  # what else complains is JupyterLab's
LATE = "[anywidget] Failed to initialize model"  # of a busy machine: our demos move all the same


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    """The address and the folder of a JupyterLab with chapters of photos, plots and scenes."""
    home = tmp_path_factory.mktemp("lab")
    with lab.serve(home, *FILES) as address:
        yield address, home / "book"


@pytest.fixture(scope="module")
def window(chromium):
    """A browser window that reaches this machine alone, and keeps JupyterLab once it is loaded."""
    nowhere = {"server": "http://127.0.0.1:9", "bypass": "127.0.0.1"}
    context = chromium.new_context(viewport={"width": 1200, "height": 900}, proxy=nowhere)
    context.set_default_timeout(600_000)  # ends a hang, never a busy machine's work
    yield context
    context.close()


@pytest.fixture
def visit(window, server):
    """A function that opens a chapter and returns the page."""
    pages = []

    def visit(chapter, app="lab/tree"):
        page = observe(window.new_page())
        pages.append(page)
        page.on("dialog", lambda dialog: dialog.accept())
        page.goto(f"{server[0]}/{app}/{chapter}.ipynb?token=secret&reset")
        lab.wait_until_open(page)
        page.evaluate("() => jupyterapp.shell.collapseLeft()")
        return page

    yield visit
    for page in pages:
        page.close()
        errors = [error for error in page.errors if LATE not in error]
        assert [error for error in errors if ERROR.search(error)] == []


@pytest.fixture
def run_all(visit):
    """A function that opens a chapter, whose prose shows no markup, and runs all of it."""

    def run_all(chapter, app="lab/tree"):
        page = visit(chapter, app)
        words = lab.prose(page)
        assert len(words) > 10
        assert not re.findall(r"\{[a-z-]+\}|```|:::|\]\(|\$|:[a-z]+: ", "\n".join(words))
        page.evaluate("() => jupyterapp.commands.execute('notebook:run-all-cells')")
        assert lab.outputs(page, "error") == []
        lab.wait_for_controls(page)
        return page

    return run_all
