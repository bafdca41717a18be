"""A reader writes a function in the page, and has it checked."""

import inspect

import pytest
from playwright.sync_api import expect

from tests.exercises import EVERY
from tests.page.python.conftest import MECHANISM

pytestmark = pytest.mark.browser
RIGHT_LINES = inspect.getsource(EVERY["ACTIVATION_RATES"].right)
HEAD = "def activation_rates(u, a, rise, fall):\n"
SLOW = f"{HEAD}    return (u - a) / fall"
ENDLESS = "while True:\n    pass"
NO_STORAGE = "Object.defineProperty(window, 'localStorage', { get() { throw 'no' } })"


def check(page, lines, words):
    page.lines.fill(lines)
    page.button("Check").click()
    page.said.get_by_text(words).wait_for()


def test_python_is_loaded_for_who_writes_and_from_the_books_own_files(open_exercise, site, serious):
    page = open_exercise()
    assert page.get_by_label("Your lines: activation_rates").count() == 1
    page.lines.focus()  # as one who goes on by Tab
    page.wait_for_load_state("networkidle")
    assert not any("vendor/python" in url or "blob:" in url for url in page.asked)
    page.lines.click()
    page.wait_for_function("() => window.vmcPythonFiles")
    check(page, RIGHT_LINES, "✓ Right.")
    assert any("vendor/python.js" in url for url in page.asked)
    inside = (site.as_uri(), "data:", "blob:")
    assert [url for url in page.asked if not url.startswith(inside)] == []
    check(page, SLOW, "Too slow on the way up")
    assert page.said.locator("p").inner_html().count("\\(") == 2  # equations, for KaTeX
    check(page, f"{HEAD}    print('is', twice(2))\n    return u", "is right; yours gives")
    assert "is 4" in page.said.locator("pre").inner_text()
    assert serious(page, "html", all_of_it=True) == []
    check(page, f"{HEAD}    return =", "cannot read line 2")
    check(page, "raise KeyboardInterrupt", "Python stopped: KeyboardInterrupt")
    check(page, RIGHT_LINES, "✓ Right.")


def test_an_endless_loop_ends_by_itself_or_by_the_button(open_exercise):
    page = open_exercise()
    page.evaluate("() => { vmc['python/interpreter'].limit.seconds = 1 }")
    check(page, ENDLESS, "Stopped after 1 s. Does a loop never end?")
    page.evaluate("() => { vmc['python/interpreter'].limit.seconds = 1000 }")
    page.button("Check").click()
    page.said.get_by_text("Checking").wait_for()
    page.button("Stop").click()
    page.said.get_by_text("Stopped.").wait_for()
    expect(page.button("Check")).to_be_focused()
    page.button("Check").click()
    page.button("Stop").click()  # while it starts
    page.said.get_by_text("Stopped.").wait_for()
    assert page.button("Stop").is_disabled()
    check(page, RIGHT_LINES, "✓ Right.")
    assert "Stopped" not in page.evaluate("() => localStorage.vmcRecord")  # it was no answer


def test_stop_ends_its_own_question_and_not_the_one_that_it_waits_for(open_exercise):
    page = open_exercise()
    page.evaluate("() => { vmc['python/interpreter'].limit.seconds = 1000 }")
    page.lines.fill(ENDLESS)
    page.button("Check").click()
    page.said.get_by_text("Checking").wait_for()
    page.get_by_role("button", name="Edit cube").click()
    first, second = (page.locator(f"form[data-{kind}]") for kind in ("function", "cell"))
    second.get_by_text("Run").click()
    second.get_by_text("Waiting for what runs now").wait_for()
    second.get_by_text("Stop", exact=True).click()
    second.get_by_text("✗ Stopped.").wait_for()
    assert "Checking" in first.get_by_role("status").inner_text()
    first.get_by_text("Stop", exact=True).click()
    first.get_by_text("✗ Stopped.").wait_for()


def test_lines_and_verdict_are_kept_until_reset(open_exercise):
    page = open_exercise()
    empty = page.lines.input_value()
    assert "your lines" in empty
    assert page.button("Reset").is_disabled()
    check(page, SLOW, "Too slow")
    page.lines.press_sequentially("  # mine")
    page.reload()
    assert page.lines.input_value() == f"{SLOW}  # mine"
    assert "Too slow" in page.said.inner_text()
    page.button("Reset").click()
    assert page.lines.input_value() == empty
    assert page.said.inner_text() == ""
    page.keyboard.press("Control+z")
    assert page.lines.input_value() == f"{SLOW}  # mine"
    page.button("Reset").click()
    page.reload()
    assert page.lines.input_value() == empty
    assert page.said.inner_text() == ""
    for harm in ("", '{"typed', "7"):  # by another program of the same address
        page.evaluate(
            "(harm) => Object.keys(localStorage).forEach((k) => (localStorage[k] = harm))", harm
        )
        page.reload()
        assert page.lines.input_value() == empty
    page.failed.clear()  # a reload ends what was still loading


def test_the_keyboard_indents_checks_and_goes_on_where_storage_is_forbidden(open_exercise, window):
    page = open_exercise(window(NO_STORAGE))
    keys, empty = page.keyboard, page.lines.input_value()
    keys.press("Tab")
    expect(page.lines).to_be_focused()
    keys.press("Control+a")
    for text in ("def f(x):", "if x:  # so", "return 1"):
        keys.type(text)
        keys.press("Enter")
    assert page.lines.input_value() == "def f(x):\n    if x:  # so\n        return 1\n        "
    keys.press("Control+z")
    assert page.lines.input_value() == empty
    keys.press("Tab")
    expect(page.button("Check")).to_be_focused()
    keys.press("Shift+Tab")
    keys.press("Control+Enter")
    page.said.get_by_text("returns nothing").wait_for()
    check(page, RIGHT_LINES, "✓ Right.")


def test_a_mechanisms_cell_is_edited_run_kept_and_reset_on_a_phone(open_exercise, window, serious):
    """With letters of 16 px, lest it zooms in, and nothing beyond the window's edge."""
    page = open_exercise(window(viewport={"width": 360, "height": 700}))
    assert page.lines.evaluate("(area) => getComputedStyle(area).fontSize") == "16px"
    assert page.evaluate("() => document.documentElement.scrollWidth") <= 360
    edit = page.get_by_role("button", name="Edit cube")
    edit.focus()
    page.keyboard.press("Enter")
    lines, said = page.get_by_label("Your lines: cube"), page.locator("[data-cell] [role=status]")
    expect(lines).to_be_focused()
    assert lines.input_value() == MECHANISM
    page.button("Run").click()
    said.get_by_text("✓ It runs.", exact=True).wait_for()
    changed = MECHANISM.replace("x**3", "x**2").replace("assert", "print(cube(3))\nassert")
    lines.fill(changed)
    lines.press("Control+Enter")
    said.get_by_text("Line 6 no longer holds: assert cube(twice(2)) == 64.").wait_for()
    assert said.locator("pre").inner_text().strip() == "9"
    assert serious(page, "html", all_of_it=True) == []
    assert page.evaluate("() => document.documentElement.scrollWidth") <= 360
    page.reload()
    assert lines.input_value() == changed
    assert "no longer holds" in said.inner_text()
    page.locator("[data-cell] [name=reset]").click()
    assert lines.input_value() == MECHANISM
    assert said.inner_text() == ""
