"""What all tests share: demos live their test life, and page tests find a browser."""

import os

import pytest

os.environ["VMC_LIFE"] = "test"  # chapters run by nbmake inherit it
os.environ.setdefault("MPLBACKEND", "agg")


@pytest.fixture(scope="session")
def chromium():
    """A headless browser; without one the test is skipped, in continuous integration it fails."""
    from playwright.sync_api import sync_playwright

    from vmc_lib.show import browser

    path = browser.find()
    if not path:
        (pytest.fail if os.environ.get("CI") else pytest.skip)(browser.MISSING)
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=path, args=browser.FLAGS)
        yield chromium
        chromium.close()


@pytest.fixture(scope="module")
def offline(chromium):
    """A browser window with the network off."""
    context = chromium.new_context(offline=True, viewport={"width": 1200, "height": 900})
    yield context
    context.close()
