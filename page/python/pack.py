"""Two scripts of all that Python in the page is made of: what runs lines, and what draws demos.

The first holds Pyodide, NumPy and the library; the second matplotlib, and the library's figures.
From file:// a page can load nothing but classic scripts; in these each file is text, gzip in
base64; the members of a zip are stored, so that gzip finds what they share. The build writes them,
and a page loads each when its reader first asks for it.
"""

import json
import re
import zipfile
from pathlib import Path

from vmc_lib.show.packed import pack_bytes, pack_zip

ROOT = Path(__file__).parents[2]
VENDOR = Path(__file__).parent / "vendor"
SCRIPT, PLOTS = "vendor/python.js", "vendor/plots.js"  # where the built page finds them
# What can be imported in the page, by package, beside Python's own modules and NumPy. What these
# import where it is used (MuJoCo, SciPy, OpenCV, torch) is not there.
PACKAGES = {
    "page.python": "absent grader",
    "book.exercises": " ".join(path.stem for path in sorted(ROOT.glob("book/exercises/*.py"))),
    "reproduce": "one_draw paper",
    "reproduce.experiments": "calibration feedback_control offline_calibration",
    "reproduce.measures": "changed_worlds holding muscle_bench path_measures",
    "reproduce.peers": "lqr_tracking motor_noise muscle_models optimal_control state_estimation",
    "vmc_lib": "boxes camera checks compiled grading hints short_repr statistics",
    "vmc_lib.arm": "dynamics engines kinematics model muscle simulate",
    "vmc_lib.cerebellum": "adaptation feedback_error forward_model offline online two_rates",
    "vmc_lib.motor": "execution feedback inverse_dynamics planning templates",
    "vmc_lib.what": "crbm",
    "vmc_lib.where": "appearance kernels segmentation",
}
MODULES = [f"{package}.{name}" for package, names in PACKAGES.items() for name in names.split()]
DATA = {Path("vmc_lib/arm/arm26.xml"), Path("vmc_lib/data/__init__.py")}  # and what reads data
DATA |= {Path("reproduce/results/__init__.py"), Path("reproduce/results/optimal.npz")}
DATA |= {Path(f"vmc_lib/data/{name}.npz") for name in ("arm26", "rest", "templates")}
# Beside these a demo's `draw` may import anything of the library that the page has the means for
DRAWN = ("book/figures", "page/arm", "page/eye", "reproduce", "vmc_lib")
UNCHANGED = ("pyodide.js", "pyodide.asm.js", "pyodide.asm.wasm")
UNCHANGED += ("LICENSE-MPL-2.0", "LICENSE-PSF-2.0")
NEEDLESS = re.compile(  # in a page: headers, tests, other fonts, and what no browser can do
    r"\.(pyi|h|c|a|ini|pxd)$|/tests/|^numpy/(f2py|distutils)/|^numpy/linalg/lapack_lite"
    r"|^numpy/_core/(_simd|_(operand_flag|rational|struct_ufunc|umath)_tests)\."
    r"|^matplotlib/mpl-data/(sample_data|images|plot_directive|fonts/(afm|pdfcorefonts))/"
    r"|/fonts/ttf/(?!DejaVuSans(-Bold|-Oblique)?\.ttf|LICENSE)|^mpl_toolkits/"
    r"|^matplotlib/backends/(?!__init__|backend_(agg|mixed|svg)|_backend_agg|registry)"
    r"|^PIL/_(imagingft|imagingcms|webp)"
    r"|^(multiprocessing|wsgiref|xmlrpc)/|^(doctest|ftplib|imaplib|mailbox|nntplib|pdb|pickletools|poplib|smtplib)\.py$"
)
NOTICES = {
    SCRIPT: """/* Pyodide 0.27.7, MPL-2.0, unchanged; source: https://github.com/pyodide/pyodide.
   CPython 3.12 within it, PSF-2.0: https://github.com/python/cpython. NumPy 2.0.2, BSD-3-Clause,
   without its tests and headers: https://github.com/numpy/numpy. The book's own library. */
""",
    PLOTS: """/* matplotlib 3.8.4 and what it needs, as the Pyodide project built them, without
   their tests and most fonts; each licence is within. The book's own library. */
""",
}


def script(name=SCRIPT):
    """A script's text: it adds to `vmcPythonFiles`, {name: the file, gzip in base64}."""
    files = {SCRIPT: files_that_run, PLOTS: files_that_draw}[name]()
    packed = {name: pack_bytes(data) for name, data in files.items()}
    merged = f"Object.assign(self.vmcPythonFiles ?? {{}}, {json.dumps(packed)})"
    return f"{NOTICES[name]}self.vmcPythonFiles = {merged};\n"


def files_that_draw():
    """What draws a demo: {name: bytes}."""
    wheels = (path.name for path in sorted(VENDOR.glob("*.whl")) if "numpy" not in path.name)
    return {
        "plots.zip": pack_zip(dict(one for name in wheels for one in _needed_members(name))),
        "figures.zip": pack_zip(_read(drawn_paths())),
    }


def files_that_run():
    """What Pyodide asks for, the library, and the licences: {name: bytes}."""
    lock = json.loads((VENDOR / "pyodide-lock.json").read_bytes())
    numpy = lock["packages"]["numpy"]
    lock["packages"] = {"numpy": numpy}
    return {
        **{name: (VENDOR / name).read_bytes() for name in UNCHANGED},
        "pyodide-lock.json": json.dumps(lock).encode(),
        "python_stdlib.zip": pack_zip(dict(_needed_members("python_stdlib.zip"))),
        numpy["file_name"]: pack_zip(dict(_needed_members(numpy["file_name"]))),
        "library.zip": pack_zip(_read(paths())),
    }


def inputs():
    """Every file that the scripts are made of."""
    own = (ROOT / path for path in (*paths(), *drawn_paths()))
    return [Path(__file__), *VENDOR.iterdir(), *own]


def paths():
    """The files of `MODULES`, of the packages around them, and `DATA`, from the project's root."""
    modules = {Path(f"{name.replace('.', '/')}.py") for name in MODULES}
    packages = {parent / "__init__.py" for path in modules for parent in path.parents}
    return sorted(modules | DATA | {path for path in packages if (ROOT / path).exists()})


def drawn_paths():
    """What a demo's `draw` may import beside these, and the results that it may read."""
    sources = {path.relative_to(ROOT) for top in DRAWN for path in ROOT.glob(f"{top}/**/*.py")}
    results = {path.relative_to(ROOT) for path in ROOT.glob("reproduce/results/*.*")}
    own = {Path(f"page/python/{name}.py") for name in ("demos", "measure")}
    return sorted((sources | results | own | {Path("page/bundle.py")}) - set(paths()))


def _read(paths):
    return {path.as_posix(): (ROOT / path).read_bytes() for path in paths}


def _needed_members(archive):
    """What is needed of a vendored archive, (name, bytes), compiled where `compile.js` did that."""
    done = dict(_members("compiled.zip")) | dict(_members("compiled-plots.zip"))
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
