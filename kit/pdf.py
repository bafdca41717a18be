"""The whole book as one PDF, _build/book.pdf: `make pdf`.

Each built page is opened in a browser and stands still (still.js); joined to one page, all are
printed. What the pages fold, the answers and the solutions, is the appendix: the kit's key.
"""

from html import escape
from pathlib import Path
from tempfile import TemporaryDirectory

import yaml
from bs4 import BeautifulSoup

from kit.__main__ import write_texts
from tools import browser

ROOT = Path(__file__).parents[1]
PATIENCE = 600_000  # ms: ends a hang, never a slow machine's work
READY = """() => document.readyState === "complete" &&
  !document.querySelector(".vmc-demo:has(> script):not([data-ready])")"""
SHEETS = "[...document.querySelectorAll('link[rel=stylesheet]')].map(({ href }) => href)"
FOOT = '<p class="pageNumber" style="width: 100%; font-size: 8px; text-align: center"></p>'
STYLE = """<style>
article { break-before: page; }
/* A bookmark joins a heading's lines without a space, and says twice what sticks out of its page */
.bd-content :is(h1, h2, h3) { line-height: 1.6; }
.bd-content h1 { font-size: 1.8rem; }
.bd-content h2 { font-size: 1.4rem; }
.bd-content h3 { font-size: 1.15rem; }
figure { break-inside: avoid; }
figure.vmc-demo:has(> .vmc-demo + .vmc-demo) { break-inside: auto; }
figcaption { break-before: avoid; }
.vmc-scene { height: 18rem; }
.vmc-picture svg, .vmc-picture img { max-height: 24rem; }
</style>"""


def names():
    """The pages of the book in the order of its table of contents."""

    def files(entry):
        yield from [entry["file"]] if "file" in entry else []
        for below in entry.get("parts", []) + entry.get("chapters", []) + entry.get("sections", []):
            yield from files(below)

    toc = yaml.safe_load((ROOT / "_toc.yml").read_bytes())
    return [toc["root"], *files(toc)]


def print_book(chromium, html, names, path, key=None):
    """Print the pages `names` of the built book in the folder `html` as one PDF, to `path`.

    The page `key`, if there is one, is the appendix.
    """
    context = chromium.new_context(offline=True, viewport={"width": 900, "height": 1200})
    context.set_default_timeout(PATIENCE)
    page = context.new_page()
    articles, sheets = [], {}  # a page has those styles alone that it needs
    for name in names:
        articles.append(_still(page, html, name))
        sheets |= dict.fromkeys(page.evaluate(SHEETS))
    if key:
        page.goto(key.as_uri())
        articles.append(f"<article><h1>Answers</h1>{page.inner_html('body')}</article>")
    head = BeautifulSoup((html / f"{names[0]}.html").read_text(encoding="utf-8"), "html.parser")
    styles = "".join(f'<link rel="stylesheet" href="{escape(sheet)}">' for sheet in sheets)
    with TemporaryDirectory() as folder:
        whole = Path(folder) / "book.html"
        whole.write_text(
            f'<!doctype html><html lang="en" data-theme="light"><meta charset="utf-8">'
            f"{head.title}{styles}{STYLE}<body><div class='bd-content'><div>"
            f"{_join(articles)}</div></div></body></html>",
            encoding="utf-8",
        )
        page.goto(whole.as_uri())
        page.pdf(
            path=path,
            format="A4",
            margin=dict.fromkeys(("top", "bottom", "left", "right"), "18mm"),
            display_header_footer=True,
            header_template="<p></p>",
            footer_template=FOOT,
            outline=True,
            tagged=True,
        )
    context.close()


def _still(page, html, name):
    page.goto((html / f"{name}.html").as_uri())
    page.wait_for_function(READY)
    return page.evaluate((ROOT / "kit/still.js").read_text(encoding="utf-8"), f"{html.as_uri()}/")


def _join(articles):
    """All articles as one; a link that leads out of them becomes plain text."""
    whole = BeautifulSoup("".join(articles), "html.parser")
    ids = {part["id"] for part in whole.select("[id]")}
    for link in whole.select('a[href^="#"]'):
        if link["href"][1:] not in ids:
            link.unwrap()
    return str(whole)


def main():
    """Print the built book with the key at its end; a kit that was built stays as it is."""
    with browser.launch() as chromium, TemporaryDirectory() as folder:
        write_texts(Path(folder), ROOT / "_build/html/book")
        key = Path(folder) / "key.html"
        print_book(chromium, ROOT / "_build/html", names(), ROOT / "_build/book.pdf", key)
    print(f"The book is at {ROOT / '_build/book.pdf'}")


if __name__ == "__main__":
    main()
