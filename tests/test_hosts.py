"""Chapters from hosts that forbid, rewrite or frame, and in a browser that stores nothing."""

from urllib.parse import quote, unquote, urlsplit

import pytest

from book._ext.policy import frame_script, hash_source
from tests.pages import BUILT, FILL, ROOT, open_url
from tests.project import sample

pytestmark = pytest.mark.browser
ASK = "() => vmc['python/interpreter'].ask(['grader', 'run', [], '6 * 7'], () => {})"
POLICY = (
    "default-src 'self'; script-src 'self'{}; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; font-src 'self' data:; connect-src 'none'; worker-src blob:"
)


@pytest.fixture
def under_policy(window):
    """A function that opens a chapter of a host with a strict policy, as README states it."""

    def open_chapter(name, allowed):
        def serve(route):
            path = BUILT / unquote(urlsplit(route.request.url).path).lstrip("/")
            headers = {"Content-Security-Policy": POLICY.format(allowed)}
            route.fulfill(path=path, headers=headers)

        reader = window(reduced_motion="reduce")
        reader.route("http://book/**", serve)
        return open_url(reader, f"http://book/book/{name}.html")

    return open_chapter


@pytest.mark.parametrize(
    ("allowed", "said"),
    [
        (" 'unsafe-eval'", "The arm is running"),
        pytest.param(
            " 'wasm-unsafe-eval'", "The page's host forbids the physics", marks=pytest.mark.audit
        ),
        ("", "The page's host forbids the physics"),
    ],
)
def test_a_host_may_forbid_inline_scripts(under_policy, allowed, said):
    page = under_policy("08_arm", allowed)
    assert page.locator(".katex").count() > 5
    assert page.locator(".vmc-demo[data-ready]").count() > 2
    page.locator(".vmc-scene").first.scroll_into_view_if_needed()
    page.wait_for_selector(".vmc-scene canvas")
    page.locator("[name=main]").first.click()
    page.get_by_text(said).first.wait_for()
    assert all("Content Security Policy" in error for error in page.errors)


def test_a_host_allows_python_by_the_policy_that_readme_states(under_policy):
    frame = hash_source(frame_script())
    assert frame in (ROOT / "README.md").read_text(encoding="utf-8")
    page = under_policy("08_arm", f" 'unsafe-eval' {frame}")
    page.evaluate("() => { vmc['python/interpreter'].limit.seconds = 1000 }")
    assert page.evaluate(ASK)[1] == "42\n"


def test_a_host_that_forbids_python_is_named(under_policy):
    page = under_policy("08_arm", " 'unsafe-eval'")
    page.evaluate("() => { vmc['python/interpreter'].limit.opening = 1 }")
    assert "host forbids Python" in page.evaluate(f"{ASK}.catch((error) => error.message)")


COURSE = "/~ann/a b+c/"
ADDRESS = f"http://book{quote(COURSE)}book/08_arm"
FRAME = f'<iframe sandbox="allow-scripts" width="900" height="700" src="{ADDRESS}"></iframe>'


@pytest.mark.parametrize("address", sample([ADDRESS, "http://site/", "file:"], "http://site/"))
def test_a_chapter_plays_wherever_it_lies(window, address, tmp_path):
    """In a sub-folder, without its ending; in a frame that may store nothing; in an odd folder."""
    (folder := tmp_path / "a b&c#d+ü%41").mkdir()
    (folder / "html").symlink_to(BUILT)
    address = address.replace("file:", (folder / "html/book/08_arm.html").as_uri())

    def serve(route):
        path = BUILT / unquote(urlsplit(route.request.url).path).removeprefix(COURSE)
        route.fulfill(path=path if path.suffix else path.with_suffix(".html"))

    reader = window(reduced_motion="reduce")
    reader.route("http://book/**", serve)
    reader.route("http://site/", lambda route: route.fulfill(body=FRAME, content_type="text/html"))
    page = open_url(reader, address)
    chapter = page.frame_locator("iframe") if "site" in address else page
    chapter.locator("[name=main]").first.click()
    chapter.get_by_text("The arm is running").first.wait_for()
    demo = chapter.locator(".vmc-demo[data-ready]:has([data-stride][type=range])").first
    before = demo.locator("output").first.inner_text()
    demo.locator("[data-stride][type=range]").first.press("End")
    assert demo.locator("output").first.inner_text() != before
    assert page.errors == page.failed == []


NO = "Object.defineProperty(self, '{}', {{ configurable: true, get() {{ throw Error() }} }});"
FORBIDDEN = "".join(map(NO.format, ("localStorage", "sessionStorage")))


@pytest.mark.parametrize("script", [FORBIDDEN, f"({FILL})()"], ids=["forbidden", "full"])
def test_colours_change_where_nothing_can_be_stored(window, script):
    page = open_url(window(script), (BUILT / "book/07_muscle.html").as_uri())
    button = page.locator(".theme-switch-button").first
    seen = []
    for _ in range(3):
        button.click()
        seen.append(page.evaluate("() => document.documentElement.dataset.theme"))
    assert {"light", "dark"} <= set(seen)
    assert page.errors == []
