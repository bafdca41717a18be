"""A reader moves the arms in the page."""

from dataclasses import replace

import numpy as np
import pytest

from page.arm import controls, live
from tests.page.arm.controls import number, readout, set_target, start, status
from tests.pages import NO_WEBGL, drag, middle, middles, probe
from vmc_lib.arm.model import MUSCLES
from vmc_lib.arm.simulate import simulate
from vmc_lib.cerebellum.offline import algorithm_1, broyden_calibration
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import plan

pytestmark = pytest.mark.browser


def test_mujoco_is_loaded_by_the_start_and_from_the_books_own_files(open_arms, site, ask):
    page = open_arms()
    page.wait_for_function("() => window.MeshCat")
    assert not any("mujoco" in url for url in page.asked)
    said = page.bench.locator("[role=status]").inner_text()
    assert said.startswith(f"MuJoCo {controls.VERSIONS['page']} (")
    start(page.bench)
    assert any("vendor/mujoco.js" in url for url in page.asked)
    inside = (site.as_uri(), "data:", "blob:")
    assert [url for url in page.asked if not url.startswith(inside)] == []
    assert ask("return arm.mujoco.mj_versionString();") == controls.VERSIONS["page"]


ENDED = """async () => {
  const live = new vmc["arm/bench"].Bench(document.querySelector(".vmc-live"));
  await live.wake();
  const { data, seen, model } = live.arm;
  live.end();
  return [data, seen, model].map((part) => part.isDeleted());
}"""


FAILED = """async () => {
  const live = new vmc["arm/bench"].Bench(document.querySelector(".vmc-live"));
  let arm;
  live.ready = () => {
    ({ arm } = live);
    throw new Error("no file");
  };
  await live.wake();
  return [arm.data, arm.seen, arm.model].map((part) => part.isDeleted());
}"""


@pytest.mark.parametrize("script", [ENDED, FAILED], ids=["ended", "failed"])
def test_an_arm_whose_page_has_done_with_it_gives_its_memory_back(open_arms, script):
    assert open_arms().evaluate(script) == [True, True, True]


@pytest.mark.audit
def test_an_arm_with_another_law_than_pythons_says_so(open_arms, window):
    page = open_arms(
        window(
            """const parse = JSON.parse;
            JSON.parse = (text) => {
              const given = parse(text);
              if (given.muscle) given.muscle.answers[0][4] *= 2;
              return given; };"""
        )
    )
    page.bench.locator("[name=main]").click()
    assert "keeps the book's" in status(page.bench, "The arm is running")


def test_the_bench_answers_the_keyboard(open_arms):
    page = open_arms()
    bench, keys = page.bench, page.keyboard
    bench.locator("[name=main]").focus()
    keys.press("Enter")
    status(bench, "The arm is running")
    page.wait_for_function(
        "() => !document.querySelector('[data-tell=time]').textContent.startsWith('0.00')"
    )
    keys.press("Enter")
    assert "Shoulder" in status(bench, "Paused")
    bench.locator("[name=reset]").focus()
    keys.press("Enter")
    status(bench, "Back at the start")
    assert (readout(bench, "time"), readout(bench, "elbow")) == ("0.00 s", "95.0°")
    bench.get_by_role("slider", name="BIClong").focus()
    keys.press("End")
    assert bench.locator("[name=BIClong] + output").inner_text() == "1.00"
    bench.locator("[name=step]").focus()
    for _ in range(10):
        keys.press("Enter")
    assert readout(bench, "time") == "0.10 s"
    rest = [round(u, 2) for u in live.page_constants()["rest"]]
    excitation = np.array(rest)
    excitation[MUSCLES.index("BIClong")] = 1
    moved = simulate(np.tile(excitation, (100, 1)), templates.START, rest, engine="mujoco")
    assert number(readout(bench, "elbow")) == pytest.approx(np.degrees(moved.q[-1, 1]), abs=0.051)
    for name, value in zip(("forward", "up", "right"), 1000 * moved.hand[-1], strict=True):
        assert number(readout(bench, name)) == pytest.approx(value, abs=0.51)


