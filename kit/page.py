"""A page of the kit: Markdown as HTML, sealed."""

import re
import shutil
from html import escape
from pathlib import Path

from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin

from book._ext.packed import light_script
from book._ext.policy import seal

TABLE = re.compile(r"<table\b.*?</table>", re.S)  # may scroll, so the keyboard must reach it
VENDOR = Path(__file__).parents[1] / "book/_static/vendor"
HEAD = """<!doctype html><html lang="en"><meta charset="utf-8"><title>{title}</title>
<meta name="viewport" content="width=device-width">
<style>:root {{ color-scheme: light dark; }}
body {{ max-width: 45rem; margin: 2rem auto; padding: 0 1rem; font-family: sans-serif;
line-height: 1.5; }} :is(pre, .math, .wide) {{ overflow: auto; }}
code {{ overflow-wrap: break-word; }}
table {{ border-collapse: collapse; }}
:is(th, td) {{ padding: .2em .6em; text-align: left; border-bottom: 1px solid #8888; }}
.whole, tr {{ break-inside: avoid; }}
.whole ul {{ padding: 0; list-style: none; }}</style>
<link rel="stylesheet" href="katex.css"><script defer src="katex.js"></script>
<script defer src="book.js"></script>
"""


def markdown_page(name, text):
    """A page of Markdown as HTML."""
    return seal(HEAD.format(title=f"The kit: {name}") + html(text))


def html(text):
    """Markdown as HTML, its maths as KaTeX reads it."""

    def maths(tex, options):
        left, right = ("[", "]") if options["display_mode"] else ("(", ")")
        return f"\\{left}{escape(tex)}\\{right}"

    page = MarkdownIt().enable("table").use(dollarmath_plugin, renderer=maths).render(text)
    return TABLE.sub(r'<div class="wide" tabindex="0">\g<0></div>', page)


def write_assets(folder):
    """Write what every page loads beside itself into a folder: KaTeX, and what sets by it."""
    for name in ("katex.js", "katex.css"):
        shutil.copy(VENDOR / name, folder)
    (folder / "book.js").write_text(light_script("book/book.js"), encoding="utf-8")
