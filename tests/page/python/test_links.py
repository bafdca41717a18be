"""A link's lines and a worker's answers are data: none runs before its reader runs it."""

import json
from urllib.parse import quote, unquote, urlsplit

import pytest
from playwright.sync_api import expect

from book._ext.policy import seal
from tests import pages
from tests.page.python.conftest import PATIENT
from tests.page.python.test_editor import RIGHT_LINES
from tests.page.python.test_laws import DEMO, FOLDED
from vmc_lib.show import demo

pytestmark = pytest.mark.browser
LAW = "def law(x):\n    return 2 * x"
EVIL = f"np = None  # which the exercise below needs\n{LAW}"
OWN = f"{LAW}  # an hour's work"
KEPT = "() => JSON.stringify(localStorage)"
GO = "(link) => { location.hash = link }"
REACH = """fetch XMLHttpRequest WebSocket WebTransport EventSource BroadcastChannel importScripts
Worker SharedWorker indexedDB IDBFactory caches CacheStorage navigator postMessage""".split()
# What a reader's lines may do to the worker's own answers
FORGE = """import js
js.eval(r'''const { postMessage } = MessagePort.prototype;
MessagePort.prototype.postMessage = function () { postMessage.call(this, { value: %s }); };''')"""
MARKUP = '<img src="x" onerror="window.harm = 1"><script>window.harm = 1</script>'
FORGED = "Object.assign([{0}, {0}], {{ error: {0} }})".format(json.dumps(MARKUP))  # to any question


@pytest.fixture(scope="module")
def html(exercise_html):
    """A chapter of a law, an exercise below it, and a demo that follows the law."""
    with pytest.MonkeyPatch.context() as patch:
        shown = pages.displayed(patch, demo)
        patch.setenv("VMC_RENDER_MODE", "book")
        exec(f"{LAW}\n{DEMO}", {})  # noqa: S102
    cell = f'<div class="cell_input"><pre>{DEMO}</pre></div>{shown[0].data}'
    demo_cell = f'<div class="cell tag_draws-in-page">{cell}</div>'
    imports, end, rest = exercise_html.partition("</pre></div></div>")
    return f"{imports}{end}{FOLDED.format(LAW)}{rest}{demo_cell}"


@pytest.fixture(params=["file", pytest.param("http", marks=pytest.mark.audit)])
def chapter(request, window, site, html):
    """A function that opens the chapter, with what stands after a # in its address."""
    (site / "links.html").write_text(seal(pages.HEAD + html), encoding="utf-8")
    reader = window()
    served = []

    def serve(route):
        served.append(unquote(urlsplit(route.request.url).path)[1:])
        route.fulfill(path=site / served[-1])

    reader.route("http://book/**", serve)
    address = "http://book" if request.param == "http" else site.as_uri()
    opened = []

    def chapter(after=""):
        """The page, and what the host was asked for, `served`."""
        page = pages.open_url(reader, f"{address}/links.html{after}")
        page.evaluate(PATIENT)
        page.mine = page.get_by_label("Your lines: law")
        page.line = page.locator(".vmc-law [role=status]")
        page.beside = page.locator(".vmc-beside:has(p)")
        page.said = page.locator("form[data-function] [role=status]")
        page.served = served
        opened.append(page)
        return page

    yield chapter
    assert [error for page in opened for error in page.errors] == []


def link(page, lines, name="law"):
    return f"#{page.locator('.vmc-demo').get_attribute('id')}?law.{name}={quote(lines)}"


def check(page):
    page.get_by_label("Your lines: activation_rates").fill(RIGHT_LINES)
    page.get_by_role("button", name="Check").click()


def run(page, lines=None):
    if lines is not None:
        page.mine.fill(lines)
    page.get_by_role("button", name="Run", exact=True).click()
    expect(page.locator("form[data-cell=law] [role=status]")).to_contain_text("✓ It runs.")


def test_what_a_link_planted_never_runs(chapter):
    """It is opened and closed; later an exercise below is checked."""
    first = chapter()
    brought = link(first, EVIL)
    kept = first.evaluate(KEPT)
    page = chapter(brought)
    expect(page.line).to_contain_text("This link brings another law.")
    expect(page.beside.locator("pre")).to_have_text(EVIL)
    assert page.mine.input_value() == LAW
    page.wait_for_load_state("networkidle")
    assert not any("vendor/python" in url for url in page.asked)
    check(page)  # with the link's lines beside it, too
    expect(page.said).to_contain_text("✓ Right.")
    page.close()
    later = chapter()
    assert later.mine.count() == 0
    assert "np = None" not in later.evaluate(KEPT)
    check(later)
    expect(later.said).to_contain_text("✓ Right.")
    assert kept == "{}"
    later.evaluate(GO, brought)
    later.get_by_role("button", name="Take it").click()
    check(later)
    expect(later.said).to_contain_text("✓ Right.")
    run(later)  # the reader's own, from now on
    check(later)
    expect(later.said).to_contain_text("NoneType")


