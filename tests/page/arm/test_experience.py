"""Templates are taken away, put back and added: by the reader, and in Python alike."""

from dataclasses import replace

import numpy as np
import pytest

from page.arm.live import TRIALS
from tests.page.arm.controls import TARGET, number, readout, set_target, status
from tests.pages import drag, middle
from vmc_lib.cerebellum.offline import broyden_calibration
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import is_surrounded, plan, surrounding

pytestmark = pytest.mark.browser
PLACE = """(box, [x, y]) => {
  const svg = box.querySelector("svg[data-axes]");
  const { left, top, width, height } = svg.getBoundingClientRect();
  const [right, down] = vmc["demo/axes"].axesOf(svg).shareOf([x, y]);
  return [left + right * width, top + down * height];
}"""


def rows(target, left, own):
    """The template in each quadrant round a target, of the rows that are `left` of all."""
    return left[surrounding(target, own.points[left])]


def plan_without(gone, target=TARGET):
    own = templates.load()
    return plan(target, own, rows=rows(target, np.delete(np.arange(len(own.points)), gone), own))


def with_one_more(own, reach):
    """A template set, and in it a reach of `Plan`: its commands, and where they lead."""
    points = np.vstack([own.points, execute(reach).endpoint])
    commands = np.concatenate([own.excitations, reach.excitations[None]])
    return replace(own, points=points, excitations=commands)


def test_plans_without_some_and_with_one_more_are_pythons(ask):
    rng, own = np.random.default_rng(7), templates.load()
    habit = plan(TARGET, own)
    kept = habit.with_weights(habit.weights + np.array([0.3, -0.3, 0.4, -0.4]))  # clipped
    past = with_one_more(own, kept)
    script = """const [weights, all] = asked, target = [0.09, -0.37];
      const kept = { ...vmc["arm/planning"].plan(target, templateSet), weights };
      const end = (plan) => vmc["vectors"].mean(reach(plan)(plan.weights)).slice(0, 2);
      templateSet.add(end(kept), templateSet.excitations(kept));
      return all.map(([at, without]) => {
        const plan = vmc["arm/planning"].plan(at, templateSet, undefined, new Set(without));
        const commands = templateSet.excitations(plan)[500];
        return [plan.chosen, plan.weights, end(plan), commands];
      });"""
    asked, expected = [], []
    while len(asked) < 20:
        target, gone = rng.uniform((0, -0.48), (0.18, -0.32)), rng.choice(len(own.points), 5, False)
        left = np.delete(np.arange(len(past.points)), gone)
        if is_surrounded(target, past.points[left]):
            asked.append([target.tolist(), gone.tolist()])
            expected.append(plan(target, past, rows=rows(target, left, past)))
    answers = ask(script, [kept.weights.tolist(), asked])
    for (chosen, weights, end, commands), one in zip(answers, expected, strict=True):
        assert chosen == one.rows.tolist()
        assert np.abs(weights - one.weights).max() < 1e-6  # the end of the one more is the page's
        assert np.abs(commands - one.excitations[500]).max() < 1e-6
        assert np.abs(end[:2] - execute(one).endpoint).max() < 1e-6
    assert sum(len(own.points) in one.rows for one in expected) > 3


@pytest.fixture
def arm(open_arms, window):
    arm = open_arms(window(reduced_motion="reduce")).past
    arm.scroll_into_view_if_needed()
    return arm


def place(arm, row):
    """Where a template's dot stands, in px."""
    return arm.evaluate(PLACE, templates.load().points[row].tolist())


def said(arm, movement, left):
    miss = f"The planned reach misses by {1000 * movement.error:.1f} mm"
    assert f"{left} of 19 templates in use" in status(arm, f"{miss}.*{left} of 19")
    assert readout(arm, "planned") == f"{1000 * movement.error:.1f} mm"


