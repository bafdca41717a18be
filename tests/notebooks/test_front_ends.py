"""A chapter in Notebook 7, in the hands of somebody else, and in a window that is late."""

import nbformat
import pytest

from tests import lab
from tests.notebooks.conftest import LATE

pytestmark = [pytest.mark.browser, pytest.mark.audit]


def test_notebook_7_runs_a_chapter_and_whoever_gets_it_untrusted_sees_stills(
    run_all, visit, server
):
    page = run_all("16_noise", "notebooks")
    assert page.locator(".jp-mod-outputsScrolled").count() == 0  # a demo is seen whole
    lab.move(page, page.locator(".vmc-demo[data-ready] input[type=range]").first)
    lab.run(page, "await panel.context.save();")
    chapter = nbformat.read(server[1] / "16_noise.ipynb", as_version=4)
    chapter.cells[0].source += "\n\nFrom another machine."  # whose signature nobody here knows
    nbformat.write(chapter, server[1] / "elsewhere.ipynb")
    for app in ("notebooks", "lab/tree"):
        page = visit("elsewhere", app)
        lab.choose_cell(page, "explore(")
        still = page.locator(".vmc-still").first
        still.get_by_text("Run > Run All Cells to make it move").wait_for()
        width = "(still) => still.querySelector('img').naturalWidth"
        assert still.evaluate(width) > 100
        trusted = "return notebook.widgets.some((cell) => cell.model.trusted && cell.outputArea);"
        assert not lab.run(page, trusted)
        outcome = page.locator("details", has_text="What came out").locator("p").first
        outcome.wait_for(state="attached")
        assert not outcome.is_visible()


def test_a_demo_that_loads_late_moves_all_the_same(visit):
    """Anywidget waits two seconds for a model; of a later one it drops all messages."""
    page = visit("07_muscle")
    page.evaluate("""() => {
      AbortSignal.timeout = () => {
        const late = new AbortController();
        setTimeout(() => late.abort());
        return late.signal;
      }; }""")
    page.evaluate("() => jupyterapp.commands.execute('notebook:run-all-cells')")
    page.wait_for_selector(".vmc-demo[data-ready]:not([data-closed])")
    lab.move(page, page.locator(".vmc-demo[data-ready] input[type=range]").first)
    assert any(LATE in error for error in page.errors)
