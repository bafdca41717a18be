"""The tables of a plot hold the numbers that it was drawn from."""

import re

import matplotlib.pyplot as plt
import numpy as np
import pytest

from vmc_lib.show import dot_plot
from vmc_lib.show.data_table import POINTS, SERIES, data_tables
from vmc_lib.show.palette import COLOURS


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def tables(figure):
    """The captions of the tables, and for each its rows, the heads first."""
    [markup] = data_tables(figure)
    parts = markup.split("<table>")[1:]
    captions = [re.findall(r"<caption>(.*)</caption>", part) for part in parts]
    rows = [re.findall(r"<tr>.*</tr>", part) for part in parts]
    return captions, [[re.findall(r"<t[hd]>([^<]*)", row) for row in part] for part in rows]


def test_series_with_the_same_keys_are_columns_of_one_table():
    fig, (left, right) = plt.subplots(1, 2)
    left.plot([0, 1], [2, -3.14159], label="a < b")
    left.plot([0, 1], [5, 6], "o", color=COLOURS["red"])
    left.axhline(7)
    left.set(title="one", xlabel="time (s)", ylabel="force")
    right.bar([1, 2], [3, -4])
    right.set(xlabel="place", ylabel="drive")
    captions, [first, second] = tables((fig, np.eye(2)))
    assert captions == [["one: force"], []]
    assert first == [["time (s)", "a &lt; b", "red dots"], ["0", "2", "5"], ["1", "−3.14", "6"]]
    assert second == [["place", "drive"], ["1", "3"], ["2", "−4"]]


def test_series_with_other_keys_have_a_row_for_each_point():
    fig, ax = plt.subplots()
    ax.plot([0, 1], [2, 3], label="a")
    ax.plot([5, np.nan], [6, 7], "s", color=COLOURS["red"])
    assert tables(fig) == (
        [[]],
        [[["series", "x", "value"], ["a", "0", "2"], ["a", "1", "3"], ["red dots", "5", "6"]]],
    )


@pytest.mark.parametrize("names", [["linear", "RBF"], ["1 movement", "200"], ["200", "100"]])
def test_table_of_a_dot_plot_has_intervals(names):
    first, second = names
    series = {"test": {first: (0.9, 0.8, 1.0), second: 0.7}, "train": {second: [1, 2, 3]}}
    captions, [rows] = tables(dot_plot(series, "recall", {second: 0.99}))
    assert captions == [["recall"]]
    assert rows == [
        ["case", "test", "train", "published"],
        [first, "0.90 (0.80 to 1.00)", "", ""],
        [second, "0.7", "2.0 (−0.5 to 4.5)", "0.99"],
    ]
    assert tables(dot_plot({"": {"a": 1}}, "x"))[1] == [[["case", "x"], ["a", "1"]]]


def test_table_of_error_bars_and_named_bars():
    fig, (left, right) = plt.subplots(1, 2)
    left.errorbar([1, 2], [3, 4], [0.5, 0.1], label="a")
    right.barh(["all", "none"], [9, 8])
    right.set(title="energy")
    _, [left_rows, right_rows] = tables(fig)
    assert left_rows == [["x", "value"], ["1", "3.0 (2.5 to 3.5)"], ["2", "4.00 (3.90 to 4.10)"]]
    assert right_rows == [["case", "energy"], ["all", "9"], ["none", "8"]]


def test_long_curves_and_many_are_cut_short():
    fig, ax = plt.subplots()
    for _ in range(SERIES + 3):
        ax.plot(np.arange(1000))
    _, [rows] = tables(fig)
    assert len(rows) == 1 + SERIES * POINTS + 1
    assert rows[-1] == ["and 3 more", "", ""]
    assert {rows[1][1], rows[POINTS][1]} == {"0", "999"}


def test_every_head_has_a_name():
    fig, ax = plt.subplots()
    ax.plot(range(3))
    assert tables(fig)[1][0][0] == ["x", "value"]


def test_only_figures_have_tables():
    assert data_tables((np.eye(3), "<p></p>")) == []


def test_table_has_every_dot_and_bar():
    fig, ax = plt.subplots()
    ax.plot(range(20), range(20), "o")
    ax.bar(range(15), range(15))
    assert len(tables(fig)[1][0]) == 1 + 20 + 15


def test_long_line_is_sampled_evenly_on_a_log_axis():
    fig, ax = plt.subplots()
    ax.semilogx(np.arange(1, 257), np.arange(1, 257))
    keys = [row[0] for row in tables(fig)[1][0][1:]]
    assert keys == ["1", "2", "4", "8", "16", "32", "64", "128", "256"]


def test_what_an_axis_cannot_show_is_left_out():
    fig, (left, right) = plt.subplots(1, 2)
    left.semilogx(np.arange(257), np.arange(257))
    right.errorbar([0, 1, 2], [1, np.nan, 3], yerr=0.5, xerr=0.1)
    first, second = tables(fig)[1]
    assert first[1][0] == "1"
    assert [row[1] for row in second[1:]] == ["1.0 (0.5 to 1.5)", "3.0 (2.5 to 3.5)"]


def test_guide_lines_are_left_out_and_gids_name_series():
    fig, ax = plt.subplots()
    ax.plot([0, 1], [1e-17, 1], gid="targets")
    ax.plot([0, 1], [5, 5], gid="guide")
    ax.plot([0, 1], [2, 3], color=COLOURS["ink"])
    assert tables(fig)[1] == [[["x", "targets", "dark line"], ["0", "0", "2"], ["1", "1", "3"]]]
    assert ax.get_legend_handles_labels() == ([], [])
