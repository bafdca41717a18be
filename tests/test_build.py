"""A tiny book, built: chapters run only when they change, and open elsewhere by buttons."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest

from book._ext.packed import strip_comments
from eye_in_page import brain
from python_in_page import pack
from tests import pages

ROOT = Path(__file__).parents[1]
TRICKY = r"""/* A comment
   of two lines. */
(() => {
  // "quotes' and `ticks
  const inside = [1, 2].map((n) => `  ${n / 2 /* gone */}
    // stays ${[`/* in
  side */`, /["'`/*]/.source].join("//")}`);
  return [`

  `, ...inside, 'it\'s /* a string'].join(); // gone
})()
"""
CODE = "open('count', 'a').write('x')\nimport sys\nprint('printed', 6 * 7)"


@pytest.fixture
def book(tmp_path):
    """A book of one chapter, which counts its executions, over a library of one line."""
    shutil.copy(ROOT / "_config.yml", tmp_path)
    shutil.copytree(ROOT / "book/_ext", tmp_path / "book/_ext")
    for static in pages.STATIC:
        folder = static.relative_to(ROOT)
        (tmp_path / folder).mkdir(parents=True)
        shutil.copytree(
            ROOT / folder, tmp_path / folder, dirs_exist_ok=True, ignore=lambda *_: ["vendor"]
        )
    for file in ("references.bib", "glossary.md"):
        (tmp_path / "book" / file).touch()
    (tmp_path / "vmc_lib/one.py").write_text("line = 1\n", encoding="utf-8")
    write(tmp_path, CODE)
    return tmp_path


def write(book, code, text="", name="chapter"):
    """Write a chapter, and the table of contents: it first, and the others so far."""
    cells = [nbformat.v4.new_markdown_cell(f"# A chapter\n\n{text}", id="title")]
    cells += [nbformat.v4.new_code_cell(code, id="code")]
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3"}}
    notebook = nbformat.v4.new_notebook(cells=cells, metadata=kernel)
    nbformat.write(notebook, book / f"book/{name}.ipynb")
    first, *others = sorted(file.stem for file in (book / "book").glob("*.ipynb"))
    chapters = "chapters:\n" * bool(others) + "".join(f"- file: book/{one}\n" for one in others)
    toc = f"format: jb-book\nroot: book/{first}\n{chapters}"
    (book / "_toc.yml").write_text(toc, encoding="utf-8")


def build(book, **repository):
    """Build the book strictly, as of a repository or of none: the page, or the failed process."""
    environment = {k: v for k, v in os.environ.items() if not k.startswith("GITHUB_")} | repository
    command = [
        Path(sys.executable).with_name("jupyter-book"),
        "build",
        "-W",
        "-n",
        "--keep-going",
        ".",
    ]
    done = subprocess.run(
        command, cwd=book, env=environment, capture_output=True, encoding="utf-8", check=False
    )
    page = book / "_build/html/book/chapter.html"
    return done if done.returncode else page.read_text(encoding="utf-8")


def times_executed(book):
    return len((book / "book/count").read_text(encoding="utf-8"))


def links(page):
    return re.findall(r'href="([^"]+)"', page)


@pytest.mark.browser
def test_a_script_without_comments_does_the_same(offline):
    page = offline.new_page()
    assert page.evaluate(strip_comments(TRICKY)) == page.evaluate(TRICKY)
    assert not re.search("of two|quotes|gone|^ +const", strip_comments(TRICKY), re.M)
    page.close()


def test_a_chapter_is_executed_when_it_or_the_library_changed(book):
    for _ in range(2):
        page = build(book)
        assert times_executed(book) == 1
        assert "printed 42" in page
    for packed in (pack, brain):  # the page's Python, and what its eye has learnt
        assert (book / "_build/html/_static" / packed.SCRIPT).stat().st_size > 1e6
    script = (book / "_build/html/_static/see.js").read_text(encoding="utf-8")
    assert script.startswith("// Readable in eye_in_page/static/see.js\nObject")
    assert (book / "_build/html/.nojekyll").exists()  # or GitHub's pages leave _static out
    # It can be saved, and without a repository nothing leads out
    assert "../_sources/book/chapter.ipynb" in links(page)
    assert not [link for link in links(page) if link.startswith("http")]
    (book / "vmc_lib/one.py").write_text("line = 2\n", encoding="utf-8")  # one line of the library
    build(book)
    assert times_executed(book) == 2
    write(book, CODE + "  # another word")
    repository = {"GITHUB_SERVER_URL": "https://github.com", "GITHUB_REPOSITORY": "owner/name"}
    page = build(book, **repository)
    assert times_executed(book) == 3
    assert [link for link in links(page) if link.startswith("http")] == [
        "https://mybinder.org/v2/gh/owner/name/main?urlpath=lab/tree/book/chapter.ipynb",
        "https://colab.research.google.com/github/owner/name/blob/main/book/chapter.ipynb",
    ]


def test_settings_are_no_scripts_inside_a_page(book):
    write(book, CODE, "$$1 + 1$$\n\n:::{note}\n:class: dropdown\nWords.\n:::")
    inside = re.findall(r"<script[^>]*>([^<]+)</script>", build(book))
    assert inside
    assert all(re.search(r"DOCUMENTATION_OPTIONS|dataset\.mode", code) for code in inside)
    settings = (book / "_build/html/_static/settings.js").read_text(encoding="utf-8")
    for name in ("toggleHintShow", "togglebuttonSelector"):
        assert name in settings


FAILS = {  # a chapter: its code, and what is said of it
    "divides": ("1 / 0", ": ZeroDivisionError: division by zero"),
    "logs": ("import logging; logging.warning('words')", " wrote to stderr: WARNING:root:words"),
    "prints": ("import sys; print('words', file=sys.stderr)", " wrote to stderr: words"),
    "warns": ("import warnings; warnings.warn('words')", " wrote to stderr: "),
}


def test_every_build_names_the_chapters_that_fail_their_cell_and_a_remedy(book):
    for name, (code, _) in FAILS.items():
        write(book, code, name=name)
    for _ in range(2):
        done = build(book)
        assert done.returncode != 0
        report = (book / "_build/.failed").read_text(encoding="utf-8")
        assert report in done.stdout + done.stderr
        for name, (code, words) in FAILS.items():
            assert f"{name}.ipynb, cell code (`{code}`){words}" in report
        assert "UserWarning: words" in report
        assert "make lab" in report
    assert not (book / "_build/html/book/chapter.html").exists()


def test_pages_that_warn_fail_every_build_until_they_are_mended(book):
    write(book, CODE, "[nowhere](nowhere.md)")
    write(book, CODE, "```{nothing}\n```", name="other")
    for _ in range(2):
        done = build(book)
        assert "finished with problems" in done.stdout
        for name in ("chapter", "other"):
            assert re.search(rf"{name}\.ipynb:\d+: WARNING", done.stdout + done.stderr)
    for name in ("chapter", "other"):
        write(book, CODE, name=name)
    assert "printed 42" in build(book)


CACHE = "_build/.executed/*/"
HARM = {  # of which files, and what becomes of them
    "outputs cut": (CACHE + "executed/*/base.ipynb", lambda old: old[:-100]),
    "outputs empty": (CACHE + "executed/*/base.ipynb", lambda old: b""),
    "list empty": (CACHE + "global.db", lambda old: b""),
    "list foreign": (CACHE + "global.db", lambda old: b"no database, but words" * 300),
    "list cut": (CACHE + "global.db", lambda old: old[:5000]),
    "pages cut": ("_build/.doctrees/environment.pickle", lambda old: old[:-100]),
}


def test_a_damaged_cache_is_made_anew(book):
    (book / "_build/.executed").mkdir(parents=True)
    (book / "_build/.executed/desktop.ini").touch()  # as a synchronised folder leaves it
    build(book)
    for name, (pattern, harm) in HARM.items():
        [file] = book.glob(pattern)
        file.write_bytes(harm(file.read_bytes()))
        assert "printed 42" in build(book), name
    assert times_executed(book) == 6  # for the pages no chapter runs again
