"""Marks: which exercises are right in notebooks that were handed in, as a table.

`python -m kit.marks FOLDER > marks.csv` runs each of them, so do it where a stranger's code can do
no harm. A mark says where to look, and is good for a pass, not for a grade: whoever wants to can
fool it, and all solutions are public.
"""

import csv
import re
import sys
from pathlib import Path
from time import monotonic

import nbformat
from nbclient import NotebookClient

from kit.__main__ import CHAPTERS
from kit.key import SOLUTION, exercise_named
from kit.student import checks, place
from vmc_lib.grading import NOT_YET, RIGHT, UNREAD
from vmc_lib.show.figures import inline

LIMIT, LEAST = 600, 10  # s a notebook, and a cell when its time is up
COLUMNS = "file", "exercise", "points", "of", "mark"
POINTS = 2  # an exercise; a known mistake has half of them
RIGHT_MARK, WORDS, KNOWN = "right", "in words: for you to read", "a known mistake: "


def marks(chapter, submission, folder, limit=LIMIT):
    """The mark of each exercise of a chapter's notebook, {label: text}, in a hand-in.

    Runs the hand-in in `folder`, for so many seconds, with our own checks in the places of the
    student's, which are known by the exercise in their metadata or, where an editor dropped that,
    by their source. Answers in words are left to the lecturer.
    """
    sources = checks(chapter)
    code = [cell for cell in submission.cells if cell.cell_type == "code"]
    labels = [_label(cell, sources) for cell in code]
    cells = [
        nbformat.v4.new_code_cell(sources.get(label) or cell.source)
        for cell, label in zip(code, labels, strict=True)
    ]
    notebook = nbformat.v4.new_notebook(cells=cells)  # with our kernel, whatever the student's was
    _run(notebook, folder, limit)
    results = {label: "no cell checks it" if source else WORDS for label, source in sources.items()}
    known = _known_mistakes(chapter)
    for label, cell in zip(labels, cells, strict=True):
        if label and results[label] != RIGHT_MARK:  # of two copies, one that is right will do
            results[label] = _mark(cell.outputs, known.get(label, ()))
    return results


def _run(notebook, folder, limit):
    """Run all cells within the limit, but for the few seconds that each may have after it."""
    end = monotonic() + limit
    NotebookClient(
        notebook,
        timeout_func=lambda _cell: max(LEAST, round(end - monotonic())),
        interrupt_on_timeout=True,
        allow_errors=True,
        resources={"metadata": {"path": str(folder)}},
    ).execute()


def _known_mistakes(chapter):
    """What the graded exercises say to known mistakes, {label: hints}."""
    found, label = {}, None
    for cell in chapter.cells:
        label = cell.metadata.get("exercise", label)
        if graded := SOLUTION.fullmatch(cell.source):
            found[label] = [*exercise_named(chapter, graded[1]).mistakes]
    return found


def _label(cell, sources):
    """The exercise that a code cell of a hand-in has the place of, or None."""
    label, source = cell.metadata.get("exercise"), cell.source.strip()
    own = {place(label): label for label, check in sources.items() if check}
    return label if sources.get(label) else own.get(source)


def _mark(outputs, known):
    """The mark that a check's outputs give."""
    text = "".join(output.get("data", {}).get("text/html", "") for output in outputs)
    errors = [f"{output.ename}: {output.evalue}" for output in outputs if "ename" in output]
    if RIGHT in text:
        return RIGHT_MARK
    hints = [f"{KNOWN}{hint}" for hint in known if inline(hint) in text]
    unmarked = {NOT_YET: "not answered", UNREAD: "not read"}
    states = [state for words, state in unmarked.items() if words in text]
    return " ".join(errors or hints[:1] or states) or "not right"


def points(mark):
    """The points that a mark is worth; none of ours for an answer in words."""
    if mark == WORDS:
        return ""
    return POINTS * (mark == RIGHT_MARK) + POINTS / 2 * mark.startswith(KNOWN)


def chapter_of(submission, name):
    """The notebook of the chapter that was handed in, known by its first heading or its number.

    `name` is the file's. ValueError where neither tells it.
    """
    text = "\n".join(cell.source for cell in submission.cells if cell.cell_type == "markdown")
    heading, number = re.search(r"^# .*", text, re.M), re.match(r"\d+", name)
    by_title, by_number = {}, {}
    for path in CHAPTERS:
        chapter = nbformat.read(path, as_version=4)
        by_title[chapter.cells[0].source.splitlines()[0]] = chapter
        by_number[int(path.name.split("_")[0])] = chapter
    if heading and heading[0].strip() in by_title:
        return by_title[heading[0].strip()]
    if number and int(number[0]) in by_number:
        return by_number[int(number[0])]
    raise ValueError("no chapter has its first heading, or the number that its name begins with")


def rows(path):
    """A hand-in's rows: one an exercise and one for its sum, or one that says why it has none."""
    try:
        text = path.read_text(encoding="utf-8-sig")  # PowerShell begins a text with a mark
        submission = nbformat.reads(text, as_version=4)
        results = marks(chapter_of(submission, path.name), submission, path.parent)
    except Exception as error:  # whatever is wrong with one file, the others are marked
        reason, *_ = str(error).split("\n")
        yield path, "", "", "", f"cannot be marked ({type(error).__name__}: {reason})"
        return
    for label, mark in results.items():
        yield path, label, points(mark), POINTS, mark
    earned = [points(mark) for mark in results.values() if mark != WORDS]
    yield path, "all that is checked", sum(earned), POINTS * len(earned), ""


def main():
    """Write the table of the notebooks in a folder, CSV."""
    found = sorted(path for folder in sys.argv[1:] for path in Path(folder).rglob("*.ipynb"))
    handed_in = [path for path in found if ".ipynb_checkpoints" not in path.parts]
    if not handed_in:
        sys.exit(f"no notebooks under {sys.argv[1:]}: use python -m kit.marks FOLDER > marks.csv")
    table = csv.writer(sys.stdout)
    table.writerow(COLUMNS)
    for path in handed_in:
        table.writerows(rows(path))
        sys.stdout.flush()


if __name__ == "__main__":
    main()
