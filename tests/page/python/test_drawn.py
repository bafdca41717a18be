"""Of what the page's Python draws only pictures and tables become part of the page."""

import json

import pytest

from tests import pages
from tests.pages import BUILT
from vmc_lib.show.packed import unpack_bytes

pytestmark = pytest.mark.browser
DRAWN = [  # what is drawn, and what of it becomes part of the page
    ('<svg><path d="M0 0" onclick="harm()"></path></svg>', '<svg><path d="M0 0"></path></svg>'),
    ("<svg><script>harm()</script><style>*{}</style></svg>", "<svg></svg>"),
    ("<svg><foreignObject><form></form></foreignObject></svg>", "<svg></svg>"),
    ('<a href="javascript:harm()">x</a><a href="#x">y</a>', '<a>x</a><a href="#x">y</a>'),
    ('<svg><use href="//evil/x.svg#a"></use></svg>', "<svg><use></use></svg>"),
    ('<svg><animate attributeName="href" to="javascript:harm()"/></svg>', "<svg></svg>"),
    ('<img src="https://evil/x.png"><iframe srcdoc="x"></iframe>', "<img>"),
    ('<p style="position: fixed; fill: red">x</p>', '<p style="fill: red;">x</p>'),
    ('<p style="fill: url(//evil)">x</p><p fill="u\\rl(x)">y</p>', "<p>x</p><p>y</p>"),
    ('<p id="mujoco.js">a</p><p id="vmcPythonFiles">b</p>', "<p>a</p><p>b</p>"),
    ('<svg><g id="pbeabfdadcc"></g></svg>', '<svg><g id="pbeabfdadcc"></g></svg>'),
    ('<div class="vmc-scene" data-law="x"></div>', "<div></div>"),
    ('<p class="fixed-top w-100 h-100">x</p>', "<p>x</p>"),
    ("<p style=\"--x: image-set('/x' 1x)\">x</p>", "<p>x</p>"),
]
CLEAN = """(html) => {
  const box = document.createElement("template");
  box.innerHTML = html;
  const before = box.innerHTML;
  vmc["python/drawn"].clean(box.content);
  return [before, box.innerHTML];
}"""


def test_of_what_is_drawn_only_pictures_become_part_of_the_page(open_page):
    page = open_page("<h1>A</h1>")
    assert [page.evaluate(CLEAN, html)[1] for html, _ in DRAWN] == [clean for _, clean in DRAWN]
    page.errors.clear()  # the policy refused the handlers, too


def test_all_that_the_books_own_demos_draw_passes(open_page):
    page, seen = open_page("<h1>A</h1>"), 0
    for path in sorted((BUILT / "book").glob("[0-9]*.html")):
        for packed in pages.PACKED.findall(path.read_text(encoding="utf-8")):
            kept = json.loads(unpack_bytes(packed))
            for places in kept.get("states", [])[:2]:
                for lines in [[kept["lines"][n] for n in part] for part in places[1:] if part]:
                    if lines[0].startswith("<"):
                        before, after = page.evaluate(CLEAN, "\n".join(lines))
                        assert after == before, path.stem
                        seen += 1
    assert seen > 100
