"""The arm in the page as a package that others can use: one script, a README, an example.

`npm pack` in that folder makes the archive that npm installs.
"""

import json
import shutil
from importlib.metadata import version

from book._ext.policy import seal
from kit.demos import ROOT
from page.arm.controls import MUJOCO
from page.arm.live import page_constants
from page.bundle import bundle

SCRIPT = """/* The arm of `A book that sees and reaches`, and MuJoCo (Apache-2.0): see README.md. */
const armInPage = (() => {{
  const document = globalThis.document ?? // or Node's
    {{ baseURI: require("url").pathToFileURL(__filename).href }};
{mujoco}
  const vmc = {modules}({{}});
  const given = {constants};
  return {{
    muscles: given.muscles, start: given.start, rest: given.rest,
    load: () => vmc["arm/load"].load(given),
    templates: () => vmc["arm/templates"].load(given.templateSet),
    ...vmc["arm/planning"], ...vmc["arm/calibration"], calibration: given.calibration,
  }};
}})();
if (typeof module === "object") module.exports = armInPage;
"""
MODULES = ("load", "templates", "planning", "calibration")  # of page/arm: what it exports
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
    script = SCRIPT.format(
        mujoco=MUJOCO.read_text(encoding="utf-8"),
        modules=bundle(*(f"arm/{name}.js" for name in MODULES)),
        constants=json.dumps(page_constants(), allow_nan=False),
    )
    (folder / "arm.js").write_text(script, encoding="utf-8")
    example = (ROOT / "page/arm/example.html").read_text(encoding="utf-8")
    (folder / "example.html").write_text(seal(example), encoding="utf-8")
    (folder / "package.json").write_text(json.dumps(NPM, indent=2) + "\n", encoding="utf-8")
    for name in ("page/arm/README.md", "LICENSE", "CREDITS.md"):
        shutil.copy(ROOT / name, folder)
