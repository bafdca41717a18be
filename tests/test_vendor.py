"""The scripts that ship are those that the manifest names."""

import base64
import json
import re
import runpy
import subprocess
import sys
from pathlib import Path

import meshcat
import pytest

from tools import bill, vendor
from vmc_lib.show.packed import unpack_bytes

ROOT = Path(__file__).parents[1]
WORKFLOWS = ROOT / ".github/workflows"


def test_vendored_files_match_the_manifest():
    assert vendor.problems() == []


def test_everything_vendored_is_credited():
    entries = json.loads(vendor.MANIFEST.read_bytes())
    assert entries
    for entry in entries:
        assert all(entry[key] for key in ("name", "version", "licence", "for", "origin", "sha256"))
        assert entry["version"] in entry["origin"], entry["name"]


def test_what_no_registry_has_is_here():
    entries = json.loads(vendor.MANIFEST.read_bytes())
    here = [entry for entry in entries if entry["origin"].startswith("here:")]
    assert here
    for entry in here:
        assert entry["origin"].rpartition(":")[2] == entry["file"]


def test_page_and_kernel_use_one_viewer():
    installed = Path(meshcat.__file__).parent / "viewer/dist/main.min.js"
    assert installed.read_bytes() == (ROOT / "book/_static/vendor/meshcat.js").read_bytes()


def test_a_module_and_its_wasm_become_one_classic_script():
    module = b"var load = () => import.meta.url;\nexport default load;\n"
    script = vendor.with_wasm(module, b"\0asm").decode()
    assert "import.meta" not in script
    assert "export" not in script
    packed = script.split('load.wasm = "')[1].split('"')[0]
    assert unpack_bytes(packed) == b"\0asm"


def test_a_style_sheet_takes_its_fonts_with_it(tmp_path):
    (tmp_path / "a.woff2").write_bytes(b"font")
    sheet = tmp_path / "a.css"
    sheet.write_text("@font-face{src:url(a.woff2) format(x),url(a.ttf);b:c}", encoding="utf-8")
    packed = base64.b64encode(b"font").decode()
    assert vendor.with_fonts(sheet).decode() == (
        f'@font-face{{src:url(data:font/woff2;base64,{packed}) format("woff2");b:c}}'
    )


@pytest.fixture
def elsewhere(monkeypatch, tmp_path):
    """A folder whose manifest names two files, a.js and b.js; a.js lies there, changed."""
    file = tmp_path / "book/_static/vendor/a.js"
    file.parent.mkdir(parents=True)
    file.write_text("changed", encoding="utf-8")
    manifest = file.parent / "manifest.json"
    entries = [
        {"file": f"book/_static/vendor/{name}", "origin": f"npm:{name}", "sha256": "0"}
        | {"name": name, "version": "1", "licence": "MIT"}
        for name in ("a.js", "b.js")
    ]
    manifest.write_text(json.dumps(entries), encoding="utf-8")
    monkeypatch.setattr(vendor, "ROOT", tmp_path)
    monkeypatch.setattr(vendor, "MANIFEST", manifest)
    monkeypatch.setattr(vendor, "CREDITS", tmp_path / "CREDITS.md")
    vendor.CREDITS.write_text(f"Before.\n{vendor.HEAD}| old |\n\nAfter.\n", encoding="utf-8")
    return file.parent


def test_changed_missing_and_stray_files_are_named(elsewhere):
    (elsewhere / "stray.js").write_text("", encoding="utf-8")
    problems = " ".join(vendor.problems())
    assert "a.js is not what" in problems
    assert "b.js is missing" in problems
    assert "stray.js is not in" in problems
    assert "CREDITS.md has another table" in problems


def test_the_table_takes_the_place_of_the_old_one(elsewhere):
    vendor.write_table()
    text = vendor.CREDITS.read_text(encoding="utf-8")
    assert text == f"Before.\n{vendor.table()}\nAfter.\n"
    assert vendor.table().count("\n") == 4


def test_a_download_with_another_checksum_is_refused(monkeypatch, elsewhere):
    monkeypatch.setattr(vendor, "fetch", lambda origin: b"another")
    before = vendor.MANIFEST.read_bytes()
    with pytest.raises(ValueError, match=r"npm:a\.js has the checksum .* --update"):
        vendor.refresh()
    assert (elsewhere / "a.js").read_text(encoding="utf-8") == "changed"
    assert vendor.MANIFEST.read_bytes() == before
    vendor.refresh(update=True)
    vendor.write_table()
    assert (elsewhere / "a.js").read_bytes() == b"another"
    assert vendor.problems() == []
    vendor.refresh()
    assert vendor.problems() == []


def test_an_option_that_there_is_not_fetches_nothing(monkeypatch):
    monkeypatch.setattr(sys, "argv", ["vendor", "--chek"])
    monkeypatch.setattr(subprocess, "run", None)
    with pytest.raises(SystemExit, match="2"):
        runpy.run_path(vendor.__file__, run_name="__main__")


def test_the_bill_holds_every_vendored_file_and_every_pin():
    components = bill.bill()["components"]
    hashes = {one["content"] for part in components for one in part["hashes"]}
    assert {entry["sha256"] for entry in json.loads(vendor.MANIFEST.read_bytes())} <= hashes
    versions = {part["name"]: part for part in components if part["purl"].startswith("pkg:pypi")}
    for line in (ROOT / "requirements.txt").read_text(encoding="utf-8").splitlines():
        if match := re.match(r"([\w.-]+)(?:\[.*\])?==([^\s;]+)", line):
            assert versions[match[1]]["version"] == match[2]
            assert versions[match[1]]["hashes"] or match[1] == "torch"
    purl = r"pkg:(npm|pypi|generic)/[^\s@]+@[^\s@]+"
    assert all(re.fullmatch(purl, part["purl"]) for part in components)


def test_workflows_pin_their_actions_and_a_release_holds_the_bill():
    texts = [file.read_text(encoding="utf-8") for file in WORKFLOWS.glob("*.yml")]
    uses = [line for text in texts for line in re.findall(r"uses: *(.*)", text)]
    assert len(uses) > 5
    pinned = r"[\w/-]+@[0-9a-f]{40} # v[\d.]+"
    assert [line for line in uses if not re.fullmatch(pinned, line)] == []
    assert "-m tools.bill > dist/" in (WORKFLOWS / "release.yml").read_text(encoding="utf-8")


def test_the_monthly_workflow_tries_what_the_lock_holds_back():
    newer = (WORKFLOWS / "newer.yml").read_text(encoding="utf-8")
    assert re.search(r"cron: .* 1 \* \*", newer)
    (install,) = re.findall(r"pip install (.*?) &&", newer)
    assert install == '-e ".[test]"'  # neither requirements.txt nor constraints.txt
    assert "touch .venv/.ready" in newer  # or `make test` would install the locked ones
