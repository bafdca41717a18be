"""Slides of the sessions, for reveal.js: at most 25 a session, made from the chapters' core.

A slide says one sentence; the speaker's notes hold the rest: what to ask, what to look for, where
to stop, and the sources. Each stays as long as the page on teaching gives to its part of a session.
"""

import re
import shutil
from copy import copy
from html import escape
from itertools import pairwise
from pathlib import Path

from bs4 import BeautifulSoup

from book._ext.policy import seal
from book.figures.plans import MORE, PLANS, TITLES
from kit import demos, own_slides
from kit.chapter_slides import Slide, chapter_slides, sentence

ROOT = Path(__file__).parents[1]
CONFIG = demos.CONFIG["sphinx"]["config"]
OWN = [ROOT / "kit/slides.css", ROOT / "kit/slides.js"]
SCRIPT = "chapter.js"
STYLES = ["pygments.css", *CONFIG["html_css_files"]]
VENDOR = sorted((ROOT / "kit/vendor").glob("*.*"))
MOST = 25  # slides a session
MINUTES = 90  # of a session
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
    fixed = {word: int(count) for word, count in MINUTES_OF.findall(runs.get_text())}
    plans = teaching.select("#session-by-session > section")
    titles, decks = [*TITLES, REST], [*(session.chapters for session in PLANS[6]), MORE]
    parts = zip(titles, decks, [*plans, None], strict=True)
    for number, (title, names, plan) in enumerate(parts, start=1):
        articles = [_article(pages / f"{name}.html") for name in names]
        notes = plan.select("ul") if plan else []
        items = [item for part in notes for item in part.select("li")]
        timed = [item for item in items if MINUTES_OF.search(item.em.get_text())]
        contents = "".join(f"<li>{article.h1.get_text()}</li>" for article in articles)
        room = (MOST - 2 - len(timed)) // len(names)
        chapters = [chapter_slides(article, room) for article in articles]
        first = Slide([f"<h1>{escape(title)}</h1><ul>{contents}</ul>"], [runs, *map(copy, notes)])
        own = [_lesson(item, articles) for item in timed]
        for before, after in pairwise(chapters):
            after.text[0].notes += ["<p>Before it:</p>", *before.recap[0].notes]
        deck = {
            "Begin": [first],
            "In class": own[:1],
            "Predict and drag": [slide for chapter in chapters for slide in chapter.text],
            "One equation": own[1:2],
            "One cell": own[2:],
            "Quiz": [slide for chapter in chapters for slide in chapter.quiz],
            "Next": chapters[-1].recap,
        }
        file = lecturers / f"session-{number}.md"
        if file.exists():
            own_slides.put_in(deck, own_slides.own_slides(file.read_text(encoding="utf-8")))
        first.notes.insert(0, _clock(deck, fixed))
        yield title, [slide for part in deck.values() for slide in part]


MINUTES_OF = re.compile(r"(\w[\w ]*) \((\d+) minutes\)")


def _lesson(item, articles):
    """The slide of a part that the page on teaching names: its first sentence, and the rest below.

    Where the sentence quotes a cell of the chapters, the cell is shown as well.
    """
    name, minutes = MINUTES_OF.search(item.em.get_text()).groups()
    notes = copy(item)
    item.em.decompose()
    line = item.code.get_text() if item.code else None
    cells = [cell for article in articles for cell in article.select(".cell_input")]
    cell = [cell for cell in cells if line and line in cell.get_text()][:1]
    body = [f"<h2>{name}</h2>", sentence(item.p), *cell]
    return Slide(body, [notes], seconds=60 * int(minutes))


def _clock(deck, fixed):
    """Give each slide its seconds; a list of when each part of the session begins."""
    for part, slides in deck.items():
        for slide in slides if part in fixed else []:
            slide.seconds = slide.seconds or 60 * fixed[part] / len(slides)
    taken = sum(slide.seconds for slides in deck.values() for slide in slides)
    rest = deck["Predict and drag"]
    unit = (60 * MINUTES - taken) / sum(slide.weight for slide in rest)
    for slide in rest:
        slide.seconds = unit * slide.weight
    lines, number, seconds = [], 1, 0
    for part, slides in deck.items():
        if slides:
            lines.append(f"<li>{part}: from minute {seconds / 60:.0f}, slide {number}</li>")
        number, seconds = number + len(slides), seconds + sum(slide.seconds for slide in slides)
    return f"<ul>{''.join(lines)}</ul>"


def _article(path):
    """The text of a built page; of a chapter, without links, its citations by name."""
    article = BeautifulSoup(path.read_text(encoding="utf-8"), "html.parser").select_one(
        "article > section"
    )
    for part in article.select("a.headerlink"):
        part.decompose()
    for link in article.select(".bibtex-citation a[title]"):
        link.name, link.string = "cite", _short(link["title"])
    for link in article.select("a"):
        link.unwrap()
    return article


def _short(source):
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
        f"totalTime: {60 * MINUTES}, transition: 'none', plugins: [RevealNotes] }}",
        slides="\n".join(map(str, slides)),
    )
    return seal(page, _speaker_script(), frames="'self'")


def _speaker_script():
    """The script of reveal.js' window for the speaker: the plugin has it in a template literal."""
    plugin = next(file for file in VENDOR if "notes" in file.name).read_text(encoding="utf-8")
    script = re.search(r"<script>(.*?)<\\/script>", plugin, re.S)[1]
    return re.sub(r"\\(.)", r"\1", script)
