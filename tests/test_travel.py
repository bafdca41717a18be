"""Demos that travel: one file each, offline, as light as promised; and their SCORM packages."""

import io
import re
from statistics import median
from xml.etree import ElementTree
from zipfile import ZipFile

import pytest

from kit import demos, scorm
from page.bundle import import_order
from tests.pages import BUILT, open_url
from vmc_lib.show.packed import pack_bytes

pytestmark = pytest.mark.browser


@pytest.fixture(scope="session")
def folder(kit):
    return kit / "demos"


@pytest.fixture(scope="session")
def files(folder):
    """The heaviest file of each kind: its scripts, what it has packed, and whether it has a pad."""
    kinds = {}
    for path in sorted(folder.glob("figure-*.html"), key=lambda path: path.stat().st_size):
        text = path.read_text(encoding="utf-8")
        inside = re.findall(r'<script type="application/gzip" id="([^"]+)"', text)
        mode = re.search('data-mode="[^"]+"', text)
        kinds[*inside, text.count("<script>"), "vmc-pad" in text, mode and mode[0]] = path
    return list(kinds.values())


@pytest.fixture(scope="session")
def slider(files):
    """A file with a slider whose states are stored, and a prediction."""
    marks = 'type="range"[^>]*data-stride', 'class="vmc-predict"'
    return next(
        path
        for path in files
        if all(re.search(mark, path.read_text(encoding="utf-8")) for mark in marks)
    )


def test_every_demo_that_moves_is_a_light_file_with_its_source(folder):
    moving = r'class="vmc-(?:live|segmentation)"|<script type="application/gzip">'
    figures = [
        figure
        for page in sorted((BUILT / "book").glob("[0-9]*.html"))
        for figure in demos.FIGURE.findall(page.read_text(encoding="utf-8"))
        if re.search(moving, figure)
    ]
    files = sorted(folder.glob("figure-*.html"))
    assert len(files) == len(figures) > 50
    sizes = [path.stat().st_size for path in files]
    asked = [path for path in files if "vmc-predict" in path.read_text(encoding="utf-8")]
    assert len(asked) > 0.7 * len(files)
    assert median(sizes) <= 0.5e6
    assert max(sizes) <= 5e6
    index = (folder / "index.html").read_text(encoding="utf-8")
    for path in files:
        text = path.read_text(encoding="utf-8")
        assert text.count("<figure") == text.count("<figcaption") == text.count("<h1>") == 1
        assert re.search(r"<footer>From <cite>.+CC BY 4\.0.+BSD 3-Clause", text)
        assert 'aria-label="' in text or 'alt="' in text
        assert f'src="{path.name}"' in index.replace("&quot;", '"')
        assert (folder / path.name.replace(".html", ".zip")).exists()


def test_a_question_between_two_demos_goes_with_the_lower_one():
    figure = '<figure class="vmc-demo"><script type="application/gzip"></script>Figure {}</span>'
    first, second = (f"{figure.format(number)}</figure>" for number in ("1.1", "1.2"))
    asked = '<div class="admonition tip"><fieldset class="vmc-predict"></fieldset></div>'
    heads = [f'<{h}>Arm<a class="headerlink"></a></{h}>' for h in ("h1", "h2")]
    for page, wanted in ((first + asked, [True]), (first + asked + second, [False, True])):
        _, found = demos.read(page.join(heads))
        assert ["vmc-predict" in html for _, html in found.values()] == wanted


def test_a_figure_takes_the_modules_that_it_needs():
    state = pack_bytes(b'{"lines": []}')
    plot = f'<figure class="vmc-demo"><script type="application/gzip">{state}</script></figure>'
    work = plot.replace(state, pack_bytes(b'{"work":"plan"}'))
    plain = set(import_order(demos.entries(plot)))
    assert {"vendored.js", "demo/address.js", "demo/handle.js", "demo/demo.js"} <= plain
    assert not [name for name in plain if re.match("arm|book|eye|python|demos", name)]
    more = set(import_order(demos.entries(work))) - plain
    assert {"demos/plan.js", "arm/planning.js", "eye/camera.js"} <= more


