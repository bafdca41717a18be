"""A private exam from the bank's templates: `python -m kit.exam --seed leiden-2027 FOLDER`.

The seed is the secret: who has it draws the same numbers. No question of an exam stands in the
public bank, or in the exams of the seeds that follow `--unlike`.
"""

import argparse
import re
import sys
from base64 import b64encode
from collections import Counter
from contextlib import suppress
from pathlib import Path
from zlib import crc32

import nbformat
import numpy as np

from book._ext.numbering import EQUATION_NUMBER, equations_named
from book.figures.plans import BOOK, NAMES
from kit.bank import templates
from kit.gift import gift
from kit.moodle import moodle_xml
from kit.page import markdown_page, write_assets
from kit.qti import package
from tools import browser

FOLDER = Path("_build/exam")
SET = re.compile(r"(?:\$\$|\\begin{equation\*})(.+?)(?:\$\$|\\end{equation\*})", re.S)
FIELD = "&nbsp;\n\nAnswer: ________________"
HEAD = "Name: ________________________________ Date: ________________\n\n"


def exam(seed, count, numbers=(), unlike=()):
    """The questions of an exam, {(chapter, name): [Question]}, `count` variants of each.

    `numbers` are those of the chapters ("07"), none for all. What has not so many variants that
    are new is left out. Raises ValueError for an empty seed, a seed that is to be unlike itself,
    fewer than one variant, or a chapter that is none.
    """
    if not seed or seed in unlike:
        raise ValueError(f"the seed {seed!r} is empty, or one that it must be unlike: take another")
    if count < 1:
        raise ValueError(f"{count} variants of each question make no exam: ask for 1 or more")
    known = {name[:2] for name in NAMES}
    if strangers := [number for number in numbers if number not in known]:
        raise ValueError(f"no chapter {strangers[0]!r}: give some of {', '.join(sorted(known))}")
    questions = {}
    for chapter in (name for name in NAMES if not numbers or name[:2] in numbers):
        for template in templates(chapter):
            with suppress(ValueError):
                drawn = new_variants(template, seed, count, unlike)
                questions[chapter, template.name] = drawn
    return questions


def new_variants(template, seed, count, unlike=()):
    """So many variants of a template, none public, none of the seeds `unlike`; else ValueError."""
    contents = {question.content for question in template.variants()}
    for other in unlike:  # each was drawn unlike those before it
        contents |= {question.content for question in template.variants(count, other, contents)}
    return template.variants(count, seed, contents)


def shorten(questions, count, seed):
    """So many of an exam's questions, drawn by the seed, as evenly over its chapters as may be.

    ValueError for fewer than one, or more than there are.
    """
    if not 0 < count <= len(questions):
        raise ValueError(f"{count} of {len(questions)} questions: ask for 1 to {len(questions)}")
    taken, turns, names = Counter(), {}, [*questions]
    for k in np.random.default_rng(crc32(seed.encode())).permutation(len(names)):
        chapter, _ = names[k]
        turns[names[k]] = taken[chapter]
        taken[chapter] += 1
    kept = {*sorted(turns, key=turns.get)[:count]}  # a first of each chapter, then a second
    return {name: variants for name, variants in questions.items() if name in kept}


def sheet(questions, key=False):
    """An exam on paper as Markdown: one variant of each question; the `key` has the answers.

    What a question names as "Eq. 5" stands at the end.
    """
    title, first = ("Key of the exam", "") if key else ("Exam", HEAD)
    parts = [f"# {title}\n\n{first}{len(questions)} questions."]
    for number, ((chapter, _), [question, *_]) in enumerate(questions.items(), start=1):
        lines = [f"**{number}.** {_escape(question.prompt)} *(chapter {int(chapter[:2])})*"]
        if question.picture:
            data = b64encode(question.picture.png).decode()
            lines.append(f"![{_escape(question.picture.alt)}](data:image/png;base64,{data})")
        if question.choices:
            lines.append("\n".join(f"- ☐ {_escape(choice)}" for choice in question.choices))
        elif not key:
            lines.append(FIELD)
        if key:
            lines.append(f"**{_answer(question)}.** {_escape(question.hint)}")
        parts.append(_unbroken_block(*lines))
    named = equations_named("\n".join(parts))
    if equations := [text for number, text in numbered_equations().items() if number in named]:
        parts += ["## The equations", *map(_unbroken_block, equations)]
    return "\n\n".join(parts) + "\n"


