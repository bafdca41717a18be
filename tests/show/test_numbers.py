"""The numbers that a plot tells are those that it was drawn from."""

import re

import matplotlib.pyplot as plt
import numpy as np
import pytest

from vmc_lib.show import dot_plot
from vmc_lib.show.numbers import POINTS, SERIES, numbers
from vmc_lib.show.palette import COLOURS


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def told(drawn):
    [table] = numbers(drawn)
    return [tuple(re.findall(r"<t[hd]>([^<]*)</t", row)) for row in table.split("\n")[1:-1]]


def test_curves_dots_and_bars_are_told_and_guide_lines_are_not():
    fig, (left, right) = plt.subplots(1, 2)
    left.plot([0, 1], [2, -3.14159], label="a < b")
    left.plot(5, 6, "o", color=COLOURS["red"])
    left.axhline(7)
    left.set(title="one", xlabel="time (s)", ylabel="force")
    right.bar([1, 2], [3, -4], label="up")
    right.barh([1], [9])
    assert told((fig, np.eye(2))) == [
        ("one", "time (s)", "force"),
        ("a &lt; b", "0", "2"),
        ("a &lt; b", "1", "−3.14"),
        ("red dots", "5", "6"),
        ("", "x", "y"),
        ("up", "1", "3"),
        ("up", "2", "−4"),
        ("bars", "9", "1"),
    ]


def test_places_that_have_names_are_told_by_name():
    rows = told(dot_plot({"test": {"linear": 0.9, "RBF": 0.7}}, "recall", {"RBF": 0.99}))
    assert rows[0][1] == "recall"
    assert rows[1:] == [
        ("test", "0.9", "linear"), ("test", "0.7", "RBF"), ("published", "0.99", "RBF")
    ]  # fmt: skip


def test_long_curves_and_many_are_cut_short():
    fig, ax = plt.subplots()
    for _ in range(SERIES + 3):
        ax.plot(np.arange(1000))
    rows = told(fig)
    assert len(rows) == 1 + SERIES * POINTS + 1
    assert rows[-1] == ("and 3 more", "", "")
    assert {rows[1][1], rows[POINTS][1]} == {"0", "999"}


def test_what_is_no_figure_has_no_numbers():
    assert numbers((np.eye(3), "<p></p>")) == []


def test_dots_and_bars_are_told_one_by_one():
    fig, ax = plt.subplots()
    ax.plot(range(20), range(20), "o")
    ax.bar(range(15), range(15))
    assert len(told(fig)) == 1 + 20 + 15


def test_a_long_line_on_a_logarithmic_axis_is_told_evenly_along_that_axis():
    fig, ax = plt.subplots()
    ax.semilogx(np.arange(1, 257), np.arange(1, 257))
    assert [row[1] for row in told(fig)[1:]] == ["1", "2", "4", "8", "16", "32", "64", "128", "256"]
