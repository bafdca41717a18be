"""What Python gives to the arm in the page, and its widget in a live kernel."""

import json

import mujoco
import pytest

from page.arm import controls, live, live_arm
from tests.page.arm.controls import start, status
from tests.pages import ROOT, displayed
from tests.show.kernel import render


def test_the_versions_of_mujoco_are_those_of_the_files():
    manifest = json.loads((ROOT / "book/_static/vendor/manifest.json").read_bytes())
    (entry,) = [entry for entry in manifest if ROOT / entry["file"] == live.MUJOCO]
    assert controls.VERSIONS == {"Python": mujoco.__version__, "page": entry["version"]}


def test_an_unknown_mode_and_a_target_beyond_reach_are_refused():
    with pytest.raises(ValueError, match="choose one of"):
        live_arm("dance")
    with pytest.raises(ValueError, match="not surrounded"):
        live_arm("reach", target=(0.5, 0.5))


@pytest.fixture
def live_page(offline, monkeypatch):
    """An empty page, and a function that shows a live kernel's arm in it."""
    monkeypatch.setenv("VMC_RENDER_MODE", "live")
    page = offline.new_page()

    def show(*kernel):
        shown = displayed(monkeypatch, live)
        live_arm("bench")
        still, widget, _ = shown
        assert "Run > Run All Cells" in still.data
        render(page, widget, monkeypatch, *kernel)
        return page.locator(".vmc-live").first

    yield page, show
    page.close()


@pytest.mark.browser
def test_a_live_arm_moves_and_asks_no_kernel_that_has_gone(live_page):
    page, show = live_page
    mine = show("mine")
    show("other")  # of a chapter that was run later
    page.evaluate("() => { otherModel.closed = true }")
    start(mine)
    status(mine, "The arm is running")
    page.wait_for_selector(".vmc-scene canvas")


@pytest.mark.browser
def test_the_arm_says_that_the_kernel_has_gone(live_page):
    page, show = live_page
    arm = show()
    page.evaluate("() => { kernelModel.closed = true }")
    page.locator("[name=main]").click()
    status(arm, "The kernel has gone: Run > Run All Cells")
