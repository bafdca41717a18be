"""A live kernel's demo in a page: what its controls do while the kernel works, or has gone."""

from types import SimpleNamespace

import pytest

from tests.pages import displayed, observe
from tests.show.kernel import render
from vmc_lib.show import Slider, demo, explore
from vmc_lib.show.arm import arm_scene

pytestmark = pytest.mark.browser


@pytest.fixture
def live_demo(offline, monkeypatch):
    """A function that declares a demo in a live kernel, and returns a page with its widget."""
    pages = []

    def live_demo(draw, busy=False, **controls):
        monkeypatch.setenv("VMC_RENDER_MODE", "live")
        shown = displayed(monkeypatch, demo, SimpleNamespace(update=lambda still: None))
        widget = explore(draw, "c", "words", **controls)
        page = observe(offline.new_page())
        pages.append(page)
        page.set_content(shown[0].data)
        render(page, widget, monkeypatch, busy=busy)
        return page

    yield live_demo
    for page in pages:
        page.close()
        assert page.errors == []


def dot(k):
    return f'<svg width="20" height="20">\n<circle r="{k}"/>\n</svg>'


RADIUS = "() => document.querySelector('circle').getAttribute('r')"


def test_controls_stand_at_once_and_open_when_the_kernel_answers(live_demo):
    page = live_demo(dot, busy=True, k=Slider([1, 2, 3], "k"))
    slider = page.get_by_role("slider")
    assert slider.is_visible()
    assert slider.is_disabled()
    assert page.evaluate(RADIUS) == "1"
    page.get_by_text("The chapter is still running").wait_for()
    page.evaluate("() => (kernelModel.busy = false)")
    page.wait_for_function("() => !document.querySelector('input').disabled")
    assert not page.get_by_text("The chapter is still running").count()
    slider.press("End")
    page.wait_for_function(f"() => ({RADIUS})() === '3'")


def test_a_first_scene_needs_no_answer(live_demo):
    draw = lambda elbow: arm_scene([0, elbow])  # noqa: E731 (a demo's one line)
    page = live_demo(draw, busy=True, elbow=Slider([1.0, 1.4], "elbow"))
    scene = page.locator(".vmc-demo:not(.vmc-still) .vmc-scene")
    messages = scene.evaluate("(div) => vmc['demo/scene'].viewOf(div).messages.length")
    assert messages == len(draw(1.0).messages())


@pytest.mark.parametrize("way", ["emit('comm_live_update')", "closed = true"])
def test_a_demo_says_that_its_kernel_has_gone(live_demo, way):
    page = live_demo(dot, k=Slider([1, 2, 3], "k"))
    slider = page.get_by_role("slider")
    page.wait_for_function("() => !document.querySelector('input').disabled")
    slider.press("ArrowRight")
    page.wait_for_function(f"() => ({RADIUS})() === '2'")
    page.evaluate(f"() => {{ kernelModel.{way} }}")
    if slider.is_enabled():
        slider.press("ArrowRight")
    page.get_by_text("The kernel has gone: Run > Run All Cells").wait_for()
    assert slider.is_disabled()
    assert page.evaluate(RADIUS) == "2"
