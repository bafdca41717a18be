"""A quiz is plain Markdown; the page gives it its style and says which answer is right."""

from html import escape

import pytest
from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin

from book._ext.plain import with_directives

ANSWER = "<details><summary>{}</summary>\n\n{}\n\n</details>"
MARKDOWN = MarkdownIt().use(dollarmath_plugin, renderer=lambda tex, _: rf"\({escape(tex)}\)")
TWO, THREE = ("two", "✓ One and *one*."), ("three", "✗ That is one too many: $1 + 1 < 3$.")


def quiz(*answers):
    """A quiz as the page has it, HTML."""
    source = ["**Quiz.** How much is $1 + 1$?", *(ANSWER.format(*answer) for answer in answers)]
    cell = {"cell_type": "markdown", "metadata": {}, "source": "\n\n".join(source)}
    [cell] = with_directives([cell])
    return MARKDOWN.render(cell["source"])


def test_every_answer_says_why():
    page = quiz(TWO, THREE)
    assert page.count("<details") == page.count("<summary>") == 2
    assert page.count("✓ Right.") == page.count("✗ No.") == 1
    assert r"\(1 + 1\)" in page
    assert "<em>one</em>" in page
    assert "&lt; 3" in page
    assert page.index("two") < page.index("✓ Right.") < page.index("three")
    assert page.startswith('<fieldset class="vmc-quiz" name="quiz-')


@pytest.mark.parametrize(
    "answers", [[TWO], [TWO, TWO], [THREE, THREE], [TWO, ("three", "")], [TWO, ("three", "✗")]]
)
def test_a_quiz_that_cannot_be_answered_is_refused(answers):
    with pytest.raises(ValueError, match=r"'How much .*' needs two or more answers, one of them"):
        quiz(*answers)


@pytest.fixture
def page(open_page):
    return open_page(f"<h1>Q</h1>{quiz(TWO, THREE)}")


@pytest.mark.browser
def test_a_quiz_is_answered_from_the_keyboard(page):
    assert not page.is_visible("text=One and")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    assert page.is_visible("text=✓ Right.")
    assert not page.is_visible("text=✗ No.")
    page.keyboard.press("Tab")
    page.keyboard.press("Space")
    assert page.is_visible("text=✗ No.")
    page.emulate_media(media="print")  # on paper the question stands alone
    assert page.is_visible("text=three")
    assert not page.is_visible("text=✗ No.")


@pytest.mark.browser
def test_a_quiz_is_accessible(page, serious):
    page.eval_on_selector_all("details", "all => all.forEach((d) => (d.open = true))")
    assert serious(page, "html", all_of_it=True) == []
