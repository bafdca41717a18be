"""A page's one script, made of modules: each after what it imports, once, and none without use."""

import re

import pytest

from book._ext.offline import SCRIPTS
from kit.demos import STARTS
from page import bundle
from tests.pages import open_html
from tests.project import ROOT

MODULES = {
    path.relative_to(bundle.FOLDER).as_posix(): path.read_text(encoding="utf-8")
    for path in bundle.FOLDER.rglob("*.js")
    if not {"vendor", "compile.js"} & {*path.parts}
}
# What moves something in a kernel, in a page of its own, and the arm that others install
LIVE = ("demo/live.js", "demos/upload.js", "kernel.js")
ENTRIES = [*(f"book/{name}" for name in (*SCRIPTS, "storage.js")), *LIVE, *STARTS.values()]
ENTRIES.append("demo/travel.js")
# Vendored scripts leave what they hold; the window of a notebook, or of a page, has one table
GLOBALS = {"self.vmcBones", "self.vmcBrain", "self.vmcPythonFiles"}


@pytest.fixture
def written(tmp_path):
    """A function that writes modules {name: text} and bundles `a.js`."""

    def written(**texts):
        for name, text in texts.items():
            (tmp_path / f"{name}.js").write_text(text, encoding="utf-8")
        return bundle.bundle("a.js", folder=tmp_path)

    return written


@pytest.mark.browser
def test_a_bundle_runs_each_module_once_after_what_it_imports(written, offline):
    script = written(
        a='import * as b from "./b.js";\nimport { run as ran, Two } from "./c.js";\n'
        "export const all = [b.one, new Two().two, ...ran];\nexport { ran };\n",
        b='import { run } from "./c.js";\n\nexport const one = 1;\nrun.push("b");\n',
        c='export const run = ["c"];\nexport class Two { two = 2; }\n',
    )
    page = offline.new_page()
    assert page.evaluate(f"() => {script}({{}}).a") == {
        "all": [1, 2, "c", "b"],
        "ran": ["c", "b"],
    }
    again = f"() => {{ const table = {{}}; {script}(table); return {script}(table).a.all; }}"
    assert page.evaluate(again) == [1, 2, "c", "b"]
    page.close()


@pytest.mark.parametrize(
    ("texts", "said"),
    [
        ({"a": 'import { b } from "./b.js";\n', "b": 'import "./a.js";\n'}, "a.js → b.js → a.js"),
        ({"a": "export let a = 1;\n"}, "a.js: write `export let a = 1;`"),
        ({"a": 'import {\n  b } from "./b.js";\n'}, "a.js: write `import {`"),
    ],
    ids=["circle", "let", "lines"],
)
def test_what_a_bundle_cannot_hold_is_refused(written, texts, said):
    with pytest.raises(ValueError, match=re.escape(said)):
        written(**texts)


def test_every_module_is_part_of_a_page_a_kernel_or_the_kit():
    assert {*bundle.import_order(ENTRIES)} == MODULES.keys()


def test_modules_are_short_and_meet_by_imports_alone():
    for name, text in MODULES.items():
        assert text.count("\n") <= 250, name
        assert {*re.findall(r"\b(?:self|window|globalThis)\.vmc\w*", text)} <= GLOBALS, name


def test_a_page_has_one_script_of_ours(offline, site):
    page = open_html(offline, site, "<h1>A</h1>")
    assert page.evaluate("() => Object.keys(self).filter((name) => /^vmc/.test(name))") == ["vmc"]
    page.close()
    assert not [*(ROOT / "vmc_lib").rglob("*.js")]