def _unbroken_block(*parts):
    """Markdown that no end of a page parts."""
    return "\n\n".join(['<div class="whole">', *parts, "</div>"])


def numbered_equations():
    """The equations as the chapters write them, {number: Markdown}, in order."""
    found = {}
    for name in NAMES:
        for cell in nbformat.read(BOOK / f"{name}.ipynb", as_version=4).cells:
            found |= {
                int(EQUATION_NUMBER.search(tex)[1]): f"$$\n{tex.strip()}\n$$"
                for tex in SET.findall(cell.source)
                if "\\tag" in tex
            }
    return dict(sorted(found.items()))


def _answer(question):
    if question.choices:
        return _escape(question.answer)
    near = f" ± {question.decimal(question.tolerance)}" if question.tolerance else ""
    return f"{question.decimal(question.answer)}{near} {question.unit}".strip()


def _escape(text):
    """Plain text as Markdown in which nothing is a mark."""
    return "".join(f"\\{sign}" if sign in r"\`*_{}[]<>$|#" else sign for sign in text)


def write(folder, questions):
    """Write an exam's files into a folder: for platforms, and on paper, with its key.

    ValueError where it is a file, or not empty: it may hold another exam.
    """
    if folder.is_file():
        raise ValueError(f"{folder} is a file: name a folder")
    folder.mkdir(parents=True, exist_ok=True)
    if any(folder.iterdir()):
        raise ValueError(f"the folder {folder} is not empty: name another, or empty it")
    (folder / "questions.gift").write_text(gift(questions), encoding="utf-8")
    (folder / "questions.xml").write_bytes(moodle_xml(questions))
    (folder / "questions-qti.zip").write_bytes(package(questions))
    write_assets(folder)
    for name, key in {"exam": False, "exam-key": True}.items():
        page = markdown_page(name, sheet(questions, key))
        (folder / f"{name}.html").write_text(page, encoding="utf-8")


def print_sheets(folder):
    """Print the exam and its key as PDF, where there is a browser."""
    if not browser.find():
        return print("No browser: exam.html and exam-key.html are not printed as PDF.")
    with browser.launch() as chromium:
        page = chromium.new_page()
        for file in (folder / "exam.html", folder / "exam-key.html"):
            page.goto(file.resolve().as_uri())
            margin = {"top": "15mm", "bottom": "15mm"}
            page.pdf(path=file.with_suffix(".pdf"), format="A4", margin=margin)


def main(arguments=None):
    """Write an exam, or say in a sentence why not."""
    parser = argparse.ArgumentParser("python -m kit.exam", description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?", default=FOLDER, help=f"else {FOLDER}")
    parser.add_argument("--seed", required=True, help="a secret word; the same word, the same exam")
    parser.add_argument("--variants", type=int, default=5, help="of each question")
    parser.add_argument("--only", default="", help="numbers of chapters, such as 7,8")
    parser.add_argument("--questions", type=int, help="so many, of all chapters; else all")
    parser.add_argument(
        "--unlike", nargs="*", default=(), help="seeds of earlier exams, oldest first"
    )
    asked = parser.parse_args(arguments)
    try:
        numbers = [number.zfill(2) for number in re.split(r"[,\s]+", asked.only) if number]
        questions = every = exam(asked.seed, asked.variants, numbers, asked.unlike)
        if asked.questions is not None:
            questions = shorten(every, asked.questions, asked.seed)
        write(asked.folder, questions)
    except ValueError as error:
        sys.exit(str(error))
    print_sheets(asked.folder)
    chapters = {chapter for chapter, _ in every}
    names = {template.name for chapter in chapters for template in templates(chapter)}
    if left_out := names - {name for _, name in every}:
        print(f"Left out, for want of other numbers: {', '.join(sorted(left_out))}")
    print(f"{len(questions)} questions, {asked.variants} variants each: {asked.folder}")


if __name__ == "__main__":
    main()
