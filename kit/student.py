"""A chapter as students get it: no solution in it, and one graded cell an exercise."""

import re

import nbformat


def solves(cell):
    """Whether a cell belongs to a solution."""
    return "solution" in cell.metadata.get("tags", ())


def student(notebook):
    """The chapter without solutions and outputs; what is graded carries the tag "graded".

    Of an exercise that is checked, that is the cell of its `check` or `grade`; of another, a cell
    for words. Its metadata say of which `exercise`, by label.
    """
    cells, label = [], None
    for cell in notebook.cells:
        if solves(cell):
            if label:  # no check has come
                cells.append(_graded(_words(label), label))
            label = None
            continue
        label = cell.metadata.get("exercise", label)
        if cell.cell_type == "code":
            cell = nbformat.from_dict(cell | {"outputs": [], "execution_count": None})
            if label and re.search(r"\b(check|grade)\(", cell.source):
                cell, label = _graded(cell, label), None
        cells.append(cell)
    return nbformat.from_dict(notebook | {"cells": cells})


def _words(label):
    return nbformat.v4.new_markdown_cell("*Your answer, in words:*", id=f"{label}-words")


def _graded(cell, label):
    cell.metadata.tags = [*cell.metadata.get("tags", []), "graded"]
    cell.metadata.exercise = label
    return cell
