/* The modules that Python in the page starts with, compiled by that Python into vendor/compiled.zip,
   and those that it draws with, into vendor/compiled-plots.zip: so that no reader's browser has to,
   where most of its start went. node page/python/compile.js */
const { readFileSync, readdirSync, writeFileSync } = require("fs");
const { join } = require("path");

const VENDOR = join(__dirname, "vendor");
const { loadPyodide } = require(join(VENDOR, "pyodide.js"));

const COMPILE = `
import io, sys, zipfile
from importlib.util import MAGIC_NUMBER, source_hash
from marshal import dumps
from pathlib import Path

UNCHECKED = (1).to_bytes(4, "little")  # the source's hash stands in the header for our tests
done = set()

def strip_docstrings(source):
    """A module's tree without the words of its docstrings: they were a tenth of all that is packed."""
    tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and ast.get_docstring(node):
            node.body[0].value.value = ""
    return tree

def compile_modules(sources):
    """A zip of the modules that are imported by now, and were not in the last one."""
    stems = {name.replace(".", "/") for name in sys.modules} - done
    done.update(stems)
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, source in sorted(sources.items()):
            if name.removesuffix(".py").removesuffix("/__init__") in stems:
                code = dumps(compile(strip_docstrings(source), name, "exec", dont_inherit=True))
                info = zipfile.ZipInfo(name + "c")
                header = MAGIC_NUMBER + UNCHECKED + source_hash(source)
                archive.writestr(info, header + code, zipfile.ZIP_DEFLATED, 9)
    return packed.getvalue()

def sources(pattern):
    return {path.relative_to(site).as_posix(): path.read_bytes() for path in site.glob(pattern)}

import ast, inspect, numpy.random  # what the grader needs
site = Path(numpy.__file__).parents[1]
library = zipfile.ZipFile("/lib/python312.zip")
library = {name: library.read(name) for name in library.namelist()}`;
const FIRST = `compile_modules(library | sources("numpy/**/*.py"))`;
const PLOTS = `
import matplotlib
matplotlib.use("svg")
import matplotlib.pyplot
from matplotlib.backends import backend_svg
figure, axes = matplotlib.pyplot.subplots(layout="constrained")
axes.set_title("$x$")
figure.savefig(io.StringIO(), format="svg")
compile_modules({name: source for name, source in sources("**/*.py").items() if "numpy" not in name})`;

(async () => {
  const python = await loadPyodide({ indexURL: VENDOR, packages: ["numpy"] });
  const write = (name, code) => writeFileSync(join(VENDOR, name), python.runPython(code).toJs());
  python.runPython(COMPILE);
  write("compiled.zip", FIRST);
  const site = { extractDir: python.runPython("str(site)") };
  for (const name of readdirSync(VENDOR).filter((one) => one.endsWith(".whl") && !one.startsWith("numpy")))
    python.unpackArchive(new Uint8Array(readFileSync(join(VENDOR, name))).buffer, "zip", site);
  write("compiled-plots.zip", PLOTS);
})();
