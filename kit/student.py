"""A chapter as students get it: no solution and no check in it, one graded cell an exercise."""

import re

import nbformat

POINTS = 2  # an exercise
GRADED_BELOW = "Then run the folded bar below it: it grades what you wrote."
CHECKED_LATER = (
    "Leave the cell below it as it is: it shows nothing, and your teacher's program checks your "
    "work there."
)
LINK = re.compile(r"(?<!!)\[([^\]]+)\]\((?!\w+:)([^)#\s]+)(#[^)\s]*)?\)")


def solves(cell):
    """Whether a cell belongs to a solution."""
    return "solution" in cell.metadata.get("tags", ())


def checks(notebook):
    """The source of the cell that checks each exercise, {label: source}, None for words."""
    found, label = {}, None
    for cell in notebook.cells:
        label = cell.metadata.get("exercise", label)
        if "exercise" in cell.metadata:
            found[label] = None
        elif label and cell.cell_type == "code" and not solves(cell):
            if re.search(r"\b(check|grade)\(", cell.source):
                found[label], label = cell.source, None
    return found


def place(label):
    """The source of the cell where an exercise will be checked."""
    return f"# Exercise {label} is checked here. Leave this cell as it is."


def student(notebook, files=None):
    """The chapter without solutions, checks and outputs; what is graded carries the tag "graded".

    Of an exercise that is checked, that is the cell where it will be; of another, a cell for words.
    Its metadata say of which `exercise`, by label, and how nbgrader grades it. Links to files that
    are not in `files` are text.
    """
    sources, cells, label, graded = checks(notebook), [], None, False
    for cell in notebook.cells:
        if solves(cell):
            if label and not sources[label]:
                cells.append(_mark_graded(_words(label), label))
            label, graded = None, False
            continue
        graded = graded and "exercise" not in cell.metadata
        if graded and cell.cell_type == "code":
            continue  # between a check and its solution: it shows the answer
        label = cell.metadata.get("exercise", label)
        if cell.cell_type == "code":
            cell = nbformat.from_dict(cell | {"outputs": [], "execution_count": None})
            if label and cell.source == sources[label]:
                cell = _mark_graded(nbformat.from_dict(cell | {"source": place(label)}), label)
                cell.metadata.jupyter = {}  # shown
                label, graded = None, True
        else:
            text = keep_links(cell.source, files).replace(GRADED_BELOW, CHECKED_LATER)
            cell = nbformat.from_dict(cell | {"source": text})
        cells.append(cell)
    return nbformat.from_dict(notebook | {"cells": cells})


def keep_links(text, files=None):
    """Markdown whose links lead to `files` (names), or to all if None; other links become text."""
    return LINK.sub(lambda m: m[0] if files is None or m[2] in files else m[1], text)


def _words(label):
    return nbformat.v4.new_markdown_cell("*Your answer, in words:*", id=f"{label}-words")


def _mark_graded(cell, label):
    cell.metadata.tags = [*cell.metadata.get("tags", []), "graded"]
    cell.metadata.exercise = label
    in_words = cell.cell_type == "markdown"
    cell.metadata.nbgrader = {
        "schema_version": 3,
        "grade_id": label,
        "grade": True,
        "points": POINTS,
        "solution": in_words,
        "locked": not in_words,
        "task": False,
        "cell_type": cell.cell_type,
    }
    return cell
