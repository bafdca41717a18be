"""The scripts that ship are those that the manifest names."""

import base64
import gzip
import importlib.util
import json
from pathlib import Path

import meshcat
import pytest

ROOT = Path(__file__).parents[1]
SPEC = importlib.util.spec_from_file_location("vendor", ROOT / "book/_ext/vendor.py")
vendor = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(vendor)


def test_vendored_files_are_what_the_manifest_says():
    assert vendor.problems() == []


@pytest.mark.parametrize("entry", json.loads(vendor.MANIFEST.read_text()), ids=lambda e: e["name"])
def test_everything_vendored_is_credited(entry):
    assert all(entry[key] for key in ("name", "version", "licence", "for", "origin", "sha256"))
    assert entry["version"] in entry["origin"]


def test_page_and_kernel_use_one_viewer():
    installed = Path(meshcat.__file__).parent / "viewer/dist/main.min.js"
    assert installed.read_bytes() == (ROOT / "book/_static/vendor/meshcat.js").read_bytes()


def test_a_module_and_its_wasm_become_one_classic_script():
    module = b"var load = () => import.meta.url;\nexport default load;\n"
    script = vendor.with_wasm(module, b"\0asm").decode()
    assert "import.meta" not in script and "export" not in script
    packed = script.split('load.wasm = "')[1].split('"')[0]
    assert gzip.decompress(base64.b64decode(packed)) == b"\0asm"


def test_a_changed_file_is_noticed(monkeypatch, tmp_path):
    file = tmp_path / "book/_static/vendor/a.js"
    file.parent.mkdir(parents=True)
    file.write_text("changed")
    (file.parent / "stray.js").write_text("")
    manifest = file.parent / "manifest.json"
    entries = [{"file": f"book/_static/vendor/{name}", "sha256": "0"} for name in ("a.js", "b.js")]
    manifest.write_text(json.dumps(entries))
    monkeypatch.setattr(vendor, "ROOT", tmp_path)
    monkeypatch.setattr(vendor, "MANIFEST", manifest)
    said = " ".join(vendor.problems())
    assert "a.js is not what" in said and "b.js is missing" in said and "stray.js is not in" in said
