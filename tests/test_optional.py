"""Optional sections of a chapter: folded in the page until a reader asks for them."""

import pytest

from book._ext.plain import with_directives

SECTION = """
<a href="#inside">there</a>
<section class="vmc-optional" id="sure"><h2>Sure?<a class="headerlink" href="#sure">#</a></h2>
<p id="inside">Words.</p></section>"""


def test_a_tag_on_its_heading_makes_a_section_optional():
    cell = {"cell_type": "markdown", "metadata": {"tags": ["optional"]}, "source": "## Sure?"}
    [translated] = with_directives([cell])
    assert translated["source"] == "{.vmc-optional}\n## Sure?"


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
