"""Slides of the sessions, for reveal.js, made from the chapters' core.

A slide says one sentence; the speaker's notes hold the rest: what to ask, what to look for, where
to stop, and the sources. Each stays as long as the page on teaching gives to its part of a session.
"""

import re
import shutil
from html import escape
from pathlib import Path

from bs4 import BeautifulSoup

from book._ext.policy import seal
from book.figures.plans import MORE, PLANS, TITLES
from kit import demos, own_slides, session
from kit.chapter_slides import Slide, chapter_slides, spread

ROOT = Path(__file__).parents[1]
CONFIG = demos.CONFIG["sphinx"]["config"]
OWN = [ROOT / "kit/slides.css", ROOT / "kit/slides.js"]
SCRIPT = "chapter.js"
STYLES = ["pygments.css", *CONFIG["html_css_files"]]
VENDOR = sorted((ROOT / "kit/vendor").glob("*.*"))
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


def build(folder, pages, own=own_slides.FOLDER):
    """Write one deck a session into `folder`, from the built `pages`, and the files they need.

    `own` is the folder of the lecturer's slides; what else lies in it is copied beside the decks.
    """
    static = folder / "_static"
    static.mkdir(parents=True)
    shutil.copytree(pages.parent / "_static/vendor", static / "vendor")
    for name in (SCRIPT, *STYLES):
        shutil.copy(pages.parent / "_static" / name, static / name)
    for file in (*VENDOR, *OWN):
        shutil.copy(file, static)
    for file in own.glob("*.*"):
        if file.suffix != ".md":
            shutil.copy(file, folder)
    for number, (title, slides) in enumerate(sessions(pages, own), start=1):
        name, title = (
            ("more", title) if title == REST else (f"session-{number}", f"{number}. {title}")
        )
        (folder / f"{name}.html").write_text(_page(title, slides), encoding="utf-8")


def sessions(pages, lecturers):
    """The decks in order, as (title, slides), with the notes of the page on teaching.

    `lecturers` is the folder of the lecturer's own slides.
    """
    teaching = _article(pages / "teaching.html")
    runs = teaching.select_one("#how-a-session-runs ol")
    plans = teaching.select("#session-by-session > section")
    for number, (title, plan, text) in enumerate(zip(TITLES, PLANS[6], plans, strict=True), 1):
        chapters = {
            name: chapter_slides(_article(pages / f"{name}.html"), plan.headings(name))
            for name in plan.chapters
        }
        parts = session.deck(title, chapters, plan.read, runs, text)
        file = lecturers / f"session-{number}.md"
        if file.exists():
            own_slides.put_in(parts, own_slides.own_slides(file.read_text(encoding="utf-8")))
            session.make_room(parts)
        parts["Begin"][0].notes.insert(0, session.clock(parts))
        yield title, [slide for slides in parts.values() for slide in slides]
    yield REST, _rest_deck([chapter_slides(_article(pages / f"{name}.html")) for name in MORE])


def _rest_deck(chapters):
    """The deck of the chapters that no session has: no quiz, and the last recap."""
    items = "".join(f"<li>{chapter.title.body[0].get_text()}</li>" for chapter in chapters)
    texts = [slide for chapter in chapters for slide in chapter.text(4)]
    quiz = [slide for chapter in chapters for slide in spread(chapter.quiz, 2)]
    begin = Slide([f"<h1>{REST}</h1><ul>{items}</ul>"], ["<p>Show what a class asks for.</p>"])
    return [begin, *texts, *quiz, chapters[-1].recap]


def _article(path):
    """The text of a built page; of a chapter, without links, its citations by name."""
    article = BeautifulSoup(path.read_text(encoding="utf-8"), "html.parser").select_one(
        "article > section"
    )
    for part in article.select("a.headerlink"):
        part.decompose()
    for link in article.select(".bibtex-citation a[title]"):
        link.name, link.string = "cite", _short_citation(link["title"])
    for link in article.select("a"):
        link.name, link.attrs = "span", {"data-to": link["href"]}
    return article


def _short_citation(source):
    """The first author's last name and the year of a source that is written out."""
    author, *_ = re.split(r",| and |(?<!\b[A-Z])\. ", source)
    return " ".join([author.split()[-1], *re.findall(r"[ ,](\d{4})\.(?= |$)", source)[:1]])


def _page(title, slides):
    styles = [*(file.name for file in VENDOR if file.suffix == ".css"), *STYLES, "slides.css"]
    scripts = [*(file.name for file in VENDOR if file.suffix == ".js"), "slides.js", SCRIPT]
    scripts.insert(0, CONFIG["mathjax_path"])
    head = [f'<link rel="stylesheet" href="_static/{name}">' for name in styles]
    head += [f'<script defer src="_static/{name}"></script>' for name in scripts]
    page = PAGE.format(
        title=escape(title),
        head="\n".join(head),
        options="{ disableLayout: true, hash: true, overview: false, slideNumber: 'c/t', "
        f"totalTime: {60 * session.MINUTES}, transition: 'none', plugins: [RevealNotes] }}",
        slides="\n".join(map(str, slides)),
    )
    return seal(page, _speaker_script(), frames="'self'")


def _speaker_script():
    """The script of reveal.js' window for the speaker: the plugin has it in a template literal."""
    plugin = next(file for file in VENDOR if "notes" in file.name).read_text(encoding="utf-8")
    script = re.search(r"<script>(.*?)<\\/script>", plugin, re.S)[1]
    return re.sub(r"\\(.)", r"\1", script)
