"""A private exam from the bank's templates: `python -m kit.exam --seed leiden-2027 FOLDER`.

The seed is the secret: who has it draws the same numbers. No question of an exam stands in the
public bank, or in the exams of the seeds that follow `--unlike`.
"""

import argparse
import re
import sys
from base64 import b64encode
from contextlib import suppress
from pathlib import Path

import nbformat

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
FIELD = "\n\n&nbsp;\n\nAnswer: ________________"


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


def sheet(questions, key=False):
    """An exam on paper as Markdown: one variant of each question; the `key` has the answers.

    What a question names as "Eq. 5" stands at the end.
    """
    parts = [f"# {'Key of the exam' if key else 'Exam'}\n\n{len(questions)} questions."]
    for number, ((chapter, _), [question, *_]) in enumerate(questions.items(), start=1):
        text = f"**{number}.** {_plain(question.prompt)} *(chapter {int(chapter[:2])})*"
        choices = "\n".join(f"- ☐ {_plain(choice)}" for choice in question.choices)
        if question.picture:
            data = b64encode(question.picture.png).decode()
            text += f"\n\n![{_plain(question.picture.alt)}](data:image/png;base64,{data})"
        parts.append(f"{text}\n\n{choices}" if choices else text + ("" if key else FIELD))
        if key:
            parts.append(f"**{_answer(question)}.** {_plain(question.hint)}")
    if equations := _equations("\n".join(parts)):
        parts += ["## The equations", *equations]
    return "\n\n".join(parts) + "\n"


def _equations(text):
    """The equations that a text names, as the chapters write them: Markdown, in order."""
    found = {}
    for name in NAMES:
        for cell in nbformat.read(BOOK / f"{name}.ipynb", as_version=4).cells:
            found |= {
                int(EQUATION_NUMBER.search(tex)[1]): tex
                for tex in SET.findall(cell.source)
                if "\\tag" in tex
            }
    return [f"$$\n{found[n].strip()}\n$$" for n in sorted(equations_named(text) & found.keys())]


def _answer(question):
    if question.choices:
        return _plain(question.answer)
    near = f" ± {question.decimal(question.tolerance)}" if question.tolerance else ""
    return f"{question.decimal(question.answer)}{near} {question.unit}".strip()


def _plain(text):
    """Plain text as Markdown in which nothing is a mark."""
    return "".join(f"\\{sign}" if sign in r"\`*_{}[]<>$|#" else sign for sign in text)


def write(folder, questions):
    """Write an exam's files into a folder: for platforms, and on paper, with its key.

    ValueError where it is not empty: it may hold another exam.
    """
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
            page.pdf(path=file.with_suffix(".pdf"), format="A4", margin={"top": "15mm"})


def main(arguments=None):
    """Write an exam, or say in a sentence why not."""
    parser = argparse.ArgumentParser("python -m kit.exam", description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?", default=FOLDER, help=f"else {FOLDER}")
    parser.add_argument("--seed", required=True, help="a secret word; the same word, the same exam")
    parser.add_argument("--variants", type=int, default=5, help="of each question")
    parser.add_argument("--only", default="", help="numbers of chapters, such as 07,08")
    parser.add_argument(
        "--unlike", nargs="*", default=(), help="seeds of earlier exams, oldest first"
    )
    asked = parser.parse_args(arguments)
    try:
        numbers = [number for number in asked.only.split(",") if number]
        questions = exam(asked.seed, asked.variants, numbers, asked.unlike)
        write(asked.folder, questions)
    except ValueError as error:
        sys.exit(str(error))
    print_sheets(asked.folder)
    chapters = {chapter for chapter, _ in questions}
    names = {template.name for chapter in chapters for template in templates(chapter)}
    if left_out := names - {name for _, name in questions}:
        print(f"Left out, for want of other numbers: {', '.join(sorted(left_out))}")
    print(f"{len(questions)} questions, {asked.variants} variants each: {asked.folder}")


if __name__ == "__main__":
    main()