def test_the_readers_own_lines_stay_beside_a_links(chapter):
    page = chapter()
    brought = link(page, LAW.replace("2 *", "5 *"))
    page.get_by_role("button", name="Edit law").click()
    run(page, OWN)
    kept = page.evaluate(KEPT)
    page.close()
    page = chapter(brought)
    assert page.mine.input_value() == OWN
    page.get_by_role("button", name="Take it").click()
    expect(page.mine).to_have_value(LAW.replace("2 *", "5 *"))
    assert page.evaluate(KEPT) == kept
    run(page)
    page.close()
    page = chapter()
    expect(page.beside).to_contain_text("Your own lines:")
    page.get_by_role("button", name="Take them back").click()
    expect(page.mine).to_have_value(OWN)
    expect(page.beside.locator("pre")).to_have_text(LAW.replace("2 *", "5 *"))
    page.get_by_role("button", name="Forget them").click()
    expect(page.beside).to_have_count(0)
    page.evaluate(GO, brought)
    page.get_by_role("button", name="Keep mine").click()
    expect(page.mine).to_have_value(OWN)
    expect(page.beside).to_have_count(0)


def own_lines(page):
    """Every text that the page keeps for the reader's law, in its field and beside it."""
    kept = page.evaluate("() => Object.values(localStorage).map((one) => JSON.parse(one))")
    return {lines for one in kept for lines in (one["typed"], *one["mine"])}


def test_no_number_of_links_takes_the_readers_lines(chapter):
    """What was made of a link's lines is the reader's as well; *Keep mine* forgets none."""
    page = chapter()
    page.get_by_role("button", name="Edit law").click()
    page.mine.fill(OWN)
    wanted = [OWN]
    for factor in (5, 6):
        brought = LAW.replace("2 *", f"{factor} *")
        page.evaluate(GO, link(page, brought))
        page.get_by_role("button", name="Take it").click()
        wanted.append(f"{brought}  # tried")
        page.mine.fill(wanted[-1])
    page.evaluate(GO, link(page, OWN))
    page.get_by_role("button", name="Keep mine").click()
    assert own_lines(page) == {*wanted}
    page.close()
    page = chapter()
    assert own_lines(page) == {*wanted}
    expect(page.beside.locator("pre")).to_have_text([OWN, wanted[1]])
    page.get_by_role("button", name="Forget them").first.click()
    assert own_lines(page) == {*wanted[1:]}


def test_lines_of_another_tab_stay(chapter):
    first = chapter()
    first.get_by_role("button", name="Edit law").click()
    first.mine.fill(OWN)
    second = chapter(link(first, EVIL))
    newer = f"{OWN}, and another"
    first.mine.fill(newer)
    second.get_by_role("button", name="Take it").click()
    second.mine.fill(f"{EVIL}  # tried")
    assert own_lines(second) == {OWN, newer, f"{EVIL}  # tried"}


def test_a_link_too_long_for_a_cell_brings_nothing(chapter):
    page = chapter()
    page.evaluate(GO, link(page, f"{LAW}{' ' * 20_000}# long"))
    expect(page.line).to_have_text("This link’s lines are too long for a cell: none is taken.")
    expect(page.get_by_role("button", name="Run it")).to_be_hidden()
    assert page.mine.count() == 0


def test_where_the_browser_keeps_nothing_more_it_says_so(chapter):
    page = chapter()
    page.evaluate("() => { localStorage.full = 'x'.repeat(5 * 2 ** 20 - 200) }")
    page.get_by_label("Your lines: activation_rates").fill("#" * 1000)
    expect(page.said).to_contain_text("This browser has no room for your lines: copy them")


def test_whatever_its_line_ends_what_a_link_brings_is_not_kept(chapter):
    page = chapter()
    page.evaluate(GO, link(page, EVIL.replace("\n", "\r\n")))
    page.get_by_role("button", name="Take it").click()
    expect(page.mine).to_have_value(EVIL)
    assert page.evaluate(KEPT) == "{}"


def test_another_links_lines_are_not_run_by_an_earlier_links_button(chapter):
    page = chapter()
    page.evaluate(GO, link(page, EVIL))
    expect(page.get_by_role("button", name="Run it")).to_be_visible()
    page.evaluate(GO, f"#another?law.law={quote(OWN)}")
    expect(page.beside.locator("pre")).to_have_text(OWN)
    expect(page.get_by_role("button", name="Run it")).to_be_hidden()


