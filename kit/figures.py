"""Figures to take along: each picture of a chapter's page as SVG, and as PNG where a browser is.

A drawing is as the page first shows it, in its light colours; a photo stays as it is. The line of
the licence stands in each SVG and in the list, index.html.
"""

import re
import shutil
from base64 import b64decode
from html import escape, unescape

from book._ext.numbering import FIGURE_NUMBER
from book._ext.policy import seal
from kit.demos import CONFIG, FIGURE, ROOT
from tools import browser
from vmc_lib.show.palette import COLOURS

LICENCE = "From “{book}”, chapter “{chapter}”, Figure {number}. CC BY 4.0; pictures: CREDITS.md."
TITLE = re.compile(r'<h1>((?:(?!</h1>).)*?)<a class="headerlink"', re.S)  # not the contents'
SVG_TAG = re.compile(r"<(/?)svg\b")
PHOTO = re.compile(r'<img [^>]*src="data:image/(\w+);base64,([^"]+)"')
COLOUR = re.compile(r"var\(--vmc-(\w+)\)")
PAGE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>Figures to take along</title>
<style>:root {{ color-scheme: light dark; }} body {{ max-width: 50rem; margin: 2rem auto;
padding: 0 1rem; font: 1rem/1.5 sans-serif; }} img {{ max-width: 100%; background: white; }}</style>
<h1>Figures to take along</h1><p>Under each the line that its licence asks for.</p>
{items}</html>"""
ITEM = '<p><img loading="lazy" src="{name}" alt=""><br><a href="{name}">{name}</a>: {line}</p>'


def build(folder, pages):
    """Write the figures of the chapters, built in the folder `pages`, and a list of them."""
    folder.mkdir(parents=True)
    items = []
    for path in sorted(pages.glob("[0-9]*.html")):
        page = path.read_text(encoding="utf-8")
        chapter = unescape(re.sub("<[^>]*>", "", TITLE.search(page)[1]))
        for figure in FIGURE.findall(page):
            if number := FIGURE_NUMBER.search(figure):
                line = LICENCE.format(book=CONFIG["title"], chapter=chapter, number=number[1])
                files = pictures(figure, line)
                for k, (end, data) in enumerate(files, start=1):
                    part = f"-{k}" if len(files) > 1 else ""
                    name = f"figure-{number[1].replace('.', '-')}{part}.{end}"
                    (folder / name).write_bytes(data)
                    items.append(ITEM.format(name=name, line=escape(line)))
    page = seal(PAGE.format(items="\n".join(items)))
    (folder / "index.html").write_text(page, encoding="utf-8")
    for name in ("LICENSE-text", "CREDITS.md"):
        shutil.copy(ROOT / name, folder)


def pictures(figure, line):
    """The pictures of a figure, HTML, as [(ending, bytes)]."""
    figure = re.sub(r"<script.*?</script>", "", figure, flags=re.S)
    drawn = [("svg", _svg_file(svg, line).encode()) for svg in _drawings(figure)]
    return drawn + [(end, b64decode(data)) for end, data in PHOTO.findall(figure)]


def _drawings(html):
    """The outermost drawings."""
    depth = start = 0
    for tag in SVG_TAG.finditer(html):
        if tag[1]:
            depth -= 1
            if not depth:
                yield html[start : html.index(">", tag.start()) + 1]
        else:
            start, depth = start if depth else tag.start(), depth + 1


def _svg_file(svg, line):
    """A drawing as a file: its colours as in the light, and the licence in its description."""
    head, body = COLOUR.sub(lambda found: COLOURS[found[1]], svg).split(">", 1)
    space = "" if "xmlns=" in head else ' xmlns="http://www.w3.org/2000/svg"'
    return f"{head}{space}><desc>{escape(line)}</desc>{body}"


def print_pngs(folder):
    """Draw each SVG of a folder as a PNG twice its size, where there is a browser."""
    if not browser.find():
        return print("No browser: the figures are SVG alone.")
    with browser.launch() as chromium:
        page = chromium.new_context(device_scale_factor=2, offline=True).new_page()
        for file in sorted(folder.glob("*.svg")):
            page.goto(file.resolve().as_uri())
            page.locator("svg").first.screenshot(path=file.with_suffix(".png"))
