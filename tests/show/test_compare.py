"""Estimates and comparisons: what their intervals are, and how they are drawn and described."""

from types import MappingProxyType

import matplotlib.pyplot as plt
import numpy as np
import pytest

from vmc_lib.show import compare, demo, dot_plot, estimate, photo_view, table
from vmc_lib.show.alt_text import alt_text
from vmc_lib.show.scene import Scene
from vmc_lib.statistics import t_interval

DRAWS = [0.3, 0.5, 0.4]


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def test_estimate_of_draws_has_students_interval():
    mean, half = t_interval(DRAWS)
    assert estimate(DRAWS) == estimate(np.array(DRAWS)) == (mean, mean - half, mean + half)
    assert estimate((0.4, 0.2, 0.7)) == (0.4, 0.2, 0.7)
    assert estimate(0.4) == estimate([0.4]) == (0.4, 0.4, 0.4)


def test_estimate_has_two_digits_of_its_interval():
    words = [str(estimate(e)) for e in ((0.341, 0.268, 0.414), (34.2, 33.01, 35.4), (-3, -9, 90))]
    assert words == ["0.34 (0.27 to 0.41)", "34.2 (33.0 to 35.4)", "−3 (−9 to 90)"]
    assert f"{estimate((0.341, 0.268, 0.414)):.0%}" == "34% (27% to 41%)"
    assert str(estimate(0.3412)) == "0.341"


def test_a_cell_of_a_table_may_be_an_estimate():
    assert table(["a", "b"], [["x", (0.5, 0.4, 0.6)], ["y", np.array(DRAWS)]]).splitlines()[2:] == [
        "| x | 0.50 (0.40 to 0.60) |", "| y | 0.40 (0.15 to 0.65) |"
    ]  # fmt: skip


def test_dot_plot_shows_values_intervals_and_published_ticks():
    series = {"test": {"linear": (0.9, 0.8, 1.0), "RBF": 0.7}, "train": {"RBF": 0.95}}
    fig = dot_plot(series, "recall", {"RBF": 0.99})
    [ax] = fig.axes
    values = [line.get_xdata().tolist() for line in ax.lines]
    assert values == [[0.9, 0.7], [0.95], [0.99]]
    assert [text.get_text() for text in ax.get_yticklabels()] == ["linear", "RBF"]
    intervals = [c.get_segments() for c in ax.collections]
    assert [[line[0][0], line[1][0]] for line in intervals[0]] == [[0.8, 1.0], [0.7, 0.7]]
    [legend] = fig.legends
    assert [text.get_text() for text in legend.get_texts()] == ["test", "train", "published"]
    assert not dot_plot({"": {"a": 1}}, "x").legends


def test_dot_plot_takes_any_mapping():
    series = MappingProxyType({"ours": MappingProxyType({"a": 1.0})})
    fig = dot_plot(series, "x", MappingProxyType({"a": 2.0}))
    assert [line.get_xdata().tolist() for line in fig.axes[0].lines] == [[1.0], [2.0]]


def test_a_phone_shows_a_dot_plot_with_long_names_whole():
    """A name stands in two lines, and in one where it is said; a formula is never cut."""
    long, formula = "off-line, least squares, 8 trials over the whole hold", r"$a \cdot b$ of it"
    fig = dot_plot({"": {long: 1, formula: 2}}, "x")
    assert fig.get_figwidth() == 4.2  # inches
    first, second = (text.get_text() for text in fig.axes[0].get_yticklabels())
    assert first.replace("\n", " ") == long
    assert first.count("\n") == 1
    assert second == formula
    assert long in alt_text(fig)


def test_a_comparison_has_one_table_and_its_own_description(outputs, monkeypatch):
    monkeypatch.setenv("VMC_RENDER_MODE", "book")
    items = outputs(demo)
    compare({"ours": {"a": DRAWS, "b": 0.7}}, "recall", {"a": 0.6}, (0, 1))
    [page] = items
    assert page.count("<table>") == page.count("<details") == 1
    assert "0.40 (0.15 to 0.65)" in page
    words = "recall: ours: a 0.40 (0.15 to 0.65), b 0.7; published: a 0.6."
    assert f'aria-label="{words}"' in page


def plot(*lines, **labels):
    fig, ax = plt.subplots()
    for line in lines:
        ax.plot(*line)
    ax.set(**labels)
    return fig


def test_alt_text_of_a_line_gives_its_ends_and_extremes():
    fig = plot(([0, 1, 2], [1, 3, 2]), xlabel="time (s)", ylabel="force (N)", title="held")
    words = "force (N) against time (s): from 1 at 0 to 2 at 2, highest 3 at 1."
    assert alt_text(fig) == f"held: {words}"


def test_alt_text_of_dots_gives_their_range():
    ways = plot(([0, 1, 0], [1, 3, -1]), xlabel="forward (m)", ylabel="up (m)")
    words = "up (m) against forward (m): 3 points from −1 to 3, forward (m) 0 to 1."
    assert alt_text(ways) == words
    assert (
        alt_text(plot(([0, 1, 2], [1, 3, -1], "o")))
        == "a plot against x: 3 points from −1 to 3, x 0 to 2."
    )


def test_alt_text_of_many_series_is_short():
    rows = {f"row {i}": i / 10 for i in range(13)}
    words = "recall: from row 0 0 to row 12 1.2."
    assert alt_text(dot_plot({"": rows}, "recall")) == words
    assert alt_text(plot(*[([0, 1], [0, i]) for i in range(7)])).endswith("; and 3 more.")


def test_alt_text_of_markup_is_its_words():
    photo = photo_view(np.zeros((9, 9, 3), np.uint8), [((1, 2, 3, 4), "cup <1>", "blue")])
    assert alt_text((photo, "<p>It is <b>3</b>.</p>")) == "A photo with labels: cup <1>. It is 3."
    assert alt_text((Scene(), "<p>It misses.</p>")) == "It misses."
    fig, ax = plt.subplots()
    fig.colorbar(ax.imshow(np.eye(3)))
    for silent in (np.eye(3), Scene(), "<svg></svg>", fig):
        with pytest.raises(ValueError, match="give `alt`"):
            alt_text(silent)