def test_the_arm_reaches_misses_and_calibrates(open_arms):
    reach, target = open_arms().reach, np.array([0.045, -0.35])
    start(reach)
    set_target(reach, target)
    trials = algorithm_1(plan(target, templates.load()))
    best = trials.error.argmin()
    planned, calibrated = (f"{1000 * trials.error[n]:.1f} mm" for n in (0, best))
    reach.locator("[name=main]").click()
    assert planned in status(reach, "The planned reach")
    reach.locator("[name=calibrate]").click()
    said = status(reach, "After 21 tries")
    assert f"n = {best - 1}" in said
    assert calibrated in said
    assert readout(reach, "calibrated") == calibrated
    reach.get_by_text("more", exact=True).click()
    reach.get_by_label("Broyden calibration").check()
    assert readout(reach, "calibrated") == "–"  # another rule, another try
    reach.locator("[name=calibrate]").click()
    status(reach, f"After {live.TRIALS} tries")
    ours = broyden_calibration(plan(target, templates.load()), live.TRIALS)
    assert readout(reach, "calibrated") == f"{1000 * ours.error.min():.1f} mm"


def test_the_whole_arm_reaches_and_calibrates(open_arms, window, past):
    page = open_arms(window(reduced_motion="reduce"))
    arm, target = page.whole, np.array([0.52, 0.07, -0.065])
    start(arm)
    arm.locator(".vmc-scene canvas").wait_for()
    drawn = "div => vmc['demo/scene'].viewOf(div).body instanceof vmc['arm/whole'].WholeBody"
    assert arm.locator(".vmc-scene").evaluate(drawn)
    set_target(arm, target)
    arm.locator("[name=main]").click()
    status(arm, "The planned reach")
    trials = broyden_calibration(plan(target, past), live.TRIALS)
    assert number(readout(arm, "planned")) == pytest.approx(1000 * trials.error[0], abs=0.3)
    final = trials.movements[0].motion.activation[-1]
    arm.get_by_text("more", exact=True).click()  # the chapter asks how many
    arm.get_by_text("muscles, view").click()
    assert readout(arm, "active") == str((final > 0.05).sum())
    shown = [float(text) for text in arm.locator(".vmc-muscles b").all_inner_texts()]
    assert np.allclose(shown, final, atol=0.0051)
    arm.locator("[name=calibrate]").click()
    status(arm, f"After {live.TRIALS} tries")
    assert number(readout(arm, "calibrated")) == pytest.approx(1000 * trials.error.min(), abs=0.3)
    assert page.errors == []


def test_a_target_is_dragged(open_arms):
    page = open_arms()
    start(page.reach)
    status(page.reach, "The planned reach")
    ring = page.reach.locator("svg circle[stroke='var(--vmc-green)']").first
    x, y = middle(ring)
    drag(page, (x, y), -50, 30)
    status(page.reach, "The planned reach")  # it needs no other word
    assert np.subtract(middle(ring), (x, y)) == pytest.approx([-50, 30], abs=2)  # by 1 mm
    assert number(page.reach.locator("output").first.inner_text()) < 0.06
    set_target(page.reach, (0.25, -0.49))
    assert "not surrounded" in status(page.reach, "Nothing planned")


@pytest.mark.audit
def test_a_target_in_space_is_dragged_in_either_view(open_arms):
    page = open_arms()
    start(page.whole)
    handles, values = page.whole.locator(".vmc-handle"), page.whole.locator("fieldset output")
    for view, dx in ((0, -12), (1, 12)):  # the one shows up, the other right, both forward
        before = values.all_text_contents()
        handles.nth(view).scroll_into_view_if_needed()
        drag(page, middle(handles.nth(view)), dx, 12)
        moved = [was != now for was, now in zip(before, values.all_text_contents(), strict=True)]
        assert moved == [place in (2, view) for place in range(3)]


def test_a_first_reach_is_there_and_its_miss_is_enlarged(open_arms, ask):
    page = open_arms()
    arm, movement = page.reach, execute(plan([0.09, -0.37], templates.load()))
    miss = f"{1000 * movement.error:.1f} mm"
    assert miss in status(arm, "The planned reach")
    assert readout(arm, "planned") == miss
    assert not any("mujoco" in url for url in page.asked)
    ends = "svg circle:is([fill='var(--vmc-red)'], [stroke='var(--vmc-green)'])"
    plain, enlarged = np.diff(np.reshape(middles(arm.locator(ends)), (2, 2, 2)), axis=1)
    assert np.abs(enlarged - live.LENS["times"] * plain).max() < 1  # px
    stored = ask(
        """const { weights, reached, error, q, joints } = given.first;
      const plan = vmc["arm/planning"].plan([0.09, -0.37], templateSet);
      const hold = reach(plan)(plan.weights).map((place) => place.slice(0, 2));
      const far = hold.map(([x, y]) => Math.hypot(x - 0.09, y + 0.37));
      return [[weights, plan.weights], [reached, vmc["vectors"].mean(hold)],
        [joints, arm.joints(q)], [[error], [vmc["vectors"].sum(far) / far.length]]];""",
        [0, 0],
        1,
    )
    for mine, theirs in stored:
        assert np.allclose(mine, theirs, atol=1e-6)


