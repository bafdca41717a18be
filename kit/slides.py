"""Slides of the sessions, for reveal.js: the chapters' built pages, cut by one rule.

A section becomes a slide of its heading, first paragraph and equations, and one for each thing to
answer, to move, or to read as code. The text between goes to the speaker's notes, with the answers.
"""

import re
import shutil
from dataclasses import dataclass, field
from html import escape
from pathlib import Path

import yaml
from bs4 import BeautifulSoup

ROOT = Path(__file__).parents[1]
CONFIG = yaml.safe_load((ROOT / "_config.yml").read_bytes())["sphinx"]["config"]
SCRIPTS = [name for name, _ in CONFIG["html_js_files"]]
STYLES = ["pygments.css", *CONFIG["html_css_files"]]
VENDOR = sorted((ROOT / "kit/vendor").glob("*.*"))
WRAPPERS = {"cell", "cell_output", "output", "text_html"}  # of a cell's output
OWN_SLIDE = {"vmc-demo", "vmc-quiz", "admonition", "cell_input", "pst-scrollable-table-container"}
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


@dataclass
class Slide:
    """A slide: its body, which all see, and the speaker's notes; both as elements of a page."""

    body: list
    notes: list = field(default_factory=list)

    def __str__(self):
        notes = "".join(map(str, self.notes))
        body = "\n".join(map(str, self.body))
        return f'<section>{body}<aside class="notes">{notes}</aside></section>'


def build(folder, pages):
    """Write one deck a session into `folder`, from the built `pages`, and the files they need."""
    static = folder / "_static"
    static.mkdir(parents=True)
    for name in (*SCRIPTS, *STYLES, "vendor"):
        here = pages.parent / "_static" / name
        copy = shutil.copytree if here.is_dir() else shutil.copy
        copy(here, static / name)
    for file in (*VENDOR, ROOT / "kit/slides.css"):
        shutil.copy(file, static)
    for number, (title, deck) in enumerate(sessions(pages), start=1):
        (folder / f"session-{number}.html").write_text(
            _page(f"{number}. {title}", *deck), encoding="utf-8"
        )


def sessions(pages):
    """The sessions in order, as (title, (stacks of slides, seconds)), from the page on teaching."""
    teaching = _article(pages / "teaching.html")
    runs = teaching.select_one("#how-a-session-runs ol")
    seconds = 60 * sum(map(int, re.findall(r"(\d+) minutes", runs.get_text())))
    plans = teaching.select("#session-by-session > section > ul")
    for row, plan in zip(teaching.tbody.select("tr"), plans, strict=True):
        title = row.select("td")[1].get_text().strip()
        links = row.select("a")
        contents = "".join(f"<li>{link.get_text()}</li>" for link in links)
        first = Slide([f"<h1>{escape(title)}</h1><ul>{contents}</ul>"], [runs, plan])
        chapters = [pages / link["href"] for link in links if link["href"][0].isdigit()]
        yield title, ([[first], *(s for c in chapters for s in stacks(_article(c)))], seconds)


def stacks(article):
    """A chapter's slides, a stack a section: without exercises, and without what is folded."""
    heading, idea, *aims = article.find_all(["h1", "p"], recursive=False)
    yield [Slide([heading, idea], aims)]
    *sections, last = article.find_all("section", recursive=False)
    for section in sections:
        _remove_exercises(section)
        _heading, *text = section.find_all(recursive=False)
        if text and not section["id"].startswith("how-sure-are-we"):
            yield cut(section)
    yield [Slide(last.find_all(recursive=False))]


def _remove_exercises(section):
    """Remove the exercises of a section, each from its text to the end of its solution."""
    for exercise in section.select(".exercise"):
        solution = exercise.find_next_sibling(class_="solution")
        while solution and exercise.next_sibling is not solution:
            exercise.next_sibling.extract()
        for part in filter(None, (solution, exercise)):
            part.extract()


def cut(section):
    """The slides of a section and of those in it."""
    heading, *rest = _parts(section)
    slides = [Slide([heading])]
    for part in rest:
        kinds = {*part.get("class", [])}
        if part.name == "section":
            slides += cut(part)
        elif kinds & OWN_SLIDE:
            slides.append(Slide([heading, part], _answers(part)))
        elif "math" in kinds or len(slides[0].body) == 1 == len(slides):
            slides[0].body.append(part)
        else:
            slides[-1].notes.append(part)
    return slides


def _article(path):
    """The text of a built page; of a chapter, without links and without citations."""
    article = BeautifulSoup(path.read_text(encoding="utf-8"), "html.parser").select_one(
        "article > section"
    )
    for part in article.select("a.headerlink, .bibtex-citation"):
        if isinstance(part.previous_sibling, str):  # or a space is left before the full stop
            part.previous_sibling.replace_with(part.previous_sibling.rstrip())
        part.decompose()
    for link in article.select("a") if path.stem != "teaching" else []:
        link.unwrap()
    return article


def _parts(block):
    """The elements of a section: outputs out of their cells, without what is folded."""
    for part in block.find_all(recursive=False):
        if WRAPPERS & {*part.get("class", [])}:
            yield from _parts(part)
        elif part.name not in ("details", "span"):  # folded; where a link leads
            yield part


def _answers(part):
    """The answers of a prediction or a quiz, as paragraphs."""
    return [
        f"<p>{folded.summary.decode_contents()}: {folded.p.decode_contents()}</p>"
        for folded in part.select("fieldset details")
    ]


def _page(title, slides, seconds):
    styles = [*(file.name for file in VENDOR if file.suffix == ".css"), *STYLES, "slides.css"]
    scripts = [*(file.name for file in VENDOR if file.suffix == ".js"), *SCRIPTS]
    scripts.insert(0, CONFIG["mathjax_path"])
    head = [f'<link rel="stylesheet" href="_static/{name}">' for name in styles]
    head += [f'<script defer src="_static/{name}"></script>' for name in scripts]
    return PAGE.format(
        title=escape(title),
        head="\n".join(head),
        options="{ disableLayout: true, hash: true, overview: false, slideNumber: 'c/t', "
        f"totalTime: {seconds}, transition: 'none', plugins: [RevealNotes] }}",
        slides="\n".join(f"<section>{''.join(map(str, stack))}</section>" for stack in slides),
    )
