"""The arm as a package of its own: its example moves offline, and Node runs what npm packs."""

import json
import re
import shutil

import numpy as np
import pytest

from kit import arm
from page.arm.live import page_constants
from tests.pages import observe
from tests.project import run
from vmc_lib.arm.simulate import simulate
from vmc_lib.motor import templates

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    arm.build(folder := tmp_path_factory.mktemp("package") / "arm-in-page")
    return folder


def test_the_example_is_short_and_its_arm_moves_with_the_slider(package, offline):
    assert (package / "example.html").read_text(encoding="utf-8").count("\n") <= 20
    page = observe(offline.new_page())
    page.goto((package / "example.html").as_uri())
    hand = (
        "+document.getElementById('arm').getAttribute('points')?.split(/[ ,]/)[5]"  # down: metres
    )
    page.wait_for_function(f"{hand} > .2")  # where it settles, too
    page.locator("input").press("End")
    page.wait_for_function(f"{hand} < .2")
    assert page.errors == page.failed == []
    assert all(url.startswith("file:") for url in page.asked)
    page.close()


USE = """const armInPage = require("arm-in-page");
(async () => {
  const arm = await armInPage.load(), templates = await armInPage.templates();
  const plan = armInPage.plan([0.09, -0.37], templates);
  const reach = (weights) => arm.hold(arm.reach(templates.excitations({ ...plan, weights })));
  const tries = [...armInPage.broydenCalibration(plan, reach, armInPage.calibration)];
  const motion = arm.move(Array(200).fill([0.5, 0, 0, 0.2, 0, 0]));
  console.log(JSON.stringify([tries.map(({ error }) => error), motion.at(-1).q]));
})();"""


def test_npm_packs_it_and_node_runs_it(package, tmp_path):
    """What it says of a movement is what Python says; a reach gets better with tries."""
    node, npm = map(shutil.which, ("node", "npm"))
    if not (node and npm):
        pytest.skip("there is no Node on this machine")
    copy = shutil.copytree(package, tmp_path / "package")
    run(npm, "pack", "--silent", "--offline", cwd=copy)
    [tarball] = copy.glob("*.tgz")
    assert tarball.stat().st_size < 3e6
    (installed := tmp_path / "node_modules/arm-in-page").mkdir(parents=True)
    shutil.unpack_archive(tarball, tmp_path / "unpacked", "gztar")
    shutil.copytree(tmp_path / "unpacked/package", installed, dirs_exist_ok=True)
    (tmp_path / "use.js").write_text(USE, encoding="utf-8")
    errors, posture = json.loads(run(node, "use.js", cwd=tmp_path))
    assert errors[-1] < errors[0]
    wild = np.tile([0.5, 0, 0, 0.2, 0, 0], (1, 200, 1))
    motion = simulate(wild, templates.START, page_constants()["rest"], engine="mujoco")
    assert np.abs(motion.q[0, -1] - posture).max() < 1e-6


def test_its_readme_is_a_screen_and_names_what_is_there(package, offline):
    readme = (package / "README.md").read_text(encoding="utf-8")
    assert readme.count("\n") <= 45
    page = offline.new_page()
    page.goto((package / "example.html").as_uri())
    for name, of in (("armInPage", "armInPage"), ("arm", "await armInPage.load()")):
        names = re.findall(rf"\b{name}\.(\w+)", readme.replace("arm.js", ""))
        assert len(names) > 5
        there = page.evaluate(
            f"async (names) => (of => names.filter(n => !(n in of)))({of})", names
        )
        assert there == []
    page.close()