def shown_weights(arm):
    """The weights that the sliders show, as the plan orders them."""
    return [number(arm.locator(f"[name=weight-{k}] + output").inner_text()) for k in range(4)]


def test_weights_are_set_by_hand(open_arms, window):
    arm = open_arms(window(reduced_motion="reduce")).by_hand
    habit = plan([0.09, -0.37], templates.load())
    plans = f"(the plan: {1000 * execute(habit).error:.1f} mm)"
    made = []
    for tries, weight in enumerate(("0.6", "0.7"), start=1):
        arm.get_by_label("weight, upper right").fill(weight)
        weights = shown_weights(arm)
        said = status(arm, f"It misses by .* of {tries}")
        miss = execute(replace(habit, weights=np.array(weights))).error
        made.append(1000 * miss)
        assert f"It misses by {made[-1]:.1f} mm" in said
        assert f"of {tries}: {min(made):.1f} mm {plans}" in said  # all are worse than the plan
    assert arm.locator("svg g circle[stroke='var(--vmc-grey)']").count() == 4  # 2, twice
    assert number(readout(arm, "sum")) == pytest.approx(sum(weights), abs=2e-3)
    arm.get_by_text("more", exact=True).click()
    arm.get_by_label("Broyden calibration").check()  # goes on from there
    assert f"misses by {1000 * miss:.1f} mm" in status(arm, "It misses by .* of 2")
    arm.locator("[name=calibrate]").click()
    assert f"it began from {1000 * miss:.1f} mm" in status(arm, f"After {live.TRIALS} tries")
    assert number(readout(arm, "sum")) == pytest.approx(sum(weights), abs=2e-3)
    arm.get_by_role("button", name="Plan's weights").click()
    assert f"{1000 * execute(habit).error:.1f} mm" in status(arm, "The planned reach")
    assert np.allclose(shown_weights(arm), habit.weights, atol=6e-4)
    set_target(arm, (0.1, -0.38))
    assert "planned" in status(arm, "The planned reach")


@pytest.mark.audit
def test_with_reduced_motion_only_the_end_is_shown(open_arms, window):
    page = open_arms(window(reduced_motion="reduce"))
    start(page.reach)
    frames = """() => vmc["demo/scene"].viewOf(document.querySelectorAll(".vmc-scene")[1])
      .viewer.renderer.info.render.frame"""
    before = page.evaluate(frames)
    page.reach.locator("[name=main]").click()
    status(page.reach, "The planned reach")
    assert page.evaluate(frames) - before < 12  # the miss is drawn, too


def test_without_webgl_arms_move_in_plots(open_arms, window):
    page = open_arms(window(NO_WEBGL, reduced_motion="reduce"))
    for arm, words, said in (
        (page.bench, "A right arm of six muscles", "The arm is running"),
        (page.whole, "A whole arm", "The planned reach"),
    ):
        start(arm)
        if arm is page.whole:
            arm.locator("[name=main]").click()
        assert "no 3-D picture" in status(arm, said)
        assert arm.locator(".vmc-scene").inner_text().startswith(words)
    assert page.bench.locator("svg[data-axes] polyline").count() == 2


def test_without_webassembly_it_says_so(open_arms, window):
    page = open_arms(window("delete self.WebAssembly"))
    page.bench.locator("[name=main]").click()
    status(page.bench, "This browser cannot run the arm")
    assert page.bench.get_by_role("slider", name="BRA").is_disabled()
    page.errors[:] = [error for error in page.errors if "mujoco.js" not in error]  # MuJoCo's


@pytest.mark.audit
def test_arms_are_accessible_and_fit_a_phone(open_arms, window, serious):
    page = open_arms(window(viewport={"width": 360, "height": 700}))
    assert serious(page, "main") == []
    for arm in (page.bench, page.reach, page.whole):
        start(arm)
    assert serious(page, "main") == []
    assert probe(page, "tooWide", "main") == []
