"""Numbers and their units: on one line."""

import re

import pytest

from book._ext.units import with_units
from tests.pages import BUILT


@pytest.mark.parametrize(
    ("text", "bound"),
    [
        ("off by 9 mm, 95\n% of 2 × 6", "off by 9~mm, 95~% of 2~×~6"),
        ("<b>9</b> mm", "<b>9</b>~mm"),
        ("<p>chapter 9</p> s", "<p>chapter 9</p> s"),
        ("by 9 minutes, 3 N m/s", "by 9 minutes, 3~N~m/s"),
        ("<pre>9 mm</pre>", "<pre>9 mm</pre>"),
        (r'<i class="math notranslate">\(9\)</i> mm', r'<i class="math notranslate">\(9\)</i>~mm'),
    ],
)
def test_a_number_stays_with_its_unit(text, bound):
    assert with_units(text).replace("\u00a0", "~") == bound


def test_a_built_page_has_its_units_bound():
    page = (BUILT / "book/08_arm.html").read_text(encoding="utf-8")
    assert "\u00a0mm" in page
    assert not re.search(r"<p>[^<]*\d mm\b", page)
