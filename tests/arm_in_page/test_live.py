"""The arm in the page: the same numbers as the library's, and a reader who moves it."""

import base64
import gzip
import json
import re
import shutil
from pathlib import Path
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest
import yaml

from arm_in_page import live
from arm_in_page.live import live_arm
from tests.show.kernel import render
from vmc_lib.arm import muscle
from vmc_lib.arm.dynamics import paths
from vmc_lib.arm.kinematics import inverse_kinematics, to_world
from vmc_lib.arm.model import F0, MUSCLES, geometry
from vmc_lib.arm.simulate import simulate
from vmc_lib.cerebellum.offline import algorithm_1, broyden_calibration
from vmc_lib.motor import templates
from vmc_lib.motor.planning import exact_weights, habitual_weights, plan, surrounded

ROOT = Path(__file__).parents[2]
CONFIG = yaml.safe_load((ROOT / "_config.yml").read_bytes())["sphinx"]["config"]
STYLES = CONFIG["html_css_files"]
LISTED = [name for name, _ in CONFIG["html_js_files"]]  # the book's scripts, in its order
HEAD = """<!doctype html><html lang="en"><meta charset="utf-8">
<meta name="viewport" content="width=device-width"><title>An arm</title>
STYLES
SCRIPTS
<body style="background: var(--vmc-paper); color: var(--vmc-ink)"><main>""".replace(
    "STYLES", "".join(f'<link rel="stylesheet" href="{name}">' for name in STYLES)
).replace("SCRIPTS", "".join(f'<script defer src="{name}"></script>' for name in LISTED))
# `arm` and `templateSet` for a script that asks them something, made once a page
ARM = """async (asked) => {
  const given = JSON.parse(document.querySelector(".vmc-live script").textContent);
  const arm = await (self.testArm ??= vmcArm.load(given));
  const templateSet = await vmcTemplates.load(given.templateSet);
  const ended = (plan) => (weights) =>
    arm.hand(arm.move(templateSet.excitations({ ...plan, weights })).at(-1).q).slice(0, 2);
  %s
}"""
POSTURES = np.random.default_rng(3).uniform([-0.8, 0.1], [0.6, 2.0], (40, 2))
TARGETS = np.array([[0.12, -0.42], [0.045, -0.345], [0.17, -0.46]])


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """A page with both arms, as the book shows them, on disk."""
    folder = tmp_path_factory.mktemp("site")
    for static in (live.SHOW, live.STATIC, ROOT / "book/_static"):
        shutil.copytree(static, folder, dirs_exist_ok=True)
    shown = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("VMC_RENDER_MODE", "book")
        patch.setattr(live, "display", lambda *items: shown.extend(item.data for item in items))
        live_arm("bench", "Move it.", "An arm of two joints and six muscles.")
        live_arm("reach", "Let it reach.", "An arm before a plane of templates.")
    (folder / "page.html").write_text(HEAD + "\n".join(shown), encoding="utf-8")
    return folder


def open_site(context, site):
    page = context.new_page()
    opened = SimpleNamespace(page=page, asked=[], errors=[])
    page.on("request", lambda request: opened.asked.append(request.url))
    page.on("requestfailed", lambda request: opened.errors.append(request.url))
    page.on("pageerror", lambda error: opened.errors.append(str(error)))
    page.on("console", lambda m: m.type == "error" and opened.errors.append(m.text))
    page.goto((site / "page.html").as_uri())
    opened.bench, opened.reach = page.locator(".vmc-live").all()
    return opened


@pytest.fixture
def opened(offline, site):
    opened = open_site(offline, site)
    yield opened
    opened.page.close()
    assert opened.errors == []


@pytest.fixture
def visit(chromium, site):
    """A function that opens the page in a window of its own kind, after a script if given."""
    contexts = []

    def visit(script="", **kind):
        contexts.append(chromium.new_context(offline=True, **kind))
        contexts[-1].add_init_script(script)
        return open_site(contexts[-1], site)

    yield visit
    for context in contexts:
        context.close()


@pytest.fixture(scope="module")
def ask(offline, site):
    """A function that runs a script beside a loaded arm and returns its answer."""
    page = open_site(offline, site).page
    yield lambda script, asked=None: page.evaluate(ARM % script, asked)
    page.close()


def start(arm):
    arm.locator("[name=main]").click()
    arm.locator("form > fieldset:not([disabled])").wait_for()


def told(arm, name):
    return arm.locator(f"[data-tell={name}]").inner_text()


def number(text):
    return float(re.match(r"−?[\d.]+", text)[0].replace("−", "-"))


