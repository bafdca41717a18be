/* The modules that Python in the page starts with, compiled by that Python into vendor/compiled.zip,
   so that no reader's browser has to: most of its start went there. node python_in_page/compile.js */
const { writeFileSync } = require("fs");
const { join } = require("path");

const VENDOR = join(__dirname, "vendor");
const { loadPyodide } = require(join(VENDOR, "pyodide.js"));

const COMPILE = `
import io, sys, zipfile
from importlib.util import MAGIC_NUMBER, source_hash
from marshal import dumps
from pathlib import Path

import ast, inspect, numpy.random  # what the grader needs

UNCHECKED = (1).to_bytes(4, "little")  # the source's hash stands in the header for our tests
library = zipfile.ZipFile("/lib/python312.zip")
site = Path(numpy.__file__).parents[1]
sources = {name: library.read(name) for name in library.namelist()}
sources |= {path.relative_to(site).as_posix(): path.read_bytes() for path in site.glob("numpy/**/*.py")}
stems = {name.replace(".", "/") for name in sys.modules}
packed = io.BytesIO()
with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
    for name, source in sorted(sources.items()):
        if name.removesuffix(".py").removesuffix("/__init__") in stems:
            code = dumps(compile(source, name, "exec", dont_inherit=True))
            info = zipfile.ZipInfo(name + "c")
            header = MAGIC_NUMBER + UNCHECKED + source_hash(source)
            archive.writestr(info, header + code, zipfile.ZIP_DEFLATED, 9)
packed.getvalue()`;

(async () => {
  const python = await loadPyodide({ indexURL: VENDOR, packages: ["numpy"] });
  writeFileSync(join(VENDOR, "compiled.zip"), python.runPython(COMPILE).toJs());
})();