FIGURE = "document.querySelector('figure')"


def test_files_open_offline_read_well_in_both_themes_and_start_their_arms(files, offline, serious):
    assert len(files) > 5
    arms = [path for path in files if path.stat().st_size > 3e6]
    assert len(arms) > 1
    for path in files:
        page = open_url(offline, path.as_uri())
        if page.locator(".vmc-scene").count():
            page.wait_for_selector(".vmc-scene :is(canvas, .vmc-note)")
            assert page.locator(".vmc-scene .vmc-note").all_inner_texts() == []
        if "\\(" in page.inner_text("main"):
            page.wait_for_selector("main math")
        if slider := page.query_selector("input[id][type=range]:not(fieldset[disabled] *)"):
            seen = page.inner_html("figure")
            slider.press("Home" if slider.input_value() == slider.get_attribute("max") else "End")
            page.wait_for_function(f"seen => {FIGURE}.innerHTML !== seen", arg=seen)
        assert serious(page, "body") == [], path.name
        if path in arms:
            page.locator("[name=main]").click()
            page.wait_for_selector("[name=main]:text-matches('Pause|Reach')")
            page.get_by_text(re.compile("is running|misses by")).first.wait_for()
        assert page.errors == page.failed == [], path.name
        assert [url for url in page.asked if not url.startswith(("file:", "data:", "blob:"))] == []
        page.close()


def test_colours_follow_the_readers_system(files, window):
    page = open_url(window(color_scheme="dark"), files[0].as_uri())
    theme = "document.documentElement.dataset.theme"
    assert page.evaluate(theme) == "dark"
    page.emulate_media(color_scheme="light")
    page.wait_for_function(f"() => {theme} === 'light'")  # no text is evaluated under a policy


def test_an_address_opens_a_demo_where_its_link_was_taken(slider, offline):
    page = open_url(offline, slider.as_uri())
    page.locator("[data-stride][type=range]").first.press("End")
    link = page.get_attribute(".vmc-link", "href")
    pictures = page.inner_html(".vmc-pictures")
    page.close()
    page = open_url(offline, f"{slider.as_uri()}{link}")
    assert page.inner_html(".vmc-pictures") == pictures
    page.close()


# ---- SCORM 1.2 ----

CP, ADL = (
    "{http://www.imsproject.org/xsd/imscp_rootv1p1p2}",
    "{http://www.adlnet.org/xsd/adlcp_rootv1p2}",
)


def unzip(data):
    zipped = ZipFile(io.BytesIO(data))
    return {name: zipped.read(name).decode() for name in zipped.namelist()}


def test_a_package_has_the_manifest_that_the_standard_asks_for():
    files = unzip(scorm.package("figure-1-1", "<A> & B", "<p>Page</html>"))
    assert scorm.package("a", "A", "") == scorm.package("a", "A", "")
    assert re.match(
        r"<meta [^>]+Content-Security-Policy[^>]+>\s*<p>Page<script>", files["index.html"]
    )
    manifest = ElementTree.fromstring(files["imsmanifest.xml"])  # noqa: S314 (our own)
    assert manifest.tag == f"{CP}manifest"
    assert re.fullmatch(r"[A-Za-z_][\w.-]*", manifest.get("identifier"))
    metadata, organizations, resources = manifest
    assert [(part.tag, part.text) for part in metadata] == [
        (f"{CP}schema", "ADL SCORM"),
        (f"{CP}schemaversion", "1.2"),
    ]
    [organization] = organizations
    assert organizations.get("default") == organization.get("identifier")
    title, item = organization
    assert [title.text, *(part.text for part in item)] == ["<A> & B"] * 2
    [resource] = resources
    assert item.get("identifierref") == resource.get("identifier")
    assert (resource.get("type"), resource.get(f"{ADL}scormtype")) == ("webcontent", "sco")
    [file] = resource
    assert file.get("href") == resource.get("href") == "index.html"


