"""One click elsewhere: Colab's first cell, and the devcontainer, as far as they run here."""

import json

import nbformat
import pytest

from tests.project import ROOT, python, run
from tools import colab

# What Colab has: the module, and a shell. What pip would do is worked out, and not done
STUB = """import sys, types
from IPython.core.interactiveshell import InteractiveShell
asked = []
output = types.ModuleType("google.colab.output")
output.enable_custom_widget_manager = lambda: asked.append("widgets")
here = types.ModuleType("google.colab")
here.output = output
sys.modules |= {"google": types.ModuleType("google"), "google.colab": here}
sys.path.insert(0, "")
shell = InteractiveShell.instance()
for cell in CELLS:
    result = shell.run_cell(cell)
    result.raise_error()
print(asked, shell.user_ns["_exit_code"])  # pip's"""
USED = "import book.figures, vmc_lib.show as s; print(book.__path__[0], s.__file__, sep='\\n')"


@pytest.mark.audit
def test_colabs_first_cell_fetches_the_book_into_an_empty_folder(tmp_path):
    repository, empty = tmp_path / "repository", tmp_path / "empty"
    run("git", "clone", "--quiet", "--depth", "1", ROOT.as_uri(), repository)
    empty.mkdir()
    notebook = colab.with_setup(nbformat.v4.new_notebook(), repository.as_uri())
    cells = [notebook.cells[0].source, USED]
    pip = {"PIP_DRY_RUN": "1", "PIP_NO_INDEX": "1", "PIP_NO_BUILD_ISOLATION": "0"}
    script = f"CELLS = {cells!r}\n{STUB}"
    lines = python("-c", script, cwd=empty, PYTHONPATH="", **pip).splitlines()
    for used in ("book", "vmc_lib/show/__init__.py"):
        assert str(empty / "sees_and_reaches" / used) in lines
    assert lines[-1] == "['widgets'] 0"


def test_the_first_cell_does_nothing_elsewhere(tmp_path):
    cell = colab.with_setup(nbformat.v4.new_notebook(), "nowhere").cells[0].source
    script = (
        "from IPython.core.interactiveshell import InteractiveShell\n"
        f"InteractiveShell.instance().run_cell({cell!r}).raise_error()"
    )
    assert python("-c", script, cwd=tmp_path) == ""
    assert list(tmp_path.iterdir()) == []


def test_what_colab_opens_are_the_chapters_behind_that_cell(tmp_path):
    colab.write(tmp_path, "https://example.org/book")
    for path in (tmp_path / "book").iterdir():
        first, *rest = nbformat.read(path, as_version=4).cells
        assert "git clone --quiet --depth 1 https://example.org/book" in first.source
        assert rest == nbformat.read(ROOT / "book" / path.name, as_version=4).cells
    nbformat.validate(nbformat.read(path, as_version=4))


def test_the_devcontainer_sets_itself_up_as_make_does():
    container = json.loads((ROOT / ".devcontainer/devcontainer.json").read_text(encoding="utf-8"))
    make, target = container["postCreateCommand"].split()
    lines = run(make, "--dry-run", "--always-make", target)
    assert "-r requirements.txt -e ." in lines
    settings = container["customizations"]["vscode"]["settings"]
    assert settings["python.defaultInterpreterPath"].endswith("/.venv/bin/python")


def test_the_workflow_fills_the_branch_to_which_the_button_leads():
    workflow = (ROOT / ".github/workflows/book.yml").read_text(encoding="utf-8")
    assert "python -m tools.colab _build/colab" in workflow
    assert "push --quiet --force origin colab" in workflow
    assert "/blob/colab/" in (ROOT / "book/_ext/offline.py").read_text(encoding="utf-8")
