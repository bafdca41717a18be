"""Optional sections of a chapter: folded in the page until a reader asks for them."""

import re

import nbformat
import pytest

from book._ext.plain import with_directives
from book.figures.inventory import core, title_and_minutes
from tests.project import core_minutes, each_chapter

SECTION = """
<a href="#inside">there</a>
<section class="vmc-optional" id="sure"><h2>Sure?<a class="headerlink" href="#sure">#</a></h2>
<p id="inside">Words.</p></section>"""


def test_a_tag_on_its_heading_makes_a_section_optional():
    cell = {"cell_type": "markdown", "metadata": {"tags": ["optional"]}, "source": "## Sure?"}
    [translated] = with_directives([cell])
    assert translated["source"] == "{.vmc-optional}\n## Sure?"


@each_chapter
def test_an_optional_section_begins_and_ends_with_a_heading(path):
    """At the head of a cell, so that the notebook's cells tell what the page folds."""
    cells = nbformat.read(path, as_version=4).cells
    open_cells = {cell.id for cell in core(cells)}
    for cell in cells:
        if "optional" in cell.metadata.get("tags", []):
            assert re.match(r"###? \S", cell.source), cell.id
        if cell.cell_type == "markdown" and cell.id not in open_cells:
            assert not re.search(r"(?<!\A)^## ", cell.source, re.M), cell.id


@each_chapter
def test_the_minutes_are_those_of_the_core(path):
    """An hour at most, and near to what its words and demos take."""
    stated = title_and_minutes(path)[1]
    assert stated <= 60
    assert stated == pytest.approx(core_minutes(path), rel=0.25)


@pytest.mark.browser
def test_an_optional_section_opens_when_asked_for_or_linked_to(open_page):
    page = open_page(SECTION)
    button, words = page.locator("h2 > button"), page.locator("#inside")

    def is_open():
        assert button.get_attribute("aria-expanded") in ("true", "false")
        seen = words.evaluate("(words) => words.checkVisibility()")
        assert (button.get_attribute("aria-expanded") == "true") == seen
        return seen

    assert not is_open()
    button.click()
    assert is_open()
    button.click()
    assert not is_open()
    page.emulate_media(media="print")
    assert words.evaluate("(words) => words.checkVisibility()")
    page.emulate_media(media="screen")
    page.locator("a[href='#inside']").first.click()
    assert is_open()
    page.goto(f"{page.url.split('#')[0]}#100%")  # no address, cut in the middle of a sign
    page.reload()
    assert not is_open()
