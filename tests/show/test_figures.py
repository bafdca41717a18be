"""Pictures as markup."""

import base64
import re
from types import MappingProxyType

import cv2
import matplotlib.pyplot as plt
import numpy as np
import pytest

from vmc_lib.show import details, figures, itemise, photo_view, table
from vmc_lib.show.figures import pictures
from vmc_lib.show.markup import number
from vmc_lib.show.palette import COLOURS, ON_PHOTO
from vmc_lib.show.render_mode import STATIC


def pixels(markup):
    data = re.search(r"data:image/\w+;base64,([^\"\s]+)", markup)[1]
    return cv2.imdecode(np.frombuffer(base64.b64decode(data), np.uint8), cv2.IMREAD_UNCHANGED)


def contrast(one, other):
    """The contrast ratio of two colours, as the web's accessibility guidelines define it."""

    def luminance(colour):
        channel = np.array(list(bytes.fromhex(colour[1:]))) / 255
        linear = np.where(channel <= 0.04045, channel / 12.92, ((channel + 0.055) / 1.055) ** 2.4)
        return linear @ [0.2126, 0.7152, 0.0722]

    low, high = sorted([luminance(one), luminance(other)])
    return (high + 0.05) / (low + 0.05)


SCENE = {"muscle", "wood", "bone"}  # colours of the page, beside those of plots


def palette(theme):
    css = (STATIC / "demo.css").read_text(encoding="utf-8")
    block = re.search(re.escape(theme) + r" \{(.*?)\}", css, re.S)[1]
    return dict(re.findall(r"--vmc-(\w+): (#[0-9a-f]{6})", block))


def test_the_style_sheet_holds_the_palette():
    light, dark = palette(":root"), palette('html[data-theme="dark"]')
    assert {name: light[name] for name in light.keys() - SCENE} == COLOURS
    assert light.keys() == dark.keys() == COLOURS.keys() | SCENE


@pytest.mark.parametrize("theme", [":root", 'html[data-theme="dark"]'])
def test_colours_can_be_read_on_the_page(theme):
    colours = palette(theme)
    words = colours.keys() - {"line", "paper", "wood", "bone"}  # grounds and rules
    assert contrast(colours["ink"], colours["wood"]) >= 4.5
    assert all(contrast(colours[name], colours["paper"]) >= 4.5 for name in words)


def test_arrays_keep_their_pixels():
    colour = np.random.default_rng(0).integers(0, 255, (8, 9, 3), dtype=np.uint8)
    assert np.array_equal(pixels(pictures(colour, "x")[0])[..., ::-1], colour)
    grey = np.array([[0.0, 0.5], [1.0, 2.0]])
    assert pixels(pictures(grey, "x")[0]).tolist() == [[0, 128], [255, 255]]
    with pytest.raises(ValueError, match="int64 has no known range: give uint8"):
        pictures(np.full((4, 4), 200), "x")


