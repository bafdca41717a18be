"""A tiny book, built: chapters run only when they change, and open elsewhere by buttons."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest

from book._ext import execute
from book._ext.offline import SCRIPTS
from book._ext.packed import strip_comments
from page.eye import brain
from page.python import pack
from tests import pages
from tools import prose

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
CODE = "open('count', 'a').write('x')\nimport library\nprint('printed', 6 * library.SEVEN)"


@pytest.fixture
def book(tmp_path):
    """A book of one chapter, which counts its executions and imports a library of one line."""
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
    (tmp_path / "library.py").write_text("SEVEN = 7\n", encoding="utf-8")
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
    environment["PYTHONPATH"] = os.pathsep.join([str(ROOT), str(book)])
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


@pytest.mark.audit
def test_a_chapter_is_executed_when_what_it_imports_has_changed(book):
    write(book, CODE, "$$1 + 1$$\n\n:::{note}\n:class: dropdown\nWords.\n:::")
    page = build(book)
    assert "printed 42" in page
    for packed in (pack, brain):  # the page's Python, and what its eye has learnt
        assert (book / "_build/html/_static" / packed.SCRIPT).stat().st_size > 1e6
    scripts = re.findall(r'<script [^>]*src="../_static/(\w+\.js)\?v=\w+"', page)
    assert [name for name in scripts if name in SCRIPTS] == ["words.js"]
    assert (book / "_build/html/.nojekyll").exists()  # or GitHub's pages leave _static out
    # It can be saved, and without a repository nothing leads out
    assert "../_sources/book/chapter.ipynb" in links(page)
    assert not [link for link in links(page) if link.startswith("http")]
    # No settings are scripts inside a page
    inside = re.findall(r"<script[^>]*>([^<]+)</script>", page)
    assert inside
    assert all(re.search(r"DOCUMENTATION_OPTIONS|dataset\.mode", code) for code in inside)
    settings = (book / "_build/html/_static/settings.js").read_text(encoding="utf-8")
    for name in ("toggleHintShow", "togglebuttonSelector"):
        assert name in settings
    assert "http" not in settings

    for room in ("kit", "vmc_lib"):
        (book / room).mkdir()
    for other in ("vmc_lib/other.py", "kit/other.py"):  # which it does not import
        (book / other).write_text("line = 1\n", encoding="utf-8")
    environment = book / "_build/.doctrees/environment.pickle"
    environment.write_bytes(environment.read_bytes()[:-100])  # cut: pages are read again
    assert "printed 42" in build(book)
    assert times_executed(book) == 1

    (book / "library.py").write_text("SEVEN = 6\n", encoding="utf-8")
    repository = {"GITHUB_SERVER_URL": "https://github.com", "GITHUB_REPOSITORY": "owner/name"}
    page = build(book, **repository)
    assert "printed 36" in page
    assert times_executed(book) == 2
    assert [link for link in links(page) if link.startswith("http")] == [
        "https://mybinder.org/v2/gh/owner/name/main?urlpath=lab/tree/book/chapter.ipynb",
        "https://colab.research.google.com/github/owner/name/blob/colab/book/chapter.ipynb",
    ]


FAILS = {  # a chapter: its code, and what is said of it
    "divides": ("1 / 0", ": ZeroDivisionError: division by zero"),
    "logs": ("import logging; logging.warning('words')", " wrote to stderr: WARNING:root:words"),
    "prints": ("import sys; print('words', file=sys.stderr)", " wrote to stderr: words"),
    "warns": ("import warnings; warnings.warn('words')", " wrote to stderr: "),
}


def test_a_build_names_the_chapters_that_fail_their_cell_and_a_remedy(book):
    for name, (code, _) in FAILS.items():
        write(book, code, name=name)
    done = build(book)
    assert done.returncode != 0
    report = (book / "_build/.failed").read_text(encoding="utf-8")
    assert report in done.stdout + done.stderr
    for name, (code, words) in FAILS.items():
        assert f"{name}.ipynb, cell code (`{code}`){words}" in report
    assert "UserWarning: words" in report
    assert "make lab" in report
    assert not (book / "_build/html/book/chapter.html").exists()


@pytest.mark.audit
def test_pages_that_warn_fail_every_build_until_they_are_mended(book):
    for packed in (brain.SCRIPT, pack.SCRIPT, pack.PLOTS):  # newer than what they are made of
        script = book / "_build/html/_static" / packed
        script.parent.mkdir(parents=True, exist_ok=True)
        script.touch()
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


# ---- Execution, which the build and nbmake share ----


@pytest.fixture
def chapter(book, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(ROOT), str(book)]))
    return book / "book/chapter.ipynb"


def outputs(notebook):
    return [output.text for cell in notebook.cells for output in cell.get("outputs", ())]


def test_whoever_comes_second_reads_and_a_failure_is_executed_again(book, chapter):
    for _ in range(2):
        notebook, _, error = execute.execute_cached(chapter, 600)
        assert (outputs(notebook), error) == (["printed 42\n"], None)
    assert times_executed(book) == 1
    write(book, f"{CODE}  # another word\n1 / 0")
    for times in (2, 3):
        assert "ZeroDivisionError" in execute.execute_cached(chapter, 600)[2]
        assert times_executed(book) == times


def test_a_number_in_prose_is_the_runs(book, chapter):
    def has(number):
        notebook = nbformat.read(chapter, as_version=4)
        text = f"It is {number}<!--{{6 * library.SEVEN}}-->."
        notebook.cells[2:] = [nbformat.v4.new_markdown_cell(text, id="prose")]
        nbformat.write(notebook, chapter)
        return execute.execute_cached(chapter, 600)[2]

    assert has(42) is None
    said = has(41)
    assert said.startswith("cell prose (`# It is 41<!--")
    assert said.endswith("ValueError: the text says '41', the run '42'")
    prose.update(chapter)
    assert nbformat.read(chapter, as_version=4).cells[2].source.startswith("It is 42<")
    assert execute.execute_cached(chapter, 600)[2] is None


WRONG = {  # cells of which a chapter alone fails, and what it says
    "check": ("from vmc_lib.show import check\ncheck(1, 2)", "check: 1 is not 2"),
    "grade": (
        "from book.exercises.loop import MIXED\n"
        "from vmc_lib.show import grade\ngrade(lambda *_: 0.123, MIXED)",
        "grade: ",
    ),
    "a demo that a later cell changes": (
        "from vmc_lib.show import explore\nby = 1\n"
        "explore(lambda x: f'<p>{by * x}</p>', alt='words', x=[*'ab'])\nby = 2",
        "these demos show something else now: ['demo-code']",
    ),
}


def test_a_chapter_tested_alone_fails_where_it_is_wrong(book):
    """`pytest --nbmake book/NAME.ipynb`, with no other argument, as anybody types it."""
    shutil.copy(ROOT / "conftest.py", book)
    (book / "pytest.ini").touch()
    (book / "book/chapter.ipynb").unlink()
    for name, (code, _) in WRONG.items():
        write(book, code, name=name)
    command = [sys.executable, "-m", "pytest", "--nbmake", "book", "-p", "no:cacheprovider"]
    environment = os.environ | {"PYTHONPATH": str(ROOT), "VMC_RENDER_MODE": ""}
    done = subprocess.run(
        command, cwd=book, env=environment, capture_output=True, encoding="utf-8", check=False
    )
    assert f"{len(WRONG)} failed" in done.stdout
    for _, words in WRONG.values():
        assert words in done.stdout


def test_a_kernel_whose_port_was_taken_is_started_once_more(monkeypatch):
    starts = []

    def start(name):
        starts.append(name)
        if len(starts) < 2 or name == "dead":
            raise RuntimeError("Kernel died before replying to kernel_info")
        return "ran"

    monkeypatch.setattr(execute, "single_nb_execution", start)
    assert execute.run("chapter") == "ran"
    with pytest.raises(RuntimeError, match="Kernel died"):
        execute.run("dead")
    assert starts == ["chapter", "chapter", "dead", "dead"]


HARM = {  # of which files of the cache, and what becomes of them
    "outputs cut": ("executed/*/base.ipynb", lambda old: old[:-100]),
    "outputs empty": ("executed/*/base.ipynb", lambda old: b""),
    "list empty": ("global.db", lambda old: b""),
    "list foreign": ("global.db", lambda old: b"no database, but words" * 300),
    "list cut": ("global.db", lambda old: old[:5000]),
}


def test_a_damaged_cache_is_made_anew(book, chapter):
    folder, notebook = execute.cache_folder(book), nbformat.read(chapter, 4)
    folder.mkdir(parents=True)
    (folder / "desktop.ini").touch()  # as a synchronised folder leaves it

    def is_stored():
        return execute.read_stored(execute.open_cache(folder), chapter, "state")

    assert not is_stored()
    for name, (pattern, harm) in HARM.items():
        execute.store(execute.open_cache(folder), chapter, notebook, {"digest": "state"})
        assert is_stored(), name
        [file] = folder.glob(pattern)
        file.write_bytes(harm(file.read_bytes()))
        assert not is_stored(), name
