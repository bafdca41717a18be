"""Chapters are executed when they, or what they import, changed: a tiny book, built."""

import shutil
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest

ROOT = Path(__file__).parents[1]
CODE = "open('count', 'a').write('x')\nimport sys\nprint('printed', 6 * 7)"


@pytest.fixture
def book(tmp_path):
    """A book of one chapter, which counts its executions, over a library of one line."""
    shutil.copy(ROOT / "_config.yml", tmp_path)
    (tmp_path / "_toc.yml").write_text("format: jb-book\nroot: book/chapter\n", encoding="utf-8")
    shutil.copytree(ROOT / "book/_ext", tmp_path / "book/_ext")
    for folder in ("book/_static", "vmc_lib/show/static", "arm_in_page/static"):
        (tmp_path / folder).mkdir(parents=True)
        shutil.copytree(
            ROOT / folder, tmp_path / folder, dirs_exist_ok=True, ignore=lambda *_: ["vendor"]
        )
    (tmp_path / "book/references.bib").touch()
    (tmp_path / "vmc_lib/one.py").write_text("line = 1\n", encoding="utf-8")
    write(tmp_path, CODE)
    return tmp_path


def write(book, code):
    cells = [nbformat.v4.new_markdown_cell("# A chapter", id="title")]
    cells += [nbformat.v4.new_code_cell(code, id="code")]
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3"}}
    nbformat.write(
        nbformat.v4.new_notebook(cells=cells, metadata=kernel), book / "book/chapter.ipynb"
    )


def build(book):
    command = [Path(sys.executable).with_name("jupyter-book"), "build", "-n", "."]
    return subprocess.run(command, cwd=book, capture_output=True, encoding="utf-8", check=False)


def times_executed(book):
    return len((book / "book/count").read_text(encoding="utf-8"))


def test_what_did_not_change_is_not_executed_again(book):
    for _ in range(2):
        build(book)
        assert times_executed(book) == 1
        assert "printed 42" in (book / "_build/html/book/chapter.html").read_text(encoding="utf-8")
    (book / "vmc_lib/one.py").write_text("line = 2\n", encoding="utf-8")  # one line of the library
    build(book)
    assert times_executed(book) == 2
    write(book, CODE + "  # another word")
    build(book)
    assert times_executed(book) == 3


def test_a_failure_names_chapter_cell_and_remedy(book):
    write(book, "1 / 0")
    done = build(book)
    assert done.returncode != 0
    told = (book / "_build/.failed").read_text(encoding="utf-8")
    assert "chapter.ipynb, cell code (`1 / 0`): ZeroDivisionError: division by zero" in told
    assert told in done.stdout + done.stderr
    assert "make lab" in told
