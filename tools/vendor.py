"""Third-party scripts that the book ships, each pinned by version and checksum.

python -m tools.vendor             fetch them again (npm, and the installed meshcat package)
python -m tools.vendor --update    the same, where the manifest names new versions
python -m tools.vendor --check     compare the files here, and CREDITS.md's table, with the manifest
python -m tools.vendor --table     write that table, as the first two do
"""

import argparse
import base64
import hashlib
import json
import re
import subprocess
import sys
import tarfile
import tempfile
from importlib import metadata, resources
from pathlib import Path

from vmc_lib.show.packed import pack_bytes

ROOT = Path(__file__).parents[1]
MANIFEST = ROOT / "book/_static/vendor/manifest.json"
MADE_HERE = {ROOT / "page/static/vendor/bones.js"}  # by reproduce.render.bone_meshes
CREDITS = ROOT / "CREDITS.md"
HEAD = "| What | Version | Licence | File | Source | SHA-256 |\n|---|---|---|---|---|---|\n"


def fetch(origin):
    """The bytes of `origin`: "npm:name@version:path" or "python:name@version:path".

    A path may be "module.js+module.wasm" or "one.js+two.js": then the two are made one script. A
    style sheet takes its fonts with it. What no registry has is "here:name@version:path", from the
    project's root.
    """
    registry, package, path = origin.split(":")
    name, version = package.rsplit("@", 1)
    if registry == "here":
        return (ROOT / path).read_bytes()
    if registry == "python":
        installed = metadata.version(name)
        if installed != version:
            raise ValueError(f"{name} {installed} is installed, the manifest wants {version}")
        return resources.files(name).joinpath(path).read_bytes()
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["npm", "pack", "--silent", package], cwd=folder, check=True)
        with tarfile.open(next(Path(folder).glob("*.tgz"))) as archive:
            archive.extractall(folder, filter="data")
        files = [Path(folder, "package", part) for part in path.split("+")]
        if path.endswith(".css"):
            return with_fonts(*files)
        parts = [file.read_bytes() for file in files]
    module_and_wasm = len(parts) == 2 and path.endswith(".wasm")
    return with_wasm(*parts) if module_and_wasm else b"\n".join(parts)


def with_fonts(sheet):
    """A style sheet (a file) and the fonts beside it as one: Firefox loads none from file://."""

    def embed_font(source):
        font = base64.b64encode((sheet.parent / source[1]).read_bytes()).decode()
        return f'src:url(data:font/woff2;base64,{font}) format("woff2")'

    text = re.sub(
        r"src: ?url\(([^)]*\.woff2)\)[^;}]*", embed_font, sheet.read_text(encoding="utf-8")
    )
    return text.encode()


def with_wasm(module, wasm):
    """An ES module and its WebAssembly as one classic script: from file:// nothing else loads.

    The module's default export becomes a global function, its `wasm` the binary in gzip and base64.
    """
    script = module.decode().replace("import.meta.url", "document.baseURI")
    script, name, _ = re.split(r"^export default (\w+);$", script, flags=re.M)
    return f'{script}{name}.wasm = "{pack_bytes(wasm)}";\n'.encode()


def problems():
    """What is wrong with the vendored files, one sentence each; none is right."""
    wrong, entries = [], json.loads(MANIFEST.read_bytes())
    for entry in entries:
        file = ROOT / entry["file"]
        if not file.exists():
            wrong.append(f"{entry['file']} is missing")
        elif hashlib.sha256(file.read_bytes()).hexdigest() != entry["sha256"]:
            wrong.append(f"{entry['file']} is not what the manifest says")
    listed = {ROOT / entry["file"] for entry in entries}
    folders = {file.parent for file in listed}
    stray = (
        {file for folder in folders for file in folder.iterdir()} - listed - {MANIFEST} - MADE_HERE
    )
    for file in sorted(stray):
        wrong.append(f"{file.relative_to(ROOT)} is not in the manifest")
    if table() not in CREDITS.read_text(encoding="utf-8"):
        wrong.append(
            "CREDITS.md has another table than the manifest: python -m tools.vendor --table"
        )
    return wrong


def table():
    """The manifest as a Markdown table."""
    rows = (
        "| {name} | {version} | {licence} | `{file}` | `{origin}` | `{sha256}` |\n".format_map(
            entry
        )
        for entry in json.loads(MANIFEST.read_bytes())
    )
    return HEAD + "".join(rows)


def write_table():
    """Put the table into CREDITS.md, in place of the one that stands there."""
    before, _, after = CREDITS.read_text(encoding="utf-8").partition(HEAD)
    after = re.sub(r"\A(\|.*\n)*", "", after)
    CREDITS.write_text(before + table() + after, encoding="utf-8", newline="\n")


def refresh(update=False):
    """Fetch every file anew; with `update`, write the checksums of what came into the manifest.

    Raises ValueError, and leaves the file as it is, where what came is not what the manifest says.
    """
    entries = json.loads(MANIFEST.read_bytes())
    for entry in entries:
        data = fetch(entry["origin"])
        summed = hashlib.sha256(data).hexdigest()
        if update:
            entry["sha256"] = summed
        elif summed != entry["sha256"]:
            raise ValueError(
                f"{entry['origin']} has the checksum {summed}, the manifest wants "
                f"{entry['sha256']}: look at it, and if it is right, accept it with --update"
            )
        file = ROOT / entry["file"]
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(data)
    MANIFEST.write_text(json.dumps(entries, indent=2) + "\n", encoding="utf-8", newline="\n")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(
        "python -m tools.vendor", description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    one_of = parser.add_mutually_exclusive_group()
    for option in ("--update", "--check", "--table"):
        one_of.add_argument(option, action="store_true")
    options = parser.parse_args()
    if not (options.check or options.table):
        refresh(options.update)
    if not options.check:
        write_table()
    sys.exit("\n".join(problems()) or 0)