def wait_for_status(arm, beginning):
    arm.locator("[role=status]", has_text=re.compile(f"^{beginning}")).wait_for(timeout=90_000)
    return arm.locator("[role=status]").inner_text()


# ---- The same numbers ----


@pytest.mark.browser
@pytest.mark.parametrize(
    ("name", "law", "low", "high"),
    [
        ("activationRate", muscle.activation_rate, (0, 0), (1, 1)),
        ("forceLength", muscle.force_length, (0,), (2,)),
        ("forceVelocity", muscle.force_velocity, (-4,), (2,)),  # the guards included
        ("passiveForce", muscle.passive_force, (0,), (2,)),
        ("force", muscle.force, (0, 0.2, -3, 0), (1, 1.8, 1.5, 1000)),
    ],
)
def test_the_muscle_law_is_pythons(ask, name, law, low, high):
    asked = np.random.default_rng(1).uniform(low, high, (300, len(low)))
    answer = ask(
        f"return asked.map((values) => new vmcMuscle.Muscle(given.muscle).{name}(...values));",
        asked.tolist(),
    )
    expected = law(*asked.T)
    assert np.allclose(answer, expected, rtol=1e-12, atol=1e-12)
    assert np.ptp(expected) > 0.5


@pytest.mark.browser
def test_the_page_takes_pythons_constants_and_knows_another_law(ask, monkeypatch):
    script = "return new vmcMuscle.Muscle(asked).differs;"
    assert ask(script, live.given()["muscle"]) is False
    monkeypatch.setattr(muscle, "TAU_ACTIVATION", 0.05)
    assert ask(script, live.given()["muscle"]) is False
    for name in ("activation_rate", "force_length", "force_velocity", "passive_force"):
        with monkeypatch.context() as patch:
            law = getattr(muscle, name)
            patch.setattr(muscle, name, lambda *given, law=law: 1.01 * law(*given))
            assert ask(script, live.given()["muscle"]) is True, name


@pytest.mark.browser
def test_an_arm_with_another_law_than_pythons_says_so(visit):
    opened = visit(
        """const parse = JSON.parse;
        JSON.parse = (text) => {
          const given = parse(text);
          if (given.muscle) given.muscle.answers[0][4] *= 2;
          return given; };"""
    )
    opened.bench.locator("[name=main]").click()
    assert "keeps the book's" in wait_for_status(opened.bench, "The arm is running")


@pytest.mark.browser
def test_the_arm_goes_where_pythons_mujoco_goes(ask):
    rng = np.random.default_rng(2)
    wild = np.repeat(rng.random((3, 20, 6)), 50, axis=1)  # 1 s, a new command every 50 ms
    motion = simulate(wild, templates.START, live.given()["rest"], engine="mujoco")
    for excitations, q, active in zip(wild, motion.q, motion.activation, strict=True):
        moved = ask("return arm.move(asked);", excitations.tolist())
        assert np.abs([moment["q"] for moment in moved] - q).max() < 1e-9
        assert np.abs([moment["activation"] for moment in moved] - active).max() < 1e-12
    assert np.ptp(motion.q[:, -1], axis=0).min() > 0.05


@pytest.mark.browser
def test_joints_are_where_python_has_them(ask):
    for q in POSTURES:
        seen = ask("return arm.joints(asked);", q.tolist())
        assert np.allclose(seen, geometry(q).joints, atol=1e-12)


@pytest.mark.browser
def test_what_is_drawn_is_where_it_is(ask):
    script = """const told = given.scene.find((message) => message.startsWith("anatomy|"));
      const anatomy = new vmcAnatomy.Anatomy(JSON.parse(told.slice(8)));
      return asked.map((q) => [anatomy.wrist(q, 0.4), anatomy.paths(q)]);"""
    for q, (wrist, drawn) in zip(POSTURES, ask(script, POSTURES.tolist()), strict=True):
        seen = geometry(q)
        assert np.allclose(wrist, to_world(seen.joints[-1], 0.4))
        lengths = [np.linalg.norm(np.diff(path, axis=0), axis=1).sum() for path in drawn]
        assert np.allclose(lengths, paths(q)[0], atol=1e-3)
        for name, path in zip(MUSCLES, drawn, strict=True):
            gaps = np.linalg.norm(seen.muscles[name][:, None] - path, axis=-1)
            assert gaps.min(axis=1).max() < 3e-3, name


