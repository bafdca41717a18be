"""The wheel of `vmc_lib` brings along what a live kernel shows demos with; pyproject.toml says so.

In a clone `vmc_lib.show` finds the same in `page`: both ask `page.bundle`.
"""

import shutil
from pathlib import Path
from runpy import run_path

from setuptools.command.build_py import build_py

# While a wheel is built, `page` is no package
BUNDLE = run_path(str(Path(__file__).parents[1] / "page/bundle.py"))
FILES = ("demo.css", "scene.css", "vendor/bones.js")  # as they are


class BuildWithPage(build_py):
    """`build_py` that writes vmc_lib/show/static as well; an editable install has the clone."""

    def run(self):
        """Do as `build_py` does, and write them."""
        super().run()
        if not self.editable_mode:
            write(Path(self.build_lib) / "vmc_lib/show/static")


def write(folder):
    """Write the script of demos, and the files, into a folder."""
    (folder / "vendor").mkdir(parents=True)
    for name in FILES:
        shutil.copy(BUNDLE["STATIC"] / name, folder / name)
    script = BUNDLE["widget_script"]("demo/live.js")
    (folder / "demo.js").write_text(script, encoding="utf-8", newline="\n")
