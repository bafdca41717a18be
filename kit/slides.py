"""Slides of the sessions, for reveal.js: at most 25 a session, made from the chapters' core.

A slide says one sentence; the speaker's notes hold the rest: what to ask, what to look for, where
to stop, and the sources.
"""

import re
import shutil
from html import escape
from pathlib import Path

import yaml
from bs4 import BeautifulSoup

from book.figures.plans import MORE, PLANS, TITLES
from kit.chapter_slides import Slide, chapter_slides

ROOT = Path(__file__).parents[1]
CONFIG = yaml.safe_load((ROOT / "_config.yml").read_bytes())["sphinx"]["config"]
SCRIPTS = [name for name, _ in CONFIG["html_js_files"]]
OWN = [ROOT / "kit/slides.css", ROOT / "kit/slides.js"]
STYLES = ["pygments.css", *CONFIG["html_css_files"]]
VENDOR = sorted((ROOT / "kit/vendor").glob("*.*"))
MOST = 25  # slides a session
REST = "For those who want more"  # the deck of the chapters that no session has
PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
{head}
<script>
document.documentElement.dataset.theme =
  matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
addEventListener("DOMContentLoaded", () => Reveal.initialize({options}));
</script>
<div class="reveal"><div class="slides">
{slides}
</div></div>
</html>
"""


def build(folder, pages):
    """Write one deck a session into `folder`, from the built `pages`, and the files they need."""
    static = folder / "_static"
    static.mkdir(parents=True)
    shutil.copytree(pages.parent / "_static/vendor", static / "vendor")
    for name in (*SCRIPTS, *STYLES):
        shutil.copy(pages.parent / "_static" / name, static / name)
    for file in (*VENDOR, *OWN):
        shutil.copy(file, static)
    for number, (title, slides, seconds) in enumerate(sessions(pages), start=1):
        name, title = (
            ("more", title) if title == REST else (f"session-{number}", f"{number}. {title}")
        )
        (folder / f"{name}.html").write_text(_page(title, slides, seconds), encoding="utf-8")


def sessions(pages):
    """The decks in order, as (title, slides, seconds), with the notes of the page on teaching."""
    teaching = _article(pages / "teaching.html")
    runs = teaching.select_one("#how-a-session-runs ol")
    seconds = 60 * sum(map(int, re.findall(r"(\d+) minutes", runs.get_text())))
    plans = [[runs, plan] for plan in teaching.select("#session-by-session > section > ul")]
    titles, decks = [*TITLES, REST], [*(session.chapters for session in PLANS[6]), MORE]
    for title, names, notes in zip(titles, decks, [*plans, []], strict=True):
        articles = [_article(pages / f"{name}.html") for name in names]
        contents = "".join(f"<li>{article.h1.get_text()}</li>" for article in articles)
        slides = [Slide([f"<h1>{escape(title)}</h1><ul>{contents}</ul>"], notes)]
        for article in articles:
            slides += chapter_slides(article, (MOST - 1) // len(names))
        yield title, slides, seconds


def _article(path):
    """The text of a built page; of a chapter, without links, its citations by name."""
    article = BeautifulSoup(path.read_text(encoding="utf-8"), "html.parser").select_one(
        "article > section"
    )
    for part in article.select("a.headerlink"):
        part.decompose()
    for part in article.select(".bibtex-citation"):
        sources = "; ".join(link["title"] for link in part.select("a[title]"))
        part.replace_with(
            BeautifulSoup(f'<cite class="source">[{escape(sources)}]</cite>', "html.parser")
        )
    for link in article.select("a") if path.stem != "teaching" else []:
        link.unwrap()
    return article


def _page(title, slides, seconds):
    styles = [*(file.name for file in VENDOR if file.suffix == ".css"), *STYLES, "slides.css"]
    scripts = [*(file.name for file in VENDOR if file.suffix == ".js"), "slides.js", *SCRIPTS]
    scripts.insert(0, CONFIG["mathjax_path"])
    head = [f'<link rel="stylesheet" href="_static/{name}">' for name in styles]
    head += [f'<script defer src="_static/{name}"></script>' for name in scripts]
    return PAGE.format(
        title=escape(title),
        head="\n".join(head),
        options="{ disableLayout: true, hash: true, overview: false, slideNumber: 'c/t', "
        f"totalTime: {seconds}, transition: 'none', plugins: [RevealNotes] }}",
        slides="\n".join(map(str, slides)),
    )
