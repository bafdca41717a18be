"""Numbers in prose: held to the run, rewritten by it, and out of sight on the page."""

import numpy as np
import pytest

from book._ext.plain import give_captions, with_directives
from vmc_lib.show import prose

NAMES = {"x": 0.678, "n": 3, "low": -2.0, "np": np}
TRUE = [
    "It is 0.68<!--{x:.2f}-->: less.",
    "**0.68**<!--{x:.2f}--> or **0.68<!--{x:.2f}-->**",
    "(3<!--{n}--> of them)",
    "at −2.0<!--{low}--> m",
    "<!--[-->3 of 0.7<!--{f'{n} of {x:.1f}'}-->",
    "**few.**<!--{nearest(n, 1, 4, 9) == 4}--> So it is.",
    "**less.**<!--{np.bool_(x < 1)}-->",
]
FALSE = {
    "It is 0.69<!--{x:.2f}-->.": "the text says '0.69', the run '0.68'",
    "<!--[-->4 of 0.7<!--{f'{n} of {x:.1f}'}-->": "the text says '4 of 0.7', the run '3 of 0.7'",
    "**more.**<!--{x > 1}-->": "needs x > 1, and the run says that it is false",
}


@pytest.mark.parametrize("text", TRUE)
def test_what_the_run_says_is_kept(text):
    prose.check_numbers(text, NAMES)
    assert prose.update(text, NAMES) == text


@pytest.mark.parametrize(("text", "message"), FALSE.items())
def test_what_the_run_does_not_say_is_refused(text, message):
    with pytest.raises(ValueError, match=message):
        prose.check_numbers(text, NAMES)


def test_numbers_follow_a_new_run():
    for old, new in zip(TRUE[:5], ("0.71", "**0.71**", "(4 ", "−3.0", "4 of 0.7"), strict=True):
        text = prose.update(old, {"x": 0.714, "n": 4, "low": -3.0})
        assert new in prose.COMMENT.sub("", text)
        prose.check_numbers(text, {"x": 0.714, "n": 4, "low": -3.0})


def test_the_page_has_the_numbers_alone():
    [cell] = with_directives([{"cell_type": "markdown", "metadata": {}, "source": TRUE[0]}])
    assert cell["source"] == "It is 0.68: less."


def test_a_caption_stands_in_the_figure_above_it():
    source = "**Figure.** Blue: *this*, 0.68<!--{x:.2f}-->."
    [cell] = with_directives([{"cell_type": "markdown", "metadata": {}, "source": source}])
    inside = "<p>Blue</p>"
    assert cell["source"] == "<figcaption>\n\nBlue: *this*, 0.68.\n\n</figcaption>"
    body = f"<figure>1</figure><figure>2</figure></div>\n<figcaption>\n{inside}\n</figcaption>"
    page = {"body": body}
    give_captions(None, "page", "page.html", page, None)
    figure = "<figure>2<figcaption>Blue</figcaption></figure>"
    assert page["body"] == f"<figure>1</figure>{figure}</div>\n"
