"""Demos that travel: each demo of a chapter as one HTML file, and as a SCORM package.

A file holds the figure as its page has it, below the prediction that it answers, and of the modules
in `page` those that it needs.
"""

import re
import shutil
from functools import cache
from html import escape, unescape
from pathlib import Path

import yaml

from book._ext.numbering import FIGURE_NUMBER
from book._ext.packed import light_script
from book._ext.policy import seal
from kit import scorm
from vmc_lib.show.packed import pack_bytes, unpack_bytes

ROOT = Path(__file__).parents[1]
CONFIG = yaml.safe_load((ROOT / "_config.yml").read_bytes())
STYLES = ("demo.css", "scene.css", "live.css")
FIGURE = re.compile(r'<figure class="vmc-demo".*?</figure>', re.S)
QUESTION = re.compile(r'<div class="admonition tip">(?:(?!</?div).)*?vmc-predict.*?</div>', re.S)
HEADING = re.compile(r'<h[1-3]>(.*?)<a class="headerlink"')
STARTS = {  # what stands in a figure, and the module that moves it
    'class="vmc-segmentation"': "demos/page.js",
    'class="vmc-live"': "arm/travel.js",
    'type="application/gzip"': "demo/page.js",
}
VENDORED = {  # what stands in a figure, and what is fetched for it
    'class="vmc-scene"': ("meshcat.js", "bones.js"),
    'class="vmc-live"': ("mujoco.js",),
    r"\(": ("katex.js",),
}
MADE_BY = {
    "meshcat.js": "MeshCat with three.js (MIT)",
    "bones.js": "bones of OpenSim's arm26 (CC BY 3.0)",
    "mujoco.js": "MuJoCo (Apache-2.0)",
    "katex.js": "KaTeX (MIT)",
}
GIVEN = re.compile(r'(?<=<script type="application/json">)[^<]+')  # what an arm has from Python
PACKED = '<script type="application/gzip" id="{}">{}</script>'
SOURCE = (
    "From <cite>{book}</cite>, “{chapter}”. Text and pictures: CC BY 4.0; code: BSD 3-Clause.{rest}"
)
LINE = '<iframe src="{name}.html" title="{title}" width="100%" height="700"></iframe>'
ITEM = (
    '<li>{title}: <a href="{name}.html">{name}.html</a> ({size:.2f} MB), '
    '<a href="{name}.zip">{name}.zip</a><br><code>{line}</code></li>'
)


def build(folder, pages):
    """Write the demos of the chapters, built in the folder `pages`, and a list of them."""
    folder.mkdir(parents=True)
    parts = []
    for path in sorted(pages.glob("[0-9]*.html")):
        chapter, demos = read(path.read_text(encoding="utf-8"))
        items = []
        for name, (heading, figure) in demos.items():
            title = f"{heading} ({name.replace('figure-', 'Figure ').replace('-', '.')})"
            page = demo_page(chapter, heading, title, figure, pages.parent / "_static")
            (folder / f"{name}.html").write_text(page, encoding="utf-8")
            (folder / f"{name}.zip").write_bytes(scorm.package(name, title, page))
            line = escape(LINE.format(name=name, title=escape(title)))
            size = len(page.encode()) / 1e6
            items += [ITEM.format(title=escape(title), name=name, size=size, line=line)]
        parts += [f"<h2>{escape(chapter)}</h2>", "<ul>", *items, "</ul>"]
    page = (ROOT / "kit/pages/demos.html").read_text(encoding="utf-8")
    listed = seal(page.replace("{list}", "\n".join(parts)))
    (folder / "index.html").write_text(listed, encoding="utf-8")
    for name in ("LICENSE", "LICENSE-text", "CREDITS.md"):
        shutil.copy(ROOT / name, folder)


def read(page):
    """A built page's title, and its demos that move, {name: (heading, question and figure)}."""
    headings = [(found.start(), _words(found[1])) for found in HEADING.finditer(page)]
    demos, before = {}, 0
    for found in FIGURE.finditer(page):
        number = FIGURE_NUMBER.search(found[0])
        if number and any(mark in found[0] for mark in STARTS):
            begin, heading = [one for one in headings if one[0] < found.start()][-1]
            asked = QUESTION.findall(page, max(begin, before), found.start())
            after = found.end(), headings[1][0]  # of a chapter's first part
            # The demo that opens a chapter has its question below, if no other demo has it
            if begin == headings[0][0] and not FIGURE.search(page, *after):
                asked += QUESTION.findall(page, *after)[:1]
            name = f"figure-{number[1].replace('.', '-')}"
            demos[name] = heading, "".join(asked[-1:]) + found[0]
        before = found.end()
    return headings[0][1], demos


def demo_page(chapter, heading, title, figure, static):
    """The figure as a page of its own; `static` is the folder of the built book's scripts."""
    vendored = [name for mark, names in VENDORED.items() if mark in figure for name in names]
    files = {name: _packed_file(static / "vendor" / name) for name in vendored}
    if given := GIVEN.search(figure):
        files["given.json"] = pack_bytes(given[0].encode())
    script = light_script(*entries(figure))
    figure = re.sub(r"</?a\b[^>]*>", "", GIVEN.sub("", figure))  # what is linked stays in the book
    scripts = [PACKED.format(name, text) for name, text in files.items()]
    scripts.append(f"<script>\n{script}</script>")
    made_by = "; ".join(MADE_BY[name] for name in vendored)
    parts = {
        "title": escape(title),
        "heading": escape(heading),
        "figure": figure,
        "source": SOURCE.format(
            book=CONFIG["title"],
            chapter=escape(chapter),
            rest=f" In this file: {made_by}." if made_by else "",
        ),
        "styles": "".join((static / name).read_text(encoding="utf-8") for name in STYLES),
        "scripts": "\n".join(scripts),
    }
    page = (ROOT / "kit/pages/demo.html").read_text(encoding="utf-8")
    return seal(re.sub(r"\{(\w+)\}", lambda found: parts.get(found[1], found[0]), page))


def entries(figure):
    """The modules by which a figure moves, and what it asks of others."""
    modules = ["demo/travel.js", *(name for mark, name in STARTS.items() if mark in figure)]
    data = re.search(r'<script type="application/gzip">([^<]+)', figure)
    if data and unpack_bytes(data[1]).startswith(b'{"work"'):
        modules.append("demos/works.js")
    return tuple(modules)


@cache
def _packed_file(path):
    return pack_bytes(path.read_bytes())


def _words(html):
    return unescape(re.sub("<[^>]*>", "", html)).strip()
