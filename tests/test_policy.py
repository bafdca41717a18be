"""Each page's content security policy: the scripts that it was built with, and nothing beyond."""

from io import BytesIO
from zipfile import ZipFile

import pytest

from book._ext.policy import META, hash_source, seal
from kit import scorm
from kit.class_pages import class_page, throws_page
from tests.pages import BUILT, open_html

HEAD = '<!doctype html><meta charset="utf-8"><title>A page</title>'
ALERT = "<script>document.title = 'run'</script>"
BUILT_PAGES = [path for path in BUILT.rglob("*.html") if "_static" not in path.parts]
START = META.format("").split('"">')[0]


def policy_of(page):
    """A page's policy as {directive: its sources}."""
    text = page.split(START + '"')[1].split('"')[0]
    return {name: rest for name, *rest in (part.split() for part in text.split(";"))}


def test_a_page_may_run_what_stands_in_it_and_load_files_only_if_it_names_some():
    bare = policy_of(seal(HEAD))
    assert bare["default-src"] == bare["script-src"] == bare["base-uri"] == ["'none'"]
    script = ALERT.removeprefix("<script>").removesuffix("</script>")
    assert policy_of(seal(HEAD + ALERT))["script-src"] == [hash_source(script)]
    loads = policy_of(seal(HEAD + '<script src="a.js"></script><p onclick="a(&quot;b&quot;)">'))
    assert loads["script-src"] == ["'self'", "'unsafe-hashes'", hash_source('a("b")')]


@pytest.mark.parametrize(
    ("part", "evaluates"),
    [('class="vmc-live"', True), ('data-function="f"', True), ('class="vmc-demo"', False)],
)
def test_text_becomes_code_only_for_the_physics_and_python(part, evaluates):
    assert ("'unsafe-eval'" in policy_of(seal(f"{HEAD}<p {part}>"))["script-src"]) == evaluates


def test_a_sealed_page_is_sealed_again_by_what_it_holds_now():
    once = seal(HEAD)
    assert seal(once) == once
    assert seal(once + ALERT) == seal(HEAD + ALERT)


def test_every_built_page_has_the_policy_of_what_it_holds():
    pages = {path: path.read_text(encoding="utf-8") for path in BUILT_PAGES}
    assert [path for path, page in pages.items() if page != seal(page)] == []
    for page in pages.values():
        assert {"connect-src", "frame-src", "object-src"}.isdisjoint(policy_of(page))  # so 'none'
        assert not any("http" in source for all_of in policy_of(page).values() for source in all_of)


def test_the_kits_pages_have_theirs():
    with ZipFile(BytesIO(scorm.package("a", "A", f"{HEAD}</html>"))) as package:
        packaged = package.read("index.html").decode()
    for page in (packaged, class_page(), throws_page()):
        assert policy_of(page)["script-src"] != ["'none'"]


@pytest.mark.browser
def test_what_enters_a_page_later_does_not_run(offline, site):
    page = open_html(offline, site, f"<h1>A</h1>{ALERT}<p id='place'></p>")
    assert page.title() == "run"
    page.evaluate("""() => {
      document.title = "";
      place.innerHTML = '<img src="x" onerror="document.title = 1">';
      const script = document.createElement("script");
      script.text = "document.title = 2";
      document.body.append(script);
    }""")
    page.wait_for_load_state("networkidle")
    assert page.title() == ""
    page.close()
