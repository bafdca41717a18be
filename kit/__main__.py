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
from kit.gift import gift
from kit.key import key
from kit.moodle import moodle_xml
from kit.page import markdown_page, write_assets
from kit.plan import plans
from kit.qti import package
from kit.slides import build as slides
from kit.student import alive, student

ROOT = Path(__file__).parents[1]
NOT_GRADED = """// Predictions: nobody should be graded for them. Set the quiz's maximum grade to 0.

"""
CHAPTERS = [BOOK / f"{name}.ipynb" for name in NAMES]


def build(folder, pages, web=""):
    """Write the kit into `folder`; `pages` is the folder of the built chapters, as HTML.

    `web` is the address at which the kit will lie, if it will.
    """
    shutil.rmtree(folder, ignore_errors=True)
    students = folder / "students"
    students.mkdir(parents=True)
    pages_of_words = [*(ROOT / "book").glob("*.md")]
    files = {path.name for path in (*pages_of_words, *CHAPTERS)} | {"references.bib"}
    for page in pages_of_words:
        text = alive(page.read_text(encoding="utf-8"), files)
        (students / page.name).write_text(text, encoding="utf-8")
    shutil.copy(ROOT / "book/references.bib", students)
    keys, questions = [], {}
    for chapter in CHAPTERS:
        notebook = nbformat.read(chapter, as_version=4)
        nbformat.write(student(notebook, files), students / chapter.name)
        assignment = folder / "nbgrader/source" / chapter.stem
        assignment.mkdir(parents=True)
        nbformat.write(nbgrader.source(notebook, files), assignment / chapter.name)
        page = (pages / f"{chapter.stem}.html").read_text(encoding="utf-8")
        keys.append(alive(key(notebook, page), ()))
        _, moving = demos.read(page)
        asked = bank_questions(notebook, chapter.stem, moving, web)
        questions |= {(chapter.stem, name): several for name, several in asked.items()}
    texts = {"key": "\n".join(keys), "plan": plans(), "index": index()}
    for name in ("projects", "assistants"):
        texts[name] = (ROOT / f"kit/{name}.md").read_text(encoding="utf-8")
    for name, text in texts.items():
        (folder / f"{name}.html").write_text(markdown_page(name, text), encoding="utf-8")
    for name in ("key", "plan"):
        (folder / f"{name}.md").write_text(texts[name], encoding="utf-8")
    write_assets(folder)
    shutil.copy(ROOT / "kit/report.ipynb", folder)
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
    slides(folder / "slides", pages)
    demos.build(folder / "demos", pages)
    figures.build(folder / "figures", pages)
    arm.build(folder / "arm-in-page")
    (folder / "throws.html").write_text(throws_page(), encoding="utf-8")
    (folder / "concepts.html").write_text(concepts.page(), encoding="utf-8")
    (folder / "class.html").write_text(class_page(), encoding="utf-8")


def index():
    """The kit's first page, Markdown: what is in it, as the page on teaching says, with links."""
    cells = nbformat.read(ROOT / "book/teaching.ipynb", as_version=4).cells
    text = next(cell.source for cell in cells if "`make kit` writes" in cell.source)
    listed = re.search(r"`make kit` writes.+\n\n((?:- .+\n(?:  .+\n)*)+)", text)[1]
    return "# The kit\n\n" + re.sub(r"`([\w/.-]+\.(html|ipynb))`", r"[\1](\1)", listed)


if __name__ == "__main__":
    parser = argparse.ArgumentParser("python -m kit", description=__doc__)
    parser.add_argument("--web", default="", help="the address at which the kit will lie")
    build(ROOT / "_build/kit", ROOT / "_build/html/book", parser.parse_args().web)
    figures.print_pngs(ROOT / "_build/kit/figures")
    print(f"The kit is in {ROOT / '_build/kit'}")
