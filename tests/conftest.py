"""What all tests share: demos live their test life, and page tests find a browser."""

import gc
import os
import re
import shutil
from collections import Counter
from contextlib import suppress
from functools import partial
from pathlib import Path

import joblib
import numpy as np
import pytest
from filelock import FileLock
from hypothesis import settings
from playwright.sync_api import Error

from page.bundle import page_script
from tests import pages
from tests.engines import NOT_TESTED, Firefox, WebKit
from vmc_lib import photos
from vmc_lib.motor import templates
from vmc_lib.what.cdbn import crops_of
from vmc_lib.what.crops import whiten

settings.register_profile("untimed", deadline=None)  # a busy machine is slow, and no failure
settings.load_profile("untimed")
os.environ["VMC_RENDER_MODE"] = "test"
os.environ.setdefault("MPLBACKEND", "agg")
os.environ["PYTHONPATH"] = str(Path(__file__).parents[1])  # of the programs that tests start


def pytest_xdist_auto_num_workers():
    """One worker more than processors: who drives a browser waits for it half of the time."""
    return joblib.cpu_count() + 1


@pytest.hookimpl(wrapper=True)
def pytest_collection():
    """Look for no garbage while modules are imported, nor in them later: a third of the time."""
    gc.disable()
    collected = yield
    gc.freeze()
    gc.enable()
    return collected


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Ask of all pages `only` its own; leave to the audit all but those of `kinds`."""
    for item in list(items):
        only, kinds = map(item.get_closest_marker, ("only", "kinds"))
        if only and item.callspec.params["page"].stem not in only.args:
            items.remove(item)
        if kinds and item.callspec.params["page"].stem not in kinds.args:
            item.add_marker("audit")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    """Keep what the open pages showed when a test failed, in _build/failed."""
    report = yield
    if report.when == "call" and report.failed:
        name = re.sub(r"\W+", "_", item.nodeid)
        for number, page in enumerate(pages.OPEN):
            with suppress(Error):  # of a page that has gone
                page.screenshot(path=FAILED / f"{name}_{number}.png", timeout=10_000)
                report.sections.append((f"{name}_{number}.png: {page.url}", f"{page.errors}"))
    return report


def pytest_unconfigure(config):
    """Say loudly, in the last lines, what was not tested."""
    reporter = config.pluginmanager.get_plugin("terminalreporter")
    skipped = reporter.stats.get("skipped", ()) if reporter else ()
    for why, count in Counter(report.longrepr[2] for report in skipped).items():
        reporter.line(f"NOT TESTED: {count} of the tests. {why}", red=True, bold=True)


# WebAssembly is compiled a second time, better, only where it works for long (thirty times as long
# as is usual), and then without what lengthens its code; and the edges of what is drawn in three
# dimensions need not be smooth
WASM = (
    "--wasm-tiering-budget=400000000",
    *("--no-wasm-inlining", "--no-wasm-loop-peeling", "--no-wasm-loop-unrolling"),
)
LIGHT = f"--js-flags={','.join(WASM)}", "--webgl-antialiasing-mode=none"
ENGINES = [Firefox, pytest.param(WebKit, marks=pytest.mark.audit)]
FAILED = pages.ROOT / "_build/failed"
# What passed is long: it stays in the page
AXE_RUN = """async ([within, theme, options]) => {
  document.documentElement.dataset.theme = theme;
  const settings = { preload: false, resultTypes: ["violations"], ...options };
  return (await axe.run(within, settings)).violations; }"""
RULES = {  # from one theme to the other only colours change
    "light": {"rules": {"target-size": {"enabled": True}}},  # of WCAG 2.2
    "dark": {"runOnly": ["color-contrast", "link-in-text-block"]},
}


@pytest.fixture
def rng():
    """Random numbers of a test's own: the same whatever ran before it."""
    return np.random.default_rng(0)


@pytest.fixture(scope="session")
def template_set():
    """The templates that ship, 6 cm apart."""
    return templates.load()


@pytest.fixture(scope="session")
def photo():
    """A photo of the rig that no model learned from."""
    return photos.load("rig", "validation")[0]


