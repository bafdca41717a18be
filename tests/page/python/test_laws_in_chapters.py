"""In the built book a changed law moves its chapter's demos, in three engines, and an arm."""

import json
import re

import numpy as np
import pytest
from playwright.sync_api import expect

from page.arm.live import PHOTO_1
from page.python import demos
from page.python.grader import changed_names
from tests.page.python.test_demos import DEMOS, LAWS, starts, with_law
from tests.pages import BUILT, open_url
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import plan

pytestmark = pytest.mark.browser
CHANGE = """const form = document.querySelector(`form[data-cell="${law}"]`);
form.querySelector("button").click();
const area = form.closest(".cell").querySelector("textarea");
area.value = area.value.replace(old, mine);
form.requestSubmit();
const all = [...document.querySelectorAll(".vmc-demo:has(.vmc-law)")];
const said = (demo) => demo.querySelector(".vmc-law").textContent;
const moved = () => all.filter((demo) => said(demo).startsWith("This demo runs your"));
while (moved().length < 2) await new Promise((resolve) => setTimeout(resolve, 100));
return moved().map((demo) => [...demo.querySelectorAll("svg text")].map((x) => x.textContent));"""


@pytest.mark.audit
def test_the_other_engines_follow_a_law(engine):
    stem, (old, mine) = "04_crbm", LAWS["04_crbm"]
    given = f"const [law, old, mine] = {json.dumps(['boltzmann', old, mine])}; "
    engine.open(BUILT / f"book/{stem}.html")
    engine.limit(100)  # others may be at work, too
    shown = engine.run(given + CHANGE)
    assert engine.errors() == ""
    follow = [one for one in DEMOS[stem] if changed_names(with_law(stem, one[0]), *one)]
    for texts, (above, cell) in zip(shown, follow, strict=True):
        above = with_law(stem, above)
        first = starts(demos.prepare(tuple(above), cell)[1])
        _, picture = demos.draw(above, above, cell, "d", first)["parts"][:2]
        assert sorted(texts) == sorted(re.findall("<text[^>]*>([^<]*)</text>", "\n".join(picture)))


@pytest.mark.audit
def test_an_arm_plans_by_the_readers_law(window):
    page = open_url(window(reduced_motion="reduce"), (BUILT / "book/09_planning.html").as_uri())
    page.evaluate("() => { vmc['python/interpreter'].limit.seconds = 100 }")
    page.get_by_role("button", name="Edit four_around, nearness").click()
    lines = page.get_by_label("Your lines: four_around")
    expect(lines).to_be_visible()
    lines.fill(lines.input_value().replace("(1 / d) / (1 / d)", "d / d"))
    lines.press("Control+Enter")
    arm = page.locator(".vmc-live")
    line = arm.locator(".vmc-law [role=status]")
    expect(line).to_have_text("This arm plans by your nearness: let it reach.")
    arm.locator("[name=main]").click()
    habit = plan(np.array(PHOTO_1), templates.load())
    far = np.linalg.norm(habit.points - habit.target, axis=-1)
    mine = execute(habit.with_weights(far / far.sum()))
    miss = "The planned reach misses by {:.1f} mm".format
    expect(arm.locator("[role=status]").first).to_contain_text(miss(1000 * mine.error))
    arm.get_by_role("button", name="Back to the book").click()
    expect(line).to_have_text("")
    arm.locator("[name=main]").click()
    expect(arm.locator("[role=status]").first).to_contain_text(miss(1000 * execute(habit).error))
    assert page.errors == page.failed == []
