"""Builds the kit into _build/kit: `make kit`."""

import argparse
import re
import shutil
from pathlib import Path

import nbformat

from book.figures.plans import BOOK, NAMES
from kit import arm, concepts, demos, figures, nbgrader
from kit.bank import bank
from kit.chapter_questions import bank_questions
from kit.class_pages import class_page, throws_page
from kit.exam import numbered_equations
from kit.gift import gift
from kit.key import key
from kit.moodle import moodle_xml
from kit.page import markdown_page, write_assets
from kit.plan import plans
from kit.qti import package
from kit.slides import build as slides
from kit.student import keep_links, student

ROOT = Path(__file__).parents[1]
NOT_GRADED = """// Predictions: nobody should be graded for them. Set the quiz's maximum grade to 0.

"""
CHAPTERS = [BOOK / f"{name}.ipynb" for name in NAMES]


def build(folder, pages, web=""):
    """Write the kit into `folder`; `pages` is the folder of the built chapters, as HTML.

    `web` is the address at which the kit will lie, if it will.
    """
    if missing := [path for path in CHAPTERS if not (pages / f"{path.stem}.html").is_file()]:
        raise SystemExit(
            f"no page of {missing[0].stem} in {pages}: build the book first: make book"
        )
    shutil.rmtree(folder, ignore_errors=True)
    try:
        folder.mkdir(parents=True)
    except OSError as error:
        raise SystemExit(f"the kit cannot be written: {error}") from error
    write_notebooks(folder)
    write_texts(folder, pages)
    write_questions(folder, pages, web)
    slides(folder / "slides", pages)
    demos.build(folder / "demos", pages)
    figures.build(folder / "figures", pages)
    arm.build(folder / "arm-in-page")
    shutil.copy(ROOT / "kit/report.ipynb", folder)
    in_class = {"throws": throws_page(), "class": class_page(), "concepts": concepts.page()}
    for name, page in in_class.items():
        (folder / f"{name}.html").write_text(page, encoding="utf-8")


def write_notebooks(folder):
    """Write the chapters as students and nbgrader get them, with the pages to which they link."""
    pages = [*(ROOT / "book").glob("*.md")]
    files = {path.name for path in (*pages, *CHAPTERS)} | {"references.bib"}
    students = folder / "students"
    students.mkdir()
    for page in pages:
        text = keep_links(page.read_text(encoding="utf-8"), files)
        (students / page.name).write_text(text, encoding="utf-8")
    shutil.copy(ROOT / "book/references.bib", students)
    for chapter in CHAPTERS:
        notebook = nbformat.read(chapter, as_version=4)
        nbformat.write(student(notebook, files), students / chapter.name)
        assignment = folder / "nbgrader/source" / chapter.stem
        assignment.mkdir(parents=True)
        nbformat.write(nbgrader.source(notebook, files), assignment / chapter.name)


def write_texts(folder, pages):
    """Write what a teacher reads, as pages: the first page, the key, the plans, three handouts."""
    keys = [keep_links(key(notebook, page), ()) for _, notebook, page in chapters(pages)]
    texts = {"key": "\n".join(keys), "plan": plans(), "index": index()}
    texts["equations"] = "\n\n".join(["# The equations", *numbered_equations().values()])
    for name in ("projects", "assistants"):
        texts[name] = (ROOT / f"kit/{name}.md").read_text(encoding="utf-8")
    for name, text in texts.items():
        (folder / f"{name}.html").write_text(markdown_page(name, text), encoding="utf-8")
    for name in ("key", "plan"):
        (folder / f"{name}.md").write_text(texts[name], encoding="utf-8")
    write_assets(folder)


def write_questions(folder, pages, web):
    """Write the bank and the quizzes for platforms, and apart from them the predictions."""
    questions = {}
    for chapter, notebook, page in chapters(pages):
        _, moving = demos.read(page)
        asked = bank_questions(notebook, chapter, moving, web)
        questions |= {(chapter, name): several for name, several in asked.items()}
    questions |= bank()
    predictions = {name: q for name, q in questions.items() if q[0].level == "predict"}
    graded = {name: q for name, q in questions.items() if name not in predictions}
    for name, part, kind, note in (
        ("questions", graded, "assignment", ""),
        ("predictions", predictions, "survey", NOT_GRADED),
    ):
        (folder / f"{name}.gift").write_text(note + gift(part), encoding="utf-8")
        (folder / f"{name}.xml").write_bytes(moodle_xml(part))
        (folder / f"{name}-qti.zip").write_bytes(package(part, kind))


def chapters(pages):
    """Each chapter's name, its notebook, and its page in the folder `pages`, HTML."""
    for path in CHAPTERS:
        page = (pages / f"{path.stem}.html").read_text(encoding="utf-8")
        yield path.stem, nbformat.read(path, as_version=4), page


def index():
    """The kit's first page, Markdown: what is in it, as the page on teaching says, with links."""
    cells = nbformat.read(ROOT / "book/teaching.ipynb", as_version=4).cells
    text = next(cell.source for cell in cells if "`make kit` writes" in cell.source)
    listed = re.search(r"`make kit` writes.+\n\n((?:- .+\n(?:  .+\n)*)+)", text)[1]
    listed = re.sub(r"`(.+)1\.html` to `\1(\d)\.html`", _deck_names, listed)
    return "# The kit\n\n" + re.sub(r"`([\w/.-]+(?:\.html|\.ipynb|/))`", r"[\1](\1)", listed)


def _deck_names(found):
    """The names of all decks, in place of the first and the last."""
    return ", ".join(f"`{found[1]}{number}.html`" for number in range(1, int(found[2]) + 1))


if __name__ == "__main__":
    parser = argparse.ArgumentParser("python -m kit", description=__doc__)
    parser.add_argument("--web", default="", help="the address at which the kit will lie")
    build(ROOT / "_build/kit", ROOT / "_build/html/book", parser.parse_args().web)
    figures.print_pngs(ROOT / "_build/kit/figures")
    print(f"The kit is in {ROOT / '_build/kit'}")
