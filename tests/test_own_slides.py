"""A lecturer's own slides: after the figures they name, in the clock, with their notes."""

import re

import pytest

from kit.chapter_slides import Slide
from kit.own_slides import own_slides, put_in

TEXT = """after: Figure 7.1

## Ours

Half of $F_0$.

Note: slowly

---

Another.

after: Figure 7.3

![](lab.png)
"""


def shows(figure):
    return Slide([f"<span>Figure {figure}</span>"])


def test_own_slides_follow_their_figures():
    title, one, three, quiz = Slide(["title"]), shows("7.1"), shows("7.3"), Slide(["quiz"])
    deck = {"Begin": [title], "Predict and drag": [one, three], "Quiz": [quiz]}
    put_in(deck, own_slides(TEXT))
    assert (deck["Begin"], deck["Quiz"]) == ([title], [quiz])
    first, ours, another, second, picture = deck["Predict and drag"]
    assert (first, second) == (one, three)
    assert [*ours.body, *ours.notes] == [
        '<h2>Ours</h2>\n<p>Half of <span class="math inline">\\(F_0\\)</span>.</p>\n',
        "<p>slowly</p>\n",
    ]
    assert "Another." in another.body[0]
    assert 'src="lab.png"' in picture.body[0]


def test_what_has_no_place_is_said():
    with pytest.raises(ValueError, match="'## Ours' stands after no figure: begin with"):
        own_slides("## Ours\n")
    words = "no slide shows Figure 7.3: put yours after one of 7.1"
    with pytest.raises(ValueError, match=re.escape(words)):
        put_in({"Begin": [shows("7.1")]}, own_slides(TEXT))
