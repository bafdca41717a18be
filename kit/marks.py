"""Marks: which exercises are right in notebooks that were handed in, one line a file.

`python -m kit.marks FOLDER` runs each of them, so do it where a stranger's code can do no harm.
Whoever wants to can fool it: a mark says where to look, and the lecturer looks.
"""

import re
import sys
from pathlib import Path

import nbformat
from jupyter_cache.executors.utils import single_nb_execution

from kit.__main__ import CHAPTERS
from kit.student import student
from vmc_lib.grading import NOT_YET, RIGHT, UNREAD

TIMEOUT = 600  # s a cell


def marks(chapter, submission, folder, timeout=TIMEOUT):
    """The mark of each checked exercise of a chapter's notebook, {label: text}, in a hand-in.

    Runs the hand-in in `folder`, with our own checks in place of the student's, which are known by
    the exercise in their metadata or, where an editor dropped that, by their source. Answers in
    words are left to the lecturer.
    """
    checks = {
        cell.metadata.exercise: cell.source
        for cell in student(chapter).cells
        if cell.cell_type == "code" and "exercise" in cell.metadata
    }
    code = [cell for cell in submission.cells if cell.cell_type == "code"]
    labels = [_label(cell, checks) for cell in code]
    cells = [
        nbformat.v4.new_code_cell(checks.get(label, cell.source))
        for cell, label in zip(code, labels, strict=True)
    ]
    notebook = nbformat.v4.new_notebook(cells=cells)  # with our kernel, whatever the student's was
    single_nb_execution(notebook, folder, timeout, allow_errors=True, interrupt_on_timeout=True)
    results = dict.fromkeys(checks, "no cell checks it")
    for label, cell in zip(labels, cells, strict=True):
        if label and results[label] != "right":  # of two copies, one that is right will do
            results[label] = _mark(cell.outputs)
    return results


def _label(cell, checks):
    """The exercise that a code cell of a hand-in checks, or None."""
    label = cell.metadata.get("exercise")
    sources = {source.strip(): label for label, source in checks.items()}
    return label if label in checks else sources.get(cell.source.strip())


def _mark(outputs):
    """The mark that a check's outputs give."""
    text = "".join(output.get("data", {}).get("text/html", "") for output in outputs)
    errors = [f"{output.ename}: {output.evalue}" for output in outputs if "ename" in output]
    if RIGHT in text:
        return "right"
    unmarked = {NOT_YET: "not answered", UNREAD: "not read"}
    states = [state for words, state in unmarked.items() if words in text]
    return " ".join(errors or states) or "not right"


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


def line(path):
    """A hand-in's line: its file, and its marks or why it has none."""
    try:
        text = path.read_text(encoding="utf-8-sig")  # PowerShell begins a text with a mark
        submission = nbformat.reads(text, as_version=4)
        results = marks(chapter_of(submission, path.name), submission, path.parent)
    except Exception as error:  # whatever is wrong with one file, the others are marked
        reason, *_ = str(error).split("\n")
        return f"{path}: cannot be marked ({type(error).__name__}: {reason})"
    return f"{path}: " + "; ".join(f"{label}: {mark}" for label, mark in results.items())


def main():
    """Print the line of each notebook in a folder."""
    for path in sorted(Path(sys.argv[1]).rglob("*.ipynb")):
        if ".ipynb_checkpoints" not in path.parts:
            print(line(path), flush=True)


if __name__ == "__main__":
    main()