@pytest.fixture(scope="session")
def white():
    """Whitened crops (4, 1, 200, 200) of the things in two training photos."""
    crops, _ = crops_of(photos.load("rig", "train")[:2])
    return whiten(crops)


@pytest.fixture(scope="session")
def once(tmp_path_factory):
    """A function: a folder that one worker makes, by `make(folder)`, and all workers read."""
    base = tmp_path_factory.getbasetemp()
    base = base.parent if "PYTEST_XDIST_WORKER" in os.environ else base

    def once(name, make):
        folder, there = base / name, base / f"{name}.there"
        with FileLock(base / f"{name}.lock"):
            if not there.exists():
                make(folder)
                there.touch()
        return folder

    return once


@pytest.fixture(scope="session")
def kit(once):
    """The folder of the teacher's kit, made from the built book."""
    from kit.__main__ import ROOT, build

    built = ROOT / "_build/html/book"
    assert (built / "teaching.html").exists(), "no built book in _build/html: run `make book` first"
    return once("kit", lambda folder: build(folder, built))


@pytest.fixture
def outputs(monkeypatch):
    """A function: the list of what a module displays from now on, as markup where it is that."""

    def outputs(module):
        items = []

        def display(*more):
            items.extend(getattr(item, "data", item) for item in more)

        monkeypatch.setattr(module, "display", display)
        return items

    return outputs


@pytest.fixture(scope="session")
def chromium():
    """A headless browser; without one the test is skipped, in continuous integration it fails."""
    from tools import browser

    if not browser.find():
        (pytest.fail if os.environ.get("CI") else pytest.skip)(browser.MISSING)
    with browser.launch(*LIGHT) as chromium:
        chromium.new_context = partial(pages.patient, chromium.new_context)
        yield chromium


@pytest.fixture(scope="module")
def offline(chromium):
    """A browser window with the network off."""
    context = chromium.new_context(offline=True, viewport={"width": 1200, "height": 900})
    yield context
    context.close()


@pytest.fixture
def window(chromium):
    """A function that opens a browser window of its own kind, offline, after a script if given."""
    windows = []

    def window(script="", **kind):
        windows.append(chromium.new_context(offline=True, **kind))
        windows[-1].add_init_script(script)
        return windows[-1]

    yield window
    for each in windows:
        each.close()


@pytest.fixture(scope="module", params=ENGINES)
def engine(request, tmp_path_factory):
    """Another browser than Chromium; where there is none the test is skipped."""
    if not request.param.program():
        pytest.skip(NOT_TESTED.format(request.param.__name__))
    engine = request.param(tmp_path_factory.mktemp("engine"))
    yield engine
    engine.close()


@pytest.fixture(scope="session")
def site(tmp_path_factory):
    """A folder with the book's styles, and its script."""
    folder = tmp_path_factory.mktemp("site")
    for static in pages.STATIC:
        shutil.copytree(static, folder, dirs_exist_ok=True)
    script = page_script(f"book/{pages.SCRIPT}")
    (folder / pages.SCRIPT).write_text(script, encoding="utf-8")
    return folder


@pytest.fixture
def open_page(offline, site):
    """A function that opens some HTML as a page with the book's scripts, which may not complain."""
    opened = []

    def open_page(html, window=offline):
        opened.append(pages.open_html(window, site, html))
        return opened[-1]

    yield open_page
    for page in opened:
        page.close()
        assert page.errors == page.failed == []


@pytest.fixture(scope="session")
def serious():
    """A function: what axe-core finds serious in part of a page, [(theme, rule, markup)].

    With `all_of_it`, what it finds less than serious too.
    """

    def violations(page, within, all_of_it=False):
        # Colours that are still on their way to a theme are nobody's contrast
        page.add_style_tag(content="* { transition: none !important }")
        page.evaluate("() => scrollTo(0, 0)")  # lest the sticky header covers a target
        page.mouse.move(0, 0)  # nor does it point at a link
        if not page.evaluate("() => 'axe' in window"):
            page.evaluate(pages.AXE)
        return [
            (theme, violation["id"], node["html"][:200])
            for theme, options in RULES.items()
            for violation in page.evaluate(AXE_RUN, [within, theme, options])
            if all_of_it or violation["impact"] in ("serious", "critical")
            for node in violation["nodes"]
        ]

    return violations