def test_photographs_are_small():
    noise = np.random.default_rng(0).integers(0, 255, (40, 60, 3), dtype=np.uint8)
    photo = cv2.resize(noise, (600, 400), interpolation=cv2.INTER_CUBIC)
    assert "image/webp" in photo_view(photo)
    assert len(photo_view(photo)) < 100_000
    assert "image/png" in photo_view(photo // 255)


def test_photo_view_draws_boxes_and_points():
    svg = photo_view(
        np.zeros((400, 600, 3), np.uint8),
        boxes=[((10, 20, 110, 70), "cup <1>", "orange")],
        points=[((30.04, 40), "target", "green")],
    )
    assert 'x="10.0" y="20.0" width="100.0" height="50.0"' in svg
    assert "cup &lt;1&gt;" in svg
    assert ON_PHOTO["orange"] in svg
    assert 'cx="30.0" cy="40.0"' in svg
    assert "target" in svg


def test_photo_view_takes_boxes_and_points_one_by_one():
    image = np.zeros((400, 600, 3), np.uint8)
    boxes, points = [((10, 20, 110, 70), "cup", "orange")], [((30, 40), "target", "green")]
    assert photo_view(image, iter(boxes), iter(points)) == photo_view(image, boxes, points)


def test_words_of_a_photo_do_not_hide_each_other():
    """Below the words in the corner stands a box's name, and below its box that of a second."""
    corner, *boxes = (8, 0, 8, 0), (8, 42, 90, 120), (8, 42, 90, 121)
    svg = photo_view(
        np.zeros((400, 600, 3), np.uint8), [(b, "mean", "ink") for b in (corner, *boxes)]
    )
    heights = [float(y) for y in re.findall(r'<text x="8.0" y="([^"]+)"', svg)]
    assert np.diff(sorted(heights)).min() > 20


def test_photo_axes_are_pixels_by_default():
    image = np.zeros((400, 600, 3), np.uint8)
    assert 'data-axes="0 600 400 0 0 1 1 0"' in photo_view(image)
    assert 'data-axes="0.5 5.5 2.5 0.5 0 1 1 0"' in photo_view(image, axes=(0.5, 5.5, 2.5, 0.5))


def test_plots_share_no_names_unless_they_are_states_of_one():
    def plot():
        fig, ax = plt.subplots()
        ax.plot([1, 2], "o")
        return fig

    one, same, other = (pictures(plot(), name)[0] for name in ("demo-1", "demo-1", "demo-2"))
    assert one == same
    ids = [set(re.findall(r' id="([^"]+)"', svg)) for svg in (one, other)]
    assert ids[0]
    assert not ids[0] & ids[1]


def test_only_two_panels_of_one_plot_each_are_stackable():
    def plot(*grid, title=False, bar=False):
        fig, axes = plt.subplots(*grid)
        if title:
            fig.suptitle("over both")
        if bar:
            fig.colorbar(axes.imshow([[0, 1]]))
        return pictures(fig, "p")[0]

    assert plot(1, 2).count("<svg") == 2
    assert 'href="#p-0-panels"' in plot(1, 2)
    assert plot(2, 2).count("<svg") == 2
    assert [plot(1, 1).count("<svg"), plot(1, 3).count("<svg")] == [1, 1]
    assert plot(1, 2, title=True).count("<svg") == 1
    assert plot(1, 1, bar=True).count("<svg") == 1


def test_details_keep_markdown(outputs):
    texts = outputs(figures)
    details("The numbers", "| a |")
    assert texts == ["<details><summary>The numbers</summary>\n\n| a |\n\n</details>"]


def test_a_number_below_zero_has_a_minus_sign(outputs):
    texts = outputs(figures)
    figures.markdown("From -1.5 (-.2) to **-3**; $x = -1$, `f -1`, 2003-4, two-thirds")
    assert texts == ["From −1.5 (−.2) to **−3**; $x = -1$, `f -1`, 2003-4, two-thirds"]


def test_numbers_are_written_as_in_a_text_and_not_as_in_code():
    values = -0.5, 1234.0, 3e-8, -2e9, 7, 0.0
    assert [number(v) for v in values] == ["−0.5", "1230", "3·10⁻⁸", "−2·10⁹", "7", "0"]
    assert number(1234.5, 4) == "1234"
    assert "1200" in table(["metres"], [[1200.0]])


def test_a_tables_rows_may_have_names_and_its_numbers_a_format():
    rows = {"ours": [0.125, (2, 1, 3), 7, "so"]}
    assert table("abcde", rows, ".1f").endswith("| ours | 0.1 | 2.0 (1.0 to 3.0) | 7 | so |")


def test_a_tables_rows_come_one_by_one_or_in_any_mapping():
    rows = {"ours": [1], "theirs": [2]}
    expected = table("ab", rows)
    assert table("ab", ([name, *cells] for name, cells in rows.items())) == expected
    assert table("ab", MappingProxyType(rows)) == expected


def test_values_are_listed_with_their_names():
    assert itemise({"a": 0.5, "b": 2}, "{:.1f} mm ({})") == "0.5 mm (a), 2.0 mm (b)"
    assert itemise({"a": 0.5, "b": 2}, "{1} {0:g}", "; ") == "a 0.5; b 2"
