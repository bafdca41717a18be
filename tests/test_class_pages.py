"""The kit's pages for a class: throws with a turned pointer, offline, with nothing but a browser."""

import csv
import io

import numpy as np
import pytest

from kit.__main__ import throws, throws_page

pytestmark = pytest.mark.browser


@pytest.fixture
def page(tmp_path, window):
    """A function: one of the kit's pages, open; it may not complain."""
    opened = []

    def page(html):
        (tmp_path / "page.html").write_text(html, encoding="utf-8")
        opened.append(window(viewport={"width": 1000, "height": 900}).new_page())
        opened[-1].on("pageerror", lambda error: pytest.fail(str(error)))
        opened[-1].goto((tmp_path / "page.html").as_uri())
        return opened[-1]

    return page


def saved(page, button):
    """The file that a button saves, as text."""
    with page.expect_download() as download:
        page.click(button)
    return download.value.path().read_text(encoding="utf-8")


def throw(page, degrees, steps=6):
    """Throw with the mouse, so many degrees to the right."""
    page.evaluate("scrollTo(0, 0)")
    box = page.locator("#field").bounding_box()
    scale = min(box["width"] / 600, box["height"] / 400)
    x = box["x"] + box["width"] / 2
    y = box["y"] + box["height"] / 2 + 140 * scale
    page.mouse.move(x, y)
    page.mouse.down()
    way = 260 * scale * np.array([np.sin(np.radians(degrees)), -np.cos(np.radians(degrees))])
    page.mouse.move(x + way[0], y + way[1], steps=steps)
    page.mouse.up()


def test_throws_are_turned_saved_and_drawn_beside_the_model(page, tmp_path):
    """One who always throws straight misses by 30 degrees while turned; the class's mean is drawn."""
    room = page(throws_page())
    throw(room, 10)
    room.fill("#who", "ann")
    for _ in range(60):  # the page takes no more than 55
        room.click("#throw")
    text = saved(room, "#save")
    rows = list(csv.DictReader(io.StringIO(text)))
    assert [row["who"] for row in rows] == ["ann"] * 55
    misses = np.array([float(row["miss"]) for row in rows])
    np.testing.assert_allclose(misses[0], 10, atol=1)
    np.testing.assert_array_equal(misses[1:], np.repeat([0, 30, 0], [9, 30, 15]))
    assert room.locator("#plot circle").count() == 55
    (tmp_path / "ann.csv").write_text(text, encoding="utf-8")
    shifted = [[k, 20 * (k in range(11, 41)), 10 * (k in range(11, 41))] for k in range(1, 56)]
    goggles = "".join(f"bob,{k},{turned},{miss},\n" for k, turned, miss in shifted)  # in cm
    (tmp_path / "bob.csv").write_text(f"who,throw,turned,miss,ms\n{goggles}", encoding="utf-8")
    (tmp_path / "bad.csv").write_text("1,2", encoding="utf-8")
    room.set_input_files("#files", [tmp_path / f"{name}.csv" for name in ("ann", "bob", "bad")])
    assert "bad.csv: its first line is not" in room.inner_text("#told")
    assert "the mean of 2 files" in room.inner_text("#legend")
    points = room.locator("#plot polyline").evaluate_all(
        "all => all.map((p) => p.getAttribute('points'))"
    )
    model, mean = (
        [(150 - float(point.split(",")[1])) / 90 for point in line.split()] for line in points
    )
    np.testing.assert_allclose(model, throws(), atol=1e-3)
    np.testing.assert_allclose(mean[10:40], 0.75)


def test_model_of_the_throws_adapts_and_has_an_after_effect():
    left = throws()
    assert left[:10].tolist() == [0] * 10
    assert left[10] == 1
    assert 0 < left[39] < 0.5
    assert -1 < left[40] < -0.5
    assert abs(left[54]) < abs(left[40]) / 2


def test_sheet_for_goggles_has_a_line_for_each_throw(page):
    rows = list(csv.DictReader(io.StringIO(saved(page(throws_page()), "#sheet"))))
    assert [row["throw"] for row in rows] == [str(k) for k in range(1, 56)]
    assert [row["turned"] for row in rows] == ["0"] * 10 + [""] * 30 + ["0"] * 15
