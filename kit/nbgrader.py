"""nbgrader's source of a chapter: the student's notebook, our checks in it as hidden tests.

https://nbgrader.readthedocs.io/en/stable/contributor_guide/metadata.html (metadata, version 3)
"""

from textwrap import indent

import nbformat

from kit.marking import known_mistakes
from kit.student import checks, student

HIDDEN = """
### BEGIN HIDDEN TESTS
import os

from kit.marking import points_of_check

os.environ["VMC_RENDER_MODE"] = "live"
with points_of_check({known!r}) as points:
{check}

points()
### END HIDDEN TESTS"""


def source(chapter, files=None):
    """The chapter as `student` makes it, with what nbgrader hides in each cell that it grades.

    `nbgrader generate_assignment` takes it out again, and `autograde` puts it back. It has as many
    points as `kit.marks` gives; an answer in words is left to the lecturer.
    """
    sources, known = checks(chapter), known_mistakes(chapter)
    cells = []
    for cell in student(chapter, files).cells:
        label = cell.metadata.get("exercise")
        if cell.cell_type == "code" and sources.get(label):
            hidden = HIDDEN.format(
                known=known.get(label, []), check=indent(sources[label], 4 * " ")
            )
            cell = nbformat.from_dict(cell | {"source": cell.source + hidden})
        cells.append(cell)
    return nbformat.from_dict(chapter | {"cells": cells})