@pytest.mark.browser
def test_a_muscle_reddens_with_activation_and_swells_as_it_shortens(ask):
    rest, half, full = ask("return [0, 0.25, 1].map(vmcMuscles.redness);")
    assert np.allclose(half, np.mean([rest, full], axis=0))  # the root of a quarter
    assert full[1] < 0.2 < rest[1]
    script = """const told = JSON.parse(given.scene.find((m) => m.startsWith("anatomy|")).slice(8));
      const anatomy = new vmcAnatomy.Anatomy(told);
      return asked.map((q) => anatomy.paths(q).map((p, k) => anatomy.belly(p, told.muscles[k])));"""
    for k, name in enumerate(MUSCLES):
        straight, bent = (belly[k] for belly in ask(script, [[0.0, 0.2], [0.0, 1.6]]))
        shorter = name[:2] != "TR"  # bending shortens biceps and brachialis
        assert (max(bent["radii"]) > max(straight["radii"])) == shorter
        volumes = [volume(belly) for belly in (straight, bent)]
        assert volumes[0] == pytest.approx(volumes[1], rel=0.05)


def volume(belly):
    """Of a belly's flesh, as drawn."""
    steps = np.linalg.norm(np.diff(belly["centres"], axis=0), axis=1)
    radii = np.where(np.array(belly["flesh"]) > 0, belly["radii"], 0)
    return np.pi * (steps * (radii[1:] ** 2 + radii[:-1] ** 2) / 2).sum()


@pytest.mark.browser
@pytest.mark.parametrize("target", TARGETS, ids=str)
def test_postures_for_targets_are_pythons(ask, target):
    found = ask("return arm.inverseKinematics(asked);", target.tolist())
    assert np.allclose(found, inverse_kinematics(target))


@pytest.mark.browser
@pytest.mark.parametrize(
    ("name", "rule"), [("habitualWeights", habitual_weights), ("exactWeights", exact_weights)]
)
def test_plans_are_pythons(ask, name, rule):
    script = f"""const plan = vmcPlanning.plan(asked, templateSet, vmcPlanning.{name});
      return {{ ...plan, u: templateSet.excitations(plan) }};"""
    template_set = templates.load()
    own = template_set.points[surrounded(template_set.points, template_set.points)]
    for target in [*TARGETS, *own[:2]]:  # the last two on a template itself
        planned, expected = ask(script, target.tolist()), plan(target, template_set, rule)
        assert planned["chosen"] == expected.rows.tolist()
        assert np.allclose(planned["weights"], expected.weights, atol=1e-12)
        assert np.allclose(planned["u"], expected.excitations, atol=1e-12)


@pytest.mark.browser
@pytest.mark.parametrize("name", ["algorithm1", "broydenCalibration"])
def test_calibration_is_pythons(ask, name):
    script = f"""const plan = vmcPlanning.plan(asked, templateSet);
      return [...vmcCalibration.{name}(plan, ended(plan), given.calibration)];"""
    habit = plan(TARGETS, templates.load())
    rules = {
        "algorithm1": algorithm_1(habit),
        "broydenCalibration": broyden_calibration(habit, live.TRIALS),
    }
    for k, target in enumerate(TARGETS):
        trials = ask(script, target.tolist())
        for key in ("weights", "reached", "error"):
            got = np.array([trial[key] for trial in trials])
            assert np.abs(got - getattr(rules[name], key)[:, k]).max() < 1e-6, key


@pytest.mark.browser
def test_templates_on_a_line_and_targets_outside_are_refused(ask):
    script = "try {{ {} }} catch (error) {{ return error.message; }}"
    on_a_line = [[0.1, -0.4], [0.2, -0.4], [0.3, -0.4], [0.4, -0.4]]
    exact = script.format("return vmcPlanning.exactWeights([0.25, -0.35], asked);")
    assert "on one line" in ask(exact, on_a_line)
    planned = script.format("return vmcPlanning.plan(asked, templateSet);")
    assert "not surrounded" in ask(planned, [0.5, -0.4])


# ---- A reader who moves it ----


@pytest.mark.browser
def test_mujoco_is_loaded_on_a_click_and_from_the_books_own_files(opened, site):
    opened.page.wait_for_function("() => window.MeshCat")
    assert not any("mujoco" in url for url in opened.asked)
    start(opened.bench)
    assert any("vendor/mujoco.js" in url for url in opened.asked)
    inside = (site.as_uri(), "data:", "blob:")
    assert [url for url in opened.asked if not url.startswith(inside)] == []


@pytest.mark.browser
def test_the_page_tells_which_mujoco_it_has(opened, ask):
    assert ask("return arm.mujoco.mj_versionString();") == live.VERSIONS["page"]
    said = opened.bench.locator("[role=status]").inner_text()
    assert said.startswith(f"MuJoCo {live.VERSIONS['page']} (")


