"""What tests of demos share: what is displayed, and pages that show it."""

import pytest

from tests import pages
from vmc_lib.show import demo, explore


@pytest.fixture
def book(monkeypatch):
    monkeypatch.setenv("VMC_RENDER_MODE", "book")


@pytest.fixture
def open_demos(open_page):
    """A function that opens a page of what `declare()` shows in the book."""
    return lambda declare, *window: open_page(pages.book_html(demo, declare), *window)


@pytest.fixture
def open_demo(open_demos):
    """A function that opens a page with one demo."""
    return lambda draw, *window, alt="words", **controls: open_demos(
        lambda: explore(draw, "A caption.", alt, **controls), *window
    )
