"""The chapters in JupyterLab, as a reader runs them: a real server, a real browser."""

from urllib.parse import unquote

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import expect

from tests import lab
from tests.pages import CAPTURE

pytestmark = pytest.mark.browser
PLOT = ".vmc-demo[data-ready]:has(svg[data-axes])"  # not the drawing that opens a chapter


@pytest.mark.audit
def test_a_quiz_is_answered_without_a_kernel_and_links_open_as_something_to_read(visit):
    page, question = visit("07_muscle"), "resists. What resists"
    lab.choose_cell(page, question)
    quiz = page.locator(".jp-MarkdownCell", has_text=question)
    spring = quiz.locator("details", has_text="The passive spring")
    assert not spring.get_by_text("✓").is_visible()
    spring.locator("summary").click()
    assert spring.get_by_text("✓").is_visible()
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
        text = page.locator(f"{opened}:visible").get_by_text(words).filter(visible=True)
        expect(text.first).to_be_in_viewport(timeout=600_000)  # its source is there too, and hidden


@pytest.mark.audit
def test_a_demo_keeps_its_keys_and_leaves_shortcuts_to_jupyterlab(run_all):
    page = run_all("07_muscle")
    demo = page.locator(PLOT).first
    assert demo.locator(".vmc-listen").count() == 1
    slider, name = demo.locator("input[type=range]").first, demo.get_attribute("id")
    cells = "return notebook.widgets.length;"
    before = slider.input_value(), lab.run(page, cells)
    for key in ("ArrowLeft", "d", "d"):  # two of which, in the notebook, delete a cell
        slider.press(key)
    assert slider.input_value() != before[0]
    assert lab.run(page, cells) == before[1]
    unsaved = "jupyterapp.shell.currentWidget.context.model.dirty"
    page.wait_for_function(f"() => {unsaved}")
    slider.press("Control+s")
    page.wait_for_function(f"() => !{unsaved}")
    slider.press("Escape")
    page.wait_for_function("() => document.activeElement.matches('.jp-Cell.jp-mod-active')")
    slider.press("Shift+Enter")  # runs the cell again
    page.locator(f"#{name}").wait_for(state="detached")


@pytest.mark.audit
def test_a_plot_follows_the_kernel_shows_its_errors_and_leaves_a_still(run_all):
    page = run_all("07_muscle")
    slider = page.locator(f"{PLOT} input[type=range]").first
    demo = lab.move(page, slider)
    before = demo.locator(".vmc-pictures").inner_html()
    lab.move(page, slider)
    lab.execute(page, "rate = lambda u, a: (u - a) / 0.2")  # change a law, see it move
    lab.move(page, slider)
    assert demo.locator(".vmc-pictures").inner_html() != before
    lab.execute(page, "def no_paper(*_, **__): raise OSError('no paper left')")
    lab.execute(page, "panels, figures.panels = figures.panels, no_paper")
    lab.move(page, slider)
    error = demo.locator(".vmc-error").text_content()
    assert "OSError: no paper left" in error
    assert "It was asked for {" in error
    lab.execute(page, "figures.panels = panels")
    lab.push(slider)
    page.wait_for_function(
        "(demo) => !demo.querySelector('.vmc-error').textContent", arg=demo.element_handle()
    )
    assert "Not answered yet." in page.locator(".vmc-check").first.text_content()
    folded = """const draws = (cell) => /explore\\(/.test(cell.model.sharedModel.getSource());
      return notebook.widgets.filter((cell) => cell.model.type === "code" && draws(cell))
        .map((cell) => cell.inputHidden);"""
    assert all(lab.run(page, folded))
    lab.assert_readable(page)
    line = demo.locator(".vmc-picture path").last.get_attribute("d")
    name = demo.get_attribute("id")
    page.wait_for_function(  # what the reader rests on has been kept
        "([name, line]) => decodeURIComponent(document.getElementById(name + '-still').innerHTML)"
        ".includes(line)",
        arg=[name, line],
    )
    lab.run(page, "await panel.context.save(); await kernel.restart();")
    page.reload()
    lab.wait_until_open(page)
    still = page.locator(f"#{name}-still")
    still.scroll_into_view_if_needed()
    still.get_by_text("Run > Run All Cells to make it move").wait_for()
    assert line in unquote(still.inner_html())
    lost = page.locator(f".jp-OutputArea-child:has(#{name}-still) + *", has_text="model not found")
    lost.wait_for(state="attached")
    assert not lost.is_visible()