@pytest.mark.browser
def test_the_bench_answers_the_keyboard(opened):
    bench, keys = opened.bench, opened.page.keyboard
    bench.locator("[name=main]").focus()
    keys.press("Enter")
    wait_for_status(bench, "The arm is running")
    opened.page.wait_for_function(
        "() => !document.querySelector('[data-tell=time]').textContent.startsWith('0.00')"
    )
    keys.press("Enter")
    assert "Shoulder" in wait_for_status(bench, "Paused")
    bench.locator("[name=reset]").focus()
    keys.press("Enter")
    wait_for_status(bench, "Back at the start")
    assert (told(bench, "time"), told(bench, "elbow")) == ("0.00 s", "95.0°")
    bench.get_by_role("slider", name="BIClong").focus()
    keys.press("End")
    assert bench.locator("output").nth(MUSCLES.index("BIClong")).inner_text() == "1.00"
    bench.locator("[name=step]").focus()
    for _ in range(10):
        keys.press("Enter")
    assert told(bench, "time") == "0.10 s"
    said = [round(u, 2) for u in live.given()["rest"]]
    excitation = np.array(said)
    excitation[MUSCLES.index("BIClong")] = 1
    moved = simulate(np.tile(excitation, (100, 1)), templates.START, said, engine="mujoco")
    assert number(told(bench, "elbow")) == pytest.approx(np.degrees(moved.q[-1, 1]), abs=0.051)
    forward, up, right = 1000 * moved.hand[-1]
    for name, value in (("forward", forward), ("up", up), ("right", right)):
        assert number(told(bench, name)) == pytest.approx(value, abs=0.51)


@pytest.mark.browser
def test_the_arm_reaches_misses_and_calibrates(opened):
    reach, target = opened.reach, np.array([0.045, -0.35])
    start(reach)
    reach.get_by_label("target, forward").fill(str(target[0]))
    reach.get_by_label("target, up").fill(str(target[1]))
    trials = algorithm_1(plan(target, templates.load()))
    reach.locator("[name=main]").click()
    said = wait_for_status(reach, "The planned reach")
    assert f"{1000 * trials.error[0]:.1f} mm" in said
    reach.locator("[name=calibrate]").click()
    said = wait_for_status(reach, "After 21 tries")
    best = trials.error.argmin()
    assert f"n = {best - 1}" in said
    assert f"{1000 * trials.error[best]:.1f} mm" in said
    assert told(reach, "calibrated") == f"{1000 * trials.error[best]:.1f} mm"
    reach.get_by_label("ours").check()
    assert told(reach, "calibrated") == "–"  # another rule, another try
    reach.locator("[name=calibrate]").click()
    wait_for_status(reach, f"After {live.TRIALS} tries")
    ours = broyden_calibration(plan(target, templates.load()), live.TRIALS)
    assert told(reach, "calibrated") == f"{1000 * ours.error.min():.1f} mm"


@pytest.mark.browser
def test_a_target_is_set_by_pointing(opened):
    reach, mouse = opened.reach, opened.page.mouse
    start(reach)
    ring = reach.locator("svg circle[stroke='var(--vmc-green)']")
    box = ring.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    mouse.move(x, y)
    mouse.down()
    mouse.move(x - 80, y - 60, steps=4)
    mouse.up()
    moved = ring.bounding_box()
    assert moved["x"] - box["x"] == pytest.approx(-80, abs=6)  # sliders go by 5 mm
    assert moved["y"] - box["y"] == pytest.approx(-60, abs=6)
    assert number(reach.locator("output").first.inner_text()) < 0.12
    wait_for_status(reach, "A target is set")
    reach.get_by_label("target, forward").fill("0")
    reach.get_by_label("target, up").fill("-0.49")
    assert "not surrounded" in wait_for_status(reach, "Nothing planned")


@pytest.mark.browser
def test_who_wants_no_motion_sees_where_it_ends(visit):
    opened = visit(reduced_motion="reduce")
    start(opened.reach)
    frames = """() => vmcScene(document.querySelectorAll(".vmc-scene")[1])
      .viewer.renderer.info.render.frame"""
    before = opened.page.evaluate(frames)
    opened.reach.locator("[name=main]").click()
    wait_for_status(opened.reach, "The planned reach")
    assert opened.page.evaluate(frames) - before < 5
    assert opened.errors == []


@pytest.mark.browser
def test_without_webgl_the_arm_moves_in_the_side_view(visit):
    opened = visit("HTMLCanvasElement.prototype.getContext = () => null")
    start(opened.bench)
    assert "no 3-D picture" in wait_for_status(opened.bench, "The arm is running")
    assert opened.bench.locator(".vmc-scene").inner_text().startswith("An arm of two joints")
    assert opened.bench.locator("svg[data-axes] polyline").count() == 2
    assert opened.errors == []


