"""Builds the kit into _build/kit: `make kit`."""

import shutil
from html import escape
from pathlib import Path

import nbformat
from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin

from kit.bank import templates
from kit.gift import gift
from kit.key import key
from kit.qti import package
from kit.slides import build as slides
from kit.student import student

ROOT = Path(__file__).parents[1]
CHAPTERS = sorted((ROOT / "book").glob("[0-9]*.ipynb"))
HEAD = """<!doctype html><html lang="en"><meta charset="utf-8"><title>The key</title>
<meta name="viewport" content="width=device-width">
<style>:root { color-scheme: light dark; }
body { max-width: 45rem; margin: 2rem auto; padding: 0 1rem; font-family: sans-serif;
line-height: 1.5; } pre { overflow: auto; }</style>
<link rel="stylesheet" href="katex.css"><script defer src="katex.js"></script>
<script defer src="book.js"></script>
"""


def bank():
    """The variants of every question, {(chapter, name): [Question]}, in the book's order."""
    return {
        (chapter.stem, template.name): template.variants()
        for chapter in CHAPTERS
        for template in templates(chapter.stem)
    }


def build(folder, pages):
    """Write the kit into `folder`; `pages` is the folder of the built chapters, as HTML."""
    shutil.rmtree(folder, ignore_errors=True)
    students = folder / "students"
    students.mkdir(parents=True)
    for page in (*(ROOT / "book").glob("*.md"), ROOT / "book/references.bib"):
        shutil.copy(page, students)
    keys = []
    for chapter in CHAPTERS:
        notebook = nbformat.read(chapter, as_version=4)
        nbformat.write(student(notebook), students / chapter.name)
        keys.append(key(notebook, (pages / f"{chapter.stem}.html").read_text(encoding="utf-8")))
    (folder / "key.md").write_text("\n".join(keys), encoding="utf-8")
    (folder / "key.html").write_text(HEAD + _page("\n".join(keys)), encoding="utf-8")
    for name in ("vendor/katex.js", "vendor/katex.css", "book.js"):
        shutil.copy(ROOT / "book/_static" / name, folder)
    shutil.copy(ROOT / "kit/projects.md", folder)
    questions = bank()
    (folder / "questions.gift").write_text(gift(questions), encoding="utf-8")
    (folder / "questions-qti.zip").write_bytes(package(questions))
    slides(folder / "slides", pages)


def _page(text):
    """Markdown as HTML, its maths as KaTeX reads it."""

    def maths(tex, options):
        left, right = ("[", "]") if options["display_mode"] else ("(", ")")
        return f"\\{left}{escape(tex)}\\{right}"

    return MarkdownIt().use(dollarmath_plugin, renderer=maths).render(text)


if __name__ == "__main__":
    build(ROOT / "_build/kit", ROOT / "_build/html/book")
    print(f"The kit is in {ROOT / '_build/kit'}")
