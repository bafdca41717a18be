"""Forest plots: where a mark stands, what lies beyond the axis, and what stands in words."""

import re

import numpy as np
import pytest

from book.figures.benchmarks import times_as_fast
from book.figures.forest_plot import RATIO, TIMES, Line, Mark, forest_plot, in_words


def test_a_number_stands_where_its_axis_says():
    assert [float(RATIO.place(v)) for v in (0, 1, 2, 5, -1)] == [6, 73, 140, 140, 6]
    decades = [float(TIMES.place(10**n)) for n in range(-1, 5)]
    assert np.diff(decades) == pytest.approx([35.6] * 5)


def test_what_lies_beyond_the_axis_is_marked():
    within, beyond = (Mark("beaten", RATIO, value).svg(8) for value in (2, 2.1))
    assert beyond.startswith(within.removesuffix('"/>'))
    assert beyond != within


def test_a_line_leads_to_its_numbers_and_says_that_there_are_none():
    mark = Mark("differs", RATIO, 0.5, (0.4, 0.6), (0.2, 0.8), side=-1)
    groups = {"Where": [Line("Fig. 6", "row-fig-6", "A <claim>.", [mark]), Line("I", "i", "", [])]}
    html = forest_plot(groups)
    assert re.findall(r'<a href="#([^"]+)"', html) == ["row-fig-6", "i"]
    assert "A &lt;claim&gt;." in html
    assert html.count("nothing to compare") == 1
    for kind in ("side", "wider", "differs", "against"):
        assert f'class="{kind}"' in html
    assert in_words(groups) == "2 lines, Where: differs: 1."
    assert in_words({}) in forest_plot({})


def test_costs_are_ratios_of_the_tables_times():
    marks = [mark for lines in times_as_fast().values() for line in lines for mark in line.marks]
    assert len(marks) >= 20
    for mark in marks:
        assert (mark.kind == "faster") == (mark.value >= 1)
        assert TIMES.ends[0] < mark.value < TIMES.ends[1]
