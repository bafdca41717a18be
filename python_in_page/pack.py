"""One script of all that Python in the page is made of: Pyodide, NumPy, and the library itself.

From file:// a page can load nothing but classic scripts; in this one each file is text, gzip in
base64. The build writes it, and a page loads it when its reader first writes in an exercise.
"""

import base64
import gzip
import io
import json
import re
import zipfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
VENDOR = Path(__file__).parent / "vendor"
SCRIPT = "vendor/python.js"  # where the built page finds it
# What can be imported in the page, by package, beside Python's own modules and NumPy. What these
# import where it is used (MuJoCo, SciPy, OpenCV, torch) is not there.
PACKAGES = {
    "python_in_page": "grader",
    "book.exercises": " ".join(path.stem for path in sorted(ROOT.glob("book/exercises/*.py"))),
    "reproduce": "paper experiments.muscle_bench peers.muscle_models",
    "vmc_lib": "boxes camera compiled grading statistics",
    "vmc_lib.arm": "dynamics engines kinematics model muscle simulate",
    "vmc_lib.cerebellum": "adaptation feedback_error forward_model offline online two_rates",
    "vmc_lib.motor": "execution feedback inverse_dynamics planning templates",
    "vmc_lib.what": "crbm",
    "vmc_lib.where": "appearance kernels segmentation",
}
MODULES = [f"{package}.{name}" for package, names in PACKAGES.items() for name in names.split()]
DATA = {Path("vmc_lib/arm/arm26.xml"), Path("vmc_lib/data/__init__.py")}  # and what reads data
DATA |= {Path(f"vmc_lib/data/{name}.npz") for name in ("arm26", "rest", "templates")}
UNCHANGED = ("pyodide.js", "pyodide.asm.js", "pyodide.asm.wasm")
UNCHANGED += ("LICENSE-MPL-2.0", "LICENSE-PSF-2.0")
NEEDLESS = re.compile(  # in a page: NumPy's headers and tests, and what no browser can do
    r"\.(pyi|h|c|a|ini|pxd)$|/tests/|^numpy/(f2py|distutils)/"
    r"|^(multiprocessing|wsgiref|xmlrpc)/|^(doctest|ftplib|imaplib|mailbox|nntplib|pdb|pickletools|poplib|smtplib)\.py$"
)
NOTICE = """/* Pyodide 0.27.7, MPL-2.0, unchanged; source: https://github.com/pyodide/pyodide.
   CPython 3.12 within it, PSF-2.0: https://github.com/python/cpython. NumPy 2.0.2, BSD-3-Clause,
   without its tests and headers: https://github.com/numpy/numpy. The book's own library. */
"""


def script():
    """The script's text: it defines `vmcPythonFiles`, {name: the file, gzip in base64}."""
    packed = {name: base64.b64encode(_gzip(data)).decode() for name, data in files().items()}
    return f"{NOTICE}self.vmcPythonFiles = {json.dumps(packed)};\n"


def files():
    """What Pyodide asks for, the library, and the licences: {name: bytes}."""
    lock = json.loads((VENDOR / "pyodide-lock.json").read_bytes())
    numpy = lock["packages"]["numpy"]
    lock["packages"] = {"numpy": numpy}
    return {
        **{name: (VENDOR / name).read_bytes() for name in UNCHANGED},
        "pyodide-lock.json": json.dumps(lock).encode(),
        "python_stdlib.zip": _stored(_compiled("python_stdlib.zip")),
        numpy["file_name"]: _stored(_compiled(numpy["file_name"])),
        "library.zip": _stored((path.as_posix(), (ROOT / path).read_bytes()) for path in paths()),
    }


def inputs():
    """Every file that the script is made of."""
    return [Path(__file__), *VENDOR.iterdir(), *(ROOT / path for path in paths())]


def paths():
    """The files of `MODULES`, of the packages around them, and `DATA`, from the project's root."""
    modules = {Path(f"{name.replace('.', '/')}.py") for name in MODULES}
    packages = {parent / "__init__.py" for path in modules for parent in path.parents}
    return sorted(modules | DATA | {path for path in packages if (ROOT / path).exists()})


def _compiled(archive):
    """What is needed of a vendored archive, (name, bytes), compiled where `compile.js` did that."""
    done = dict(_members("compiled.zip"))
    for name, data in _members(archive):
        compiled = f"{name}c"
        if compiled in done:
            yield compiled, done[compiled]
        elif not NEEDLESS.search(name):
            yield name, data


def _members(archive):
    with zipfile.ZipFile(VENDOR / archive) as opened:
        for info in opened.infolist():
            yield info.filename, opened.read(info)


def _stored(members):
    """A zip of (name, bytes), not compressed, so that gzip finds what its files share."""
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w") as opened:
        for name, data in members:
            opened.writestr(zipfile.ZipInfo(name), data)
    return archive.getvalue()


def _gzip(data):
    return gzip.compress(data, mtime=0)
