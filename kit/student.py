"""A chapter as students get it: no solution in it, and one graded cell an exercise."""

import re

import nbformat

SOLUTION = re.compile(r"^`{3,}\{solution-(start|end)\}[^`]*`{3,}\n?", re.M)
EXERCISE = re.compile(r"^[:`]{3,}\{exercise(?:-start)?\}.*\n:label: (\S+)", re.M)


def pieces(notebook):
    """The cells of a chapter in order, as (cell, whether it belongs to a solution).

    A Markdown cell that holds parts of both is several. ValueError for a solution that has no end.
    """
    solving = False
    for cell in notebook.cells:
        if cell.cell_type == "code":
            yield cell, solving
            continue
        for text in SOLUTION.split(cell.source):
            if text in ("start", "end"):
                solving = text == "start"
            elif text.strip():
                yield nbformat.from_dict(cell | {"source": text.strip()}), solving
    if solving:
        raise ValueError("a solution never ends; close it with {solution-end}")


def student(notebook):
    """The chapter without solutions and outputs; what is graded carries the tag "graded".

    Of an exercise that is checked, that is the cell of its `check` or `grade`; of another, a cell
    for words. Its metadata say of which `exercise`, by label.
    """
    cells, label = [], None
    for cell, solving in pieces(notebook):
        if solving:
            if label:  # no check has come
                cells.append(_graded(_words(label), label))
            label = None
            continue
        if cell.cell_type == "markdown":
            label = (EXERCISE.findall(cell.source) or [label])[-1]
        else:
            cell = nbformat.from_dict(cell | {"outputs": [], "execution_count": None})
            if label and re.search(r"\b(check|grade)\(", cell.source):
                cell, label = _graded(cell, label), None
        cells.append(cell)
    for number, cell in enumerate(cells):
        cell.id = f"{number}-{cell.id}"[:64]  # the pieces of a cell have got the same
    return nbformat.from_dict(notebook | {"cells": cells})


def _words(label):
    return nbformat.v4.new_markdown_cell("*Your answer, in words:*", id=f"{label}-words")


def _graded(cell, label):
    cell.metadata.tags = [*cell.metadata.get("tags", []), "graded"]
    cell.metadata.exercise = label
    return cell
