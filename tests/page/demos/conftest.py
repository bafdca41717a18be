"""The page of the demos that a test module declares."""

import pytest

from tests.pages import book_html, open_html
from vmc_lib.show import demo


@pytest.fixture(scope="module")
def page(offline, site, request):
    """What the module's `declare` shows, on a page with the book's scripts."""
    page = open_html(offline, site, book_html(demo, request.module.declare))
    yield page
    page.close()
    assert page.errors == page.failed == []