PLATFORM = """<!doctype html><script>
const calls = [], kept = { "cmi.core.lesson_status": "not attempted" };
var API = {
  LMSInitialize: (none) => (calls.push(["Initialize", none]), "true"),
  LMSGetValue: (key) => kept[key] ?? "",
  LMSSetValue: (key, value) => (calls.push(["SetValue", key, value]), (kept[key] = value), "true"),
  LMSCommit: (none) => (calls.push(["Commit", none]), "true"),
  LMSFinish: (none) => (calls.push(["Finish", none]), "true"),
};
</script><iframe src="/index.html" width="900" height="700"></iframe>"""


def on_platform(reader, package):
    """A platform's page that shows the index of a package, its bytes."""
    index = unzip(package)["index.html"]
    reader.route("http://lms/**", lambda route: route.fulfill(body=index, content_type="text/html"))
    reader.route(
        "http://lms/", lambda route: route.fulfill(body=PLATFORM, content_type="text/html")
    )
    return open_url(reader, "http://lms/")


def test_a_platform_hears_of_a_prediction_then_of_a_move_and_of_the_end(slider, window):
    page = on_platform(window(), slider.with_suffix(".zip").read_bytes())
    demo = page.frame_locator("iframe").locator("[data-ready]")
    demo.wait_for()

    def told(state, score):
        values = {"lesson_status": state, "score.min": "0", "score.max": "100", "score.raw": score}
        sent = [["SetValue", f"cmi.core.{name}", value] for name, value in values.items()]
        return [*sent, ["Commit", ""]]

    def move():
        for end in ("Home", "End"):  # wherever it starts, one of them moves it
            demo.locator("input[type=range]").first.press(end)

    begun = [["Initialize", ""], *told("incomplete", "0")]
    move()
    assert page.evaluate("calls") == begun  # who has not predicted has not looked
    page.frame_locator("iframe").locator(".vmc-predict input").last.check()
    assert page.evaluate("calls") == [*begun, *told("incomplete", "50")]
    move()
    moved = [*begun, *told("incomplete", "50"), *told("completed", "100")]
    assert page.evaluate("calls") == moved
    page.evaluate("document.querySelector('iframe').remove()")
    assert page.evaluate("calls") == [*moved, ["Finish", ""]]
    assert page.errors == []


ASKS_AND_MOVES = """<form class="vmc-predict"><input type="radio"></form><input type="range">"""


def test_a_later_visit_goes_on_from_the_score_that_was_kept(window):
    page = on_platform(window(), scorm.package("a", "A", f"{ASKS_AND_MOVES}</html>"))

    def kept_in_a_later_visit():
        page.frames[1].goto("http://lms/index.html")
        return page.evaluate(
            "['lesson_status', 'score.raw'].map((name) => kept[`cmi.core.${name}`])"
        )

    page.frames[1].check("[type=radio]")
    assert kept_in_a_later_visit() == ["incomplete", "50"]
    page.frames[1].press("[type=range]", "Home")
    assert kept_in_a_later_visit() == ["completed", "100"]
    assert page.errors == []


def test_a_package_is_silent_without_a_platform(slider, offline, tmp_path):
    index = unzip(slider.with_suffix(".zip").read_bytes())["index.html"]
    (tmp_path / "index.html").write_text(index, encoding="utf-8")
    (tmp_path / "frame.html").write_text('<iframe src="index.html"></iframe>', encoding="utf-8")
    page = open_url(
        offline, (tmp_path / "frame.html").as_uri()
    )  # of a folder's files none may look into another
    page.frame_locator("iframe").locator("[data-ready]").wait_for()
    assert page.errors == []
    page.close()
