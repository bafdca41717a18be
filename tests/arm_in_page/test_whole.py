"""The whole arm in the page: the plans and the movements of Python's, and a reader who moves it."""

import shutil

import numpy as np
import pytest

from arm_in_page import live, live_whole_arm
from book.figures import whole_arm_live
from book.figures.whole_arm import lines, placed
from reproduce.whole_arm import experiment, habits
from tests.arm_in_page.test_live import HEAD, ROOT, number, start, told, wait_for_status
from vmc_lib.cerebellum.offline import broyden_calibration
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import exact_weights, habitual_weights

GOAL = np.array([0.475, 0.105, -0.09])
TARGETS = np.array([GOAL, [0.52, 0.07, -0.065], [0.485, -0.09, -0.17]])
ARM = """async (asked) => {
  const given = JSON.parse(document.querySelector(".vmc-live script").textContent);
  const arm = await (self.testArm ??= vmcArm.load(given));
  const templateSet = await vmcTemplates.load(given.templateSet);
  const ended = (plan) => (weights) =>
    arm.hand(arm.move(templateSet.excitations({ ...plan, weights })).at(-1).q);
  %s
}"""
CLOSE = 1e-3  # rad, m: the page has another version of MuJoCo


@pytest.fixture(scope="module")
def past():
    return habits.load_templates()


@pytest.fixture(scope="module")
def site(tmp_path_factory, past):
    """A page with the whole arm, as the book shows it, on disk."""
    folder = tmp_path_factory.mktemp("site")
    for static in (live.SHOW, live.STATIC, ROOT / "book/_static"):
        shutil.copytree(static, folder, dirs_exist_ok=True)
    shown = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("VMC_RENDER_MODE", "book")
        patch.setattr(live, "display", lambda *items: shown.extend(item.data for item in items))
        live_whole_arm(
            whole_arm_live.arm(past, habits.muscle_synergies().rest),
            lambda: whole_arm_live.pictures(past, GOAL),
            experiment.INSIDE,
            GOAL,
            "Set a target.",
            "A whole arm before two views of it.",
        )
    (folder / "page.html").write_text(HEAD + "".join(shown), encoding="utf-8")
    return folder


@pytest.fixture
def visit(chromium, site):
    """A function that opens the page in a window of its own kind, after a script if given."""
    contexts, errors = [], []

    def visit(script="", **kind):
        contexts.append(chromium.new_context(offline=True, **kind))
        contexts[-1].add_init_script(script)
        page = contexts[-1].new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.goto((site / "page.html").as_uri())
        return page, page.locator(".vmc-live")

    yield visit
    for context in contexts:
        context.close()
    assert errors == []


@pytest.fixture(scope="module")
def ask(offline, site):
    """A function that runs a script beside a loaded arm and returns its answer."""
    page = offline.new_page()
    page.goto((site / "page.html").as_uri())
    yield lambda script, asked=None: page.evaluate(ARM % script, asked)
    page.close()


@pytest.mark.browser
@pytest.mark.parametrize(
    ("name", "rule"), [("habitualWeights", habitual_weights), ("exactWeights", exact_weights)]
)
def test_its_memories_are_mixed_as_in_python(ask, past, name, rule):
    script = f"""const plan = vmcPlanning.plan(asked, templateSet, vmcPlanning.{name});
      return {{ ...plan, u: templateSet.excitations(plan) }};"""
    for target in TARGETS:
        mixed, expected = (
            ask(script, target.tolist()),
            experiment.plan_reaches(target, past, rule=rule),
        )
        assert mixed["chosen"] == expected.rows.tolist()
        assert np.allclose(mixed["weights"], expected.weights, atol=1e-10)
        assert np.allclose(mixed["u"], expected.excitations, atol=1e-10)


@pytest.mark.browser
def test_it_moves_as_in_python(ask, past):
    plan = experiment.plan_reaches(GOAL, past)
    moved = ask("return arm.move(asked);", plan.excitations.tolist())[1:]
    motion = execute(plan).motion
    off = np.array([moment["q"] for moment in moved]) - motion.joints
    assert np.abs(off).max() < CLOSE
    assert np.allclose([moment["activation"] for moment in moved], motion.activation, atol=1e-9)
    assert np.ptp(motion.joints, axis=0).max() > 0.1