@pytest.mark.browser
def test_without_webassembly_it_says_so(visit):
    opened = visit("delete self.WebAssembly")
    opened.bench.locator("[name=main]").click()
    wait_for_status(opened.bench, "This browser cannot run the arm")
    assert opened.bench.get_by_role("slider", name="BRA").is_disabled()


@pytest.mark.browser
def test_is_accessible_before_and_after_the_start(opened, serious):
    for _ in range(2):
        assert serious(opened.page, "main") == []
        for arm in (opened.bench, opened.reach):
            start(arm)


@pytest.mark.browser
def test_fits_a_phone(opened):
    opened.page.set_viewport_size({"width": 360, "height": 700})
    for arm in (opened.bench, opened.reach):
        start(arm)
    wide = """() => [...document.querySelectorAll("main *")]
      .filter((e) => e.getBoundingClientRect().right > 361)
      .filter((e) => !e.closest(".vmc-picture, .vmc-spoken"))
      .map((e) => e.outerHTML.slice(0, 100))"""
    assert opened.page.evaluate(wide) == []


# ---- What Python gives ----


def test_the_knots_that_travel_are_pythons():
    given = live.given()["templateSet"]
    knots = np.frombuffer(gzip.decompress(base64.b64decode(given["knots"])), np.float32)
    knots = knots.reshape(given["shape"]).astype(float)
    template_set = templates.load()
    assert np.abs(live.spline() @ knots - template_set.excitations).max() < 1e-12
    json.dumps(given, allow_nan=False)
    assert len(live.given()["F0"]) == len(F0)


def test_the_book_lists_every_script_in_the_order_of_need():
    assert [name for name in LISTED if name in {script.name for script in live.SCRIPTS}] == [
        script.name for script in live.SCRIPTS
    ]
    assert {*live.STATIC.glob("*.js")} <= {*live.SCRIPTS}
    assert {"demo.css", "live.css"} <= {*CONFIG["html_css_files"]}


def test_scripts_are_short():
    for script in (*live.STATIC.glob("*.*"), *live.SHOW.glob("*.*")):
        assert len(script.read_text(encoding="utf-8").splitlines()) <= 250, script.name


def test_the_versions_of_mujoco_are_those_of_the_files():
    manifest = json.loads((ROOT / "book/_static/vendor/manifest.json").read_bytes())
    (entry,) = [entry for entry in manifest if ROOT / entry["file"] == live.MUJOCO]
    assert live.VERSIONS == {"Python": mujoco.__version__, "page": entry["version"]}


def test_what_could_not_work_is_refused():
    with pytest.raises(ValueError, match="choose one of"):
        live_arm("dance", "c", "a")
    with pytest.raises(ValueError, match="not surrounded"):
        live_arm("reach", "c", "a", target=(0.5, 0.5))


@pytest.fixture
def live_page(offline, monkeypatch):
    """An empty page, and a function that makes a live widget of an arm."""
    monkeypatch.setenv("VMC_RENDER_MODE", "live")
    page = offline.new_page()

    def widget():
        shown = []
        monkeypatch.setattr(live, "display", lambda *items: shown.extend(items))
        live_arm("bench", "Move it.", "An arm.")
        still, widget, caption = shown
        assert "Run > Run All Cells" in still.data
        assert "Move it." in caption.data
        return widget

    yield page, widget
    page.close()


@pytest.mark.browser
def test_a_live_kernels_widget_moves(live_page, monkeypatch):
    page, widget = live_page
    render(page, widget(), monkeypatch)
    start(page.locator(".vmc-live"))
    wait_for_status(page.locator(".vmc-live"), "The arm is running")
    page.wait_for_selector(".vmc-scene canvas")


@pytest.mark.browser
def test_no_kernel_that_has_gone_is_asked_for_the_physics(live_page, monkeypatch):
    page, widget = live_page
    render(page, widget(), monkeypatch, "mine")
    render(page, widget(), monkeypatch, "other")  # of a chapter that was run later
    page.evaluate("() => { otherModel.closed = true }")
    mine = page.locator(".vmc-live").first
    start(mine)
    wait_for_status(mine, "The arm is running")


@pytest.mark.browser
def test_the_arm_says_that_the_kernel_has_gone(live_page, monkeypatch):
    page, widget = live_page
    render(page, widget(), monkeypatch)
    page.evaluate("() => { kernelModel.closed = true }")
    page.locator("[name=main]").click()
    wait_for_status(page.locator(".vmc-live"), "The kernel has gone: Run > Run All Cells")