@pytest.mark.audit
def test_scenes_and_the_arm_move_and_free_their_memory(run_all):
    page = run_all("08_arm")
    scene = page.locator(".vmc-demo[data-ready]:has(.vmc-scene)").first
    scene.scroll_into_view_if_needed()
    scene.locator(".vmc-scene canvas").wait_for()
    picture = scene.locator(".vmc-scene").first
    before = picture.evaluate(CAPTURE)
    scene.locator("input[data-stride][type=range]").first.press("End")
    page.wait_for_function(
        f"([div, before]) => ({CAPTURE})(div) !== before", arg=[picture.element_handle(), before]
    )
    heap = []
    for _ in range(4):  # run, and run again three times
        arm = page.locator(".vmc-live[data-ready]").first
        arm.scroll_into_view_if_needed()
        arm.locator("[name=main]").click()
        page.wait_for_function(
            "() => /running/.test(document.querySelector('.vmc-live [role=status]').textContent)"
        )
        heap.append(lab.heap_used(page))
        lab.choose_cell(page, "live_arm(")
        page.evaluate("() => jupyterapp.commands.execute('notebook:run-cell')")
    assert heap[-1] - heap[0] < 15e6, heap
    lab.assert_readable(page)


@pytest.mark.audit
def test_photos_move_and_the_readers_own_is_seen_whatever_its_size(run_all, tmp_path):
    page = run_all("02_candidates")
    lab.move(page, page.locator(".vmc-demo[data-ready]:has(image) input[type=range]").first)
    noise = np.random.default_rng(0).integers(0, 255, (3000, 4000, 3), np.uint8)
    Image.fromarray(noise).save(tmp_path / "phone.jpg", quality=95)
    assert (tmp_path / "phone.jpg").stat().st_size > 10e6
    upload = page.locator(".vmc-demo:has(input[type=file]:not([hidden]))")
    upload.locator("input").set_input_files(tmp_path / "phone.jpg")
    upload.locator("svg image").wait_for()
    assert upload.locator("[role=status]").text_content() == "phone.jpg: seen."
    (tmp_path / "words.jpg").write_text("no picture", encoding="utf-8")
    upload.locator("input").set_input_files(tmp_path / "words.jpg")
    upload.get_by_text("cannot read").wait_for()
    assert upload.locator("svg").count() == 0
    lab.assert_readable(page)


@pytest.mark.audit
def test_a_chapter_that_is_closed_keeps_no_kernel(visit, server):
    page = visit("08_arm")

    def runs():
        running = page.request.get(f"{server[0]}/api/sessions?token=secret").json()
        return "08_arm.ipynb" in [each["name"] for each in running]

    assert runs()
    page.evaluate("() => jupyterapp.commands.execute('docmanager:save')")  # or it asks whether to
    lab.command(page, "application:close")
    for _ in range(600):  # ends a hang, never a busy machine's work
        if runs():
            page.wait_for_timeout(1000)
    assert not runs()


@pytest.fixture
def long_chapter(visit, server):
    """A chapter whose last cell runs until its `go on` lies in the folder: its page, that file."""
    page, folder = visit("long"), server[1]
    lab.command(page, "notebook:run-all-cells")
    yield page, folder / "go on"
    for mark in ("running", "go on"):
        (folder / mark).unlink(missing_ok=True)


def move_only_demo(page):
    """Move the demo's slider as soon as it can be: what it then shows, in words."""
    page.wait_for_selector("input[type=range]:enabled")
    demo = lab.move(page, page.locator("input[type=range]"))
    return demo.locator(".vmc-pictures").get_attribute("aria-label")


@pytest.mark.audit
def test_a_demo_moves_while_the_chapter_still_runs(long_chapter):
    page, go_on = long_chapter
    assert move_only_demo(page) == "up to 3"
    assert (go_on.parent / "running").exists()
    assert lab.outputs(page, "error") == []
    go_on.touch()
    last = "jupyterapp.shell.currentWidget.content.widgets.at(-1)"
    page.wait_for_function(f"() => {last}.model.outputs.length")
    pictures = [out for out in lab.outputs(page, "display_data") if "image/png" in out["data"]]
    assert len(pictures) == 1  # the cell's own


@pytest.mark.audit
def test_a_restart_in_the_middle_leaves_no_dead_demo(long_chapter):
    page, go_on = long_chapter
    page.wait_for_selector(".vmc-demo[data-ready]")
    lab.run(page, "await kernel.restart();")
    page.get_by_text("The kernel has gone: Run > Run All Cells").wait_for()
    assert page.locator("input[type=range]").is_disabled()
    lab.command(page, "notebook:run-all-cells")
    page.get_by_text("The kernel has gone").wait_for(state="detached")
    assert move_only_demo(page) == "up to 3"
    assert not go_on.exists()
