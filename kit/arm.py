"""The arm in the page as a package that others can use: one script, a README, an example.

`npm pack` in that folder makes the archive that npm installs.
"""

import json
import shutil
from importlib.metadata import version

from book._ext.policy import seal
from kit.demos import ROOT
from page.arm.controls import MUJOCO, STATIC
from page.arm.live import MODEL_SCRIPTS, given
from vmc_lib.show.render_mode import STATIC as SHOW

SCRIPT = """/* The arm of `A book that sees and reaches`, and MuJoCo (Apache-2.0): see README.md. */
const armInPage = (() => {{
  const document = globalThis.document ?? // or Node's
    {{ baseURI: require("url").pathToFileURL(__filename).href }};
{scripts}
  const given = {constants};
  return {{
    muscles: given.muscles, start: given.start, rest: given.rest,
    load: () => vmcArm.load(given),
    templates: () => vmcTemplates.load(given.templateSet),
    ...vmcPlanning, ...vmcCalibration, calibration: given.calibration,
  }};
}})();
if (typeof module === "object") module.exports = armInPage;
"""
NPM = {
    "name": "arm-in-page",
    "version": version("vmc_lib"),
    "description": "A human arm of two joints and six muscles, its physics by MuJoCo, in a page",
    "main": "arm.js",
    "license": "(BSD-3-Clause AND Apache-2.0 AND CC-BY-3.0)",
    "files": ["*"],
}


def build(folder):
    """Write the package into a new folder."""
    folder.mkdir(parents=True)
    paths = [SHOW / "vendored.js", *(STATIC / f"{name}.js" for name in MODEL_SCRIPTS), MUJOCO]
    scripts = "\n".join(path.read_text(encoding="utf-8") for path in paths)
    script = SCRIPT.format(scripts=scripts, constants=json.dumps(given(), allow_nan=False))
    (folder / "arm.js").write_text(script, encoding="utf-8")
    example = (ROOT / "arm_in_page/example.html").read_text(encoding="utf-8")
    (folder / "example.html").write_text(seal(example), encoding="utf-8")
    (folder / "package.json").write_text(json.dumps(NPM, indent=2) + "\n", encoding="utf-8")
    for name in ("arm_in_page/README.md", "LICENSE", "CREDITS.md"):
        shutil.copy(ROOT / name, folder)