def test_a_click_on_a_dot_takes_it_away_and_another_puts_it_back(arm):
    near = plan(TARGET, templates.load()).rows[1]
    target, box = arm.get_by_label("target, forward"), arm.locator("[name=template]").nth(near)
    arm.locator(".vmc-pictures").dispatch_event("click")  # of no pointer: it may be a program's
    arm.page.mouse.click(*place(arm, near))
    fewer = plan_without([near])
    said(arm, execute(fewer), 18)
    shown = [number(text) for text in arm.locator("svg g[clip-path] text").all_text_contents()]
    assert sorted(shown) == sorted(fewer.weights.round(2))
    assert not box.is_checked()
    assert target.input_value() == "0.09"  # the handle stays
    arm.page.mouse.click(*place(arm, near))
    said(arm, execute(plan(TARGET, templates.load())), 19)
    box.evaluate("(box) => box.closest('details').open = true")
    box.focus()
    arm.page.keyboard.press("Space")
    said(arm, execute(fewer), 18)
    arm.get_by_role("button", name="First templates again").click()
    said(arm, execute(plan(TARGET, templates.load())), 19)
    x, y = middle(arm.locator(".vmc-handle"))
    drag(arm.page, (x, y), *np.subtract(place(arm, near), (x, y)))  # onto the dot, which stays
    said(arm, execute(plan(templates.load().points[near].round(3), templates.load())), 19)


def test_the_last_template_of_a_quadrant_stays(arm):
    set_target(arm, (0.03, -0.46))
    status(arm, "The planned reach")
    corner = plan([0.03, -0.46], templates.load()).rows[2]
    arm.page.mouse.click(*place(arm, corner))
    assert "not surrounded" in status(arm, "This template stays")
    assert arm.locator("[name=template]").nth(corner).is_checked()
    arm.get_by_role("button", name="Reach").click()
    assert "19 of 19" in status(arm, "The planned reach")


def test_a_calibrated_reach_becomes_a_template(arm):
    own, label = templates.load(), "target, forward"
    arm.get_by_role("button", name="Calibrate").click()
    status(arm, f"After {TRIALS} tries")  # by Broyden's rule
    arm.get_by_role("button", name="Keep as a template").click()
    trials = broyden_calibration(plan(TARGET, own), TRIALS)
    best = plan(TARGET, own).with_weights(trials.weights[trials.error.argmin()])
    more = with_one_more(own, best)
    after = execute(plan(TARGET, more))
    said = status(arm, f"The planned reach misses by {1000 * after.error:.1f} mm")
    place = ", ".join(f"{x:.3f}".replace("-", "−") for x in more.points[-1])
    assert said.endswith(f"Kept: template 20, at {place}. 20 of 20 templates in use.")
    assert after.error < 0.0025
    labels = arm.locator("label:has([name=template])").all_text_contents()
    assert {len(x.split(".")[-1]) for label in labels for x in label.split(",")} == {3}
    arm.get_by_label(label).fill("0.1")
    elsewhere = execute(plan([0.1, -0.37], more))
    status(arm, f"The planned reach misses by {1000 * elsewhere.error:.1f} mm")
    arm.get_by_role("button", name="First templates again").click()
    before = execute(plan([0.1, -0.37], own))
    assert "19 of 19" in status(arm, f"The planned reach misses by {1000 * before.error:.1f} mm")
    assert arm.locator("[name=template]").count() == 19


@pytest.mark.audit
def test_a_finger_needs_no_aim(open_arms, window, serious):
    page = open_arms(window(viewport={"width": 360, "height": 740}, has_touch=True))
    page.past.locator("svg[data-axes]").scroll_into_view_if_needed()
    x, y = place(page.past, 6)
    page.touchscreen.tap(x + 15, y + 12)
    status(page.past, "The planned reach.* 18 of 19")
    assert not page.past.locator("[name=template]").nth(6).is_checked()
    page.touchscreen.tap(*place(page.past, 10))  # on it lies the target's handle, in part
    status(page.past, "The planned reach.* 17 of 19")
    assert page.past.get_by_label("target, forward").input_value() == "0.09"
    assert serious(page, "main") == []