@pytest.mark.parametrize("odd", [5, [{"toString": 1}]])
def test_what_others_wrote_into_the_readers_place_stops_nothing(chapter, odd):
    page = chapter()
    page.evaluate(
        """(odd) => {
          const kept = JSON.stringify({ typed: "a", ran: odd, said: odd, judged: odd, mine: odd });
          for (const { dataset: { cell, function: name } } of document.forms)
            localStorage[`${location.pathname} ${cell ?? name}`] = kept;
          localStorage.vmcRecord = JSON.stringify([{ kind: "quiz", question: odd }, odd]);
        }""",
        odd,
    )
    page.reload()
    check(page)
    expect(page.said).to_contain_text("✓ Right.")
    expect(page.mine).to_have_value(LAW)


def test_only_its_page_sends_the_frame_code(chapter):
    """Neither one that shows the book in a frame nor one that opened it."""
    page = chapter()
    with page.expect_popup() as popup:
        page.evaluate("() => { window.other = open(location.href) }")
    other = popup.value
    other.wait_for_load_state("load")
    other.evaluate(PATIENT)
    with other.expect_event("frameattached"):
        other.evaluate("() => { vmc['python/interpreter'].start() }")
    page.evaluate("""() => {
      const code = "onmessage = ({ ports: [port] }) => port.postMessage(1)";
      const { port1, port2 } = new MessageChannel();
      port1.onmessage = () => { window.harm = 1 };
      other.frames[0].postMessage(code, "*", [port2]);
    }""")
    other.get_by_label("Your lines: activation_rates").fill(RIGHT_LINES)
    other.get_by_role("button", name="Check").click()
    expect(other.locator("form[data-function] [role=status]")).to_contain_text("✓ Right.")
    assert page.evaluate("() => window.harm") is None


def test_a_law_that_no_cell_has_is_named(chapter):
    page = chapter()
    page.evaluate(GO, link(page, "1", "<b>`nope` $x$</b>"))
    expect(page.line.locator("code")).to_have_text("<b>nope $x$</b>")
    expect(page.line).to_have_text(
        "This link brings a law for <b>nope $x$</b>; no cell of this page defines it."
    )
    expect(page.get_by_role("button", name="Run it")).to_be_hidden()


def test_the_books_own_cell_is_not_kept_and_a_new_edition_is_told(chapter):
    page = chapter()
    page.get_by_role("button", name="Edit law").click()
    run(page)
    assert page.evaluate(KEPT) == "{}"
    run(page, OWN)
    page.evaluate("""() => {
      const [key] = Object.keys(localStorage), kept = JSON.parse(localStorage[key]);
      const changed = { typed: `${kept.typed}!`, ran: "np = None", book: 1 };
      localStorage[key] = JSON.stringify({ ...kept, ...changed });
    }""")
    page.reload()
    expect(page.beside).to_contain_text("The book’s cell has changed since you wrote yours.")
    check(page)  # by the book's until the reader says
    expect(page.said).to_contain_text("✓ Right.")
    page.get_by_role("button", name="Take it").click()
    expect(page.mine).to_have_value(LAW)
    expect(page.beside.locator("pre")).to_have_text(f"{OWN}!")


def test_a_verdict_is_of_the_lines_that_were_checked(chapter):
    page = chapter()
    check(page)
    expect(page.said).to_have_text("✓ Right.")
    lines = page.get_by_label("Your lines: activation_rates")
    lines.press_sequentially(" ")
    before = "(said) => getComputedStyle(said, '::before').content"
    assert "earlier lines" in page.said.evaluate(before)
    page.reload()
    assert "earlier lines" in page.said.evaluate(before)
    lines.fill(RIGHT_LINES)
    assert page.said.evaluate(before) == "none"


def test_an_answer_with_markup_stays_text(chapter):
    page = chapter()
    lines = page.get_by_label("Your lines: activation_rates")
    lines.fill(FORGE % FORGED)
    page.get_by_role("button", name="Check").click()
    expect(page.said).to_contain_text("<script>")
    page.evaluate("() => { vmc['python/interpreter'].stop(); }")
    page.get_by_role("button", name="Edit law").click()
    page.mine.fill(f"{FORGE % FORGED}\n{LAW}")
    page.get_by_role("button", name="Run", exact=True).click()
    expect(page.line).to_contain_text("<script>window.harm = 1</script> stops:")
    assert page.locator("img, .vmc-law script, form script").count() == 0
    assert page.evaluate("() => window.harm") is None


def test_the_workers_python_reaches_nothing(chapter):
    """Neither by name nor, over HTTP, by an import, which no name holds."""
    page = chapter()
    lines = page.get_by_label("Your lines: activation_rates")
    tries = "js.eval('import(\"http://book/secret.js\").catch(String)')"
    lines.fill(f"import js\n{tries}\n[name for name in {REACH} if hasattr(js, name)], js.origin")
    page.get_by_role("button", name="Check").click()
    expect(page.said.locator("pre")).to_have_text("([], 'null')")
    assert "secret.js" not in page.served
    page.errors = [error for error in page.errors if "secret.js" not in error]  # refused, and said