@pytest.mark.browser
def test_what_is_drawn_is_where_python_has_it(ask, past):
    joints = execute(experiment.plan_reaches(GOAL, past)).motion.joints[-1]
    for q in (whole_arm_live.START, joints):
        seen, (ends, ways), data = ask("return arm.look(asked);", q.tolist()), lines(q), placed(q)
        assert np.allclose(seen["joints"], ends, atol=1e-9)
        bodies = [data.body(name) for name in ask("return Object.keys(given.bones);")]
        frames = [[*body.xmat, *body.xpos] for body in bodies]
        assert np.allclose(seen["frames"], frames, atol=1e-9)
        apart = [np.abs(np.subtract(*both)).max() for both in zip(seen["ways"], ways, strict=True)]
        assert np.sum(np.array(apart) > 1e-9) <= 3  # MuJoCo 4 leads them round another side
        assert max(apart) < 0.02


@pytest.mark.browser
def test_its_corrections_are_pythons(ask, past):
    script = """const plan = vmcPlanning.plan(asked, templateSet);
      return [...vmcCalibration.broydenCalibration(plan, ended(plan), given.calibration)];"""
    expected = broyden_calibration(experiment.plan_reaches(TARGETS, past), live.TRIALS)
    for k, target in enumerate(TARGETS):
        reached = np.array([trial["reached"] for trial in ask(script, target.tolist())])
        assert np.abs(reached - expected.endpoint[:, k]).max() < CLOSE


@pytest.mark.browser
def test_a_reader_sets_a_target_in_space(visit, past):
    _, arm = visit(reduced_motion="reduce")
    start(arm)
    target = TARGETS[1]
    for name, place in zip(("forward", "up", "right"), target, strict=True):
        arm.get_by_label(f"target, {name}").fill(str(place))
    arm.locator("[name=main]").click()
    wait_for_status(arm, "The planned reach")
    trials = broyden_calibration(experiment.plan_reaches(target, past), live.TRIALS)
    assert number(told(arm, "planned")) == pytest.approx(1000 * trials.error[0], abs=0.3)
    final = trials.movements[0].motion.activation[-1]
    assert told(arm, "active") == str((final > 0.05).sum())
    shown = [float(text) for text in arm.locator(".vmc-muscles b").all_inner_texts()]
    assert np.allclose(shown, final, atol=0.0051)
    arm.locator("[name=calibrate]").click()
    wait_for_status(arm, f"After {live.TRIALS} tries")
    assert number(told(arm, "calibrated")) == pytest.approx(1000 * trials.error.min(), abs=0.3)


@pytest.mark.browser
def test_a_target_is_dragged_in_either_view(visit):
    page, arm = visit()
    start(arm)
    handles, values = arm.locator(".vmc-handle"), arm.locator("fieldset output")
    for view, axis in ((0, 1), (1, 2)):  # the one shows up, the other right
        before = values.all_inner_texts()
        handles.nth(view).scroll_into_view_if_needed()
        box = handles.nth(view).bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + 12, y + 12, steps=3)
        page.mouse.up()
        after = values.all_inner_texts()
        assert [was != now for was, now in zip(before, after, strict=True)] == [
            place in (0, axis) for place in range(3)
        ]


@pytest.mark.browser
def test_without_webgl_its_views_move(visit):
    _, arm = visit("HTMLCanvasElement.prototype.getContext = () => null", reduced_motion="reduce")
    start(arm)
    arm.locator("[name=main]").click()
    assert "no 3-D picture" in wait_for_status(arm, "The planned reach")
    assert arm.locator(".vmc-scene").inner_text().startswith("A whole arm")


@pytest.mark.browser
def test_it_is_accessible_and_fits_a_phone(visit, serious):
    page, arm = visit(viewport={"width": 360, "height": 700})
    start(arm)
    assert serious(page, "main") == []
    wide = """() => [...document.querySelectorAll("main *")]
      .filter((e) => e.getBoundingClientRect().right > 361)
      .filter((e) => !e.closest(".vmc-picture, .vmc-spoken"))
      .map((e) => e.outerHTML.slice(0, 100))"""
    assert page.evaluate(wide) == []
