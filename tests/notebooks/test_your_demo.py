"""Write your own demo, in JupyterLab: ipywidgets and ours move each other."""

import pytest

from tests import lab

pytestmark = pytest.mark.browser
LINKED = """from ipywidgets import jslink
left = widget(lambda k: f"<p>left {k}</p>", k=(0, 4))
right = widget(lambda k: f"<p>right {k}</p>", k=(0, 4))
wire = jslink((left, "value"), (right, "value"))
HBox([left, right])"""


def test_demos_in_a_box_follow_ipywidgets_python_and_one_another(run_all):
    page = run_all("your_demo")
    box = page.locator(".widget-box:has(.vmc-demo[data-ready])")
    box.scroll_into_view_if_needed()
    plot, arm = box.get_by_role("slider", name="elbow").all()
    plot.press("End")
    page.wait_for_function("(arm) => arm.value === arm.max", arg=arm.element_handle())
    box.get_by_text("120°", exact=True).wait_for()
    lab.execute(page, "elbow.value = 0")
    for slider in (plot, arm):
        page.wait_for_function("(slider) => slider.value === '0'", arg=slider.element_handle())
    first = page.locator(".vmc-demo[data-ready] input[type=range]").first
    assert first.input_value() == "1"  # where a later cell has put it
    lab.execute(page, "demo.value = {'rise': 0.05}")
    page.wait_for_function("(first) => first.value === '4'", arg=first.element_handle())
    lab.add_cell(page, LINKED)
    page.get_by_text("left 2", exact=True).wait_for()
    lab.wait_for_controls(page)
    page.locator("figure", has_text="left").get_by_role("slider").press("End")
    page.get_by_text("left 4", exact=True).wait_for()
    page.get_by_text("right 4", exact=True).wait_for()
