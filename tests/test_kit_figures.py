"""Figures to take along: each a file that stands alone, with its licence's line."""

import re
from xml.etree import ElementTree

import pytest

from kit import figures
from tests.project import python

FIGURE = """<figure class="vmc-demo"><div><svg viewBox="0 0 9 9"><svg x="1"></svg>
<path stroke="var(--vmc-red)"/></svg></div><img src="data:image/png;base64,QUI="><script>"<svg>"
</script></figure>"""
SVG = "{http://www.w3.org/2000/svg}"


def test_a_drawing_stands_alone_in_its_light_colours():
    (kind, drawing), photo = figures.pictures(FIGURE, "Ann & Bo")
    root = ElementTree.fromstring(drawing)  # noqa: S314 (our own)
    assert (kind, root.tag, root[0].text) == ("svg", f"{SVG}svg", "Ann & Bo")
    assert root.find(f"{SVG}path").get("stroke") == "#c22f3a"
    assert photo == ("png", b"AB")


def test_a_chapter_is_named_by_its_heading_not_by_the_contents_above_it():
    page = '<h1>Arm</h1>\n<p>Contents</p>\n<h1>An arm<a class="headerlink" href="#arm"></a></h1>'
    assert figures.TITLE.search(page)[1] == "An arm"


def test_every_chapter_gives_drawings_that_can_be_read(kit):
    files = [*(kit / "figures").glob("*.svg")]
    text = (kit / "figures/index.html").read_text(encoding="utf-8")
    assert {file.name.split("-")[1] for file in files} >= {str(n) for n in range(2, 17)}
    for file in files:
        root = ElementTree.parse(file).getroot()  # noqa: S314 (our own)
        assert re.fullmatch(r"From “.+ CC BY 4\.0; pictures: CREDITS\.md\.", root[0].text)
        assert "Contents" not in root[0].text
        assert f'href="{file.name}"' in text
    assert all((kit / "figures" / name).exists() for name in ("CREDITS.md", "LICENSE-text"))


@pytest.mark.browser
def test_a_png_is_twice_as_large(tmp_path):
    (tmp_path / "a.svg").write_bytes(figures.pictures(FIGURE, "")[0][1])
    script = "import sys, pathlib, kit.figures as f; f.print_pngs(pathlib.Path(sys.argv[1]))"
    python("-c", script, tmp_path)  # a browser of its own
    assert (tmp_path / "a.png").read_bytes()[1:4] == b"PNG"
