"""Slides of the sessions, for reveal.js: the chapters' built pages, cut by one rule.

A section becomes a slide of its heading, first paragraph and equations, and one for each thing to
answer, to move, or to read as code. The text between goes to the speaker's notes, with the answers.
"""

import json
import re
import shutil
from dataclasses import dataclass, field
from html import escape
from pathlib import Path

import yaml
from bs4 import BeautifulSoup

ROOT = Path(__file__).parents[1]
LOOKS = yaml.safe_load((ROOT / "_config.yml").read_bytes())["sphinx"]["config"]
SCRIPTS = [name for name, _ in LOOKS["html_js_files"]]
STYLES = ["pygments.css", *LOOKS["html_css_files"]]
VENDOR = sorted((ROOT / "kit/vendor").glob("*.*"))
AROUND = {"cell", "cell_output", "output", "text_html"}  # what a cell's output is wrapped in
ALONE = {"vmc-demo", "vmc-quiz", "admonition", "cell_input", "pst-scrollable-table-container"}
PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
{head}
<script>
document.documentElement.dataset.theme =
  matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
window.MathJax = {mathjax};
addEventListener("DOMContentLoaded", () => Reveal.initialize({options}));
</script>
<div class="reveal"><div class="slides">
{slides}
</div></div>
</html>
"""


@dataclass
class Slide:
    """What all see, and what the speaker does; both as pieces of a page."""

    shown: list
    told: list = field(default_factory=list)

    def __str__(self):
        notes = "".join(map(str, self.told))
        shown = "\n".join(map(str, self.shown))
        return f'<section>{shown}<aside class="notes">{notes}</aside></section>'


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
        listed = "".join(f"<li>{link.get_text()}</li>" for link in links)
        first = Slide([f"<h1>{escape(title)}</h1><ul>{listed}</ul>"], [runs, plan])
        chapters = [pages / link["href"] for link in links if link["href"][0].isdigit()]
        yield title, ([[first], *(s for c in chapters for s in stacks(_article(c)))], seconds)


def stacks(article):
    """A chapter's slides, a stack a section: without exercises, and without what is folded."""
    heading, idea, *aims = article.find_all(["h1", "p"], recursive=False)
    yield [Slide([heading, idea], aims)]
    *sections, last = article.find_all("section", recursive=False)
    for section in sections:
        _leave_out_exercises(section)
        _heading, *told = section.find_all(recursive=False)
        if told and not section["id"].startswith("how-sure-are-we"):
            yield cut(section)
    yield [Slide(last.find_all(recursive=False))]


def _leave_out_exercises(section):
    """Take out of a section its exercises, each from its text to the end of its solution."""
    for exercise in section.select(".exercise"):
        solution = exercise.find_next_sibling(class_="solution")
        while solution and exercise.next_sibling is not solution:
            exercise.next_sibling.extract()
        for part in filter(None, (solution, exercise)):
            part.extract()


def cut(section):
    """The slides of a section and of those in it."""
    heading, *rest = _parts(section)
    made = [Slide([heading])]
    for part in rest:
        kinds = {*part.get("class", [])}
        if part.name == "section":
            made += cut(part)
        elif kinds & ALONE:
            made.append(Slide([heading, part], _answers(part)))
        elif "math" in kinds or len(made[0].shown) == 1 == len(made):
            made[0].shown.append(part)
        else:
            made[-1].told.append(part)
    return made


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
    """What a section is made of: its outputs out of their cells, without what is folded."""
    for part in block.find_all(recursive=False):
        if AROUND & {*part.get("class", [])}:
            yield from _parts(part)
        elif part.name not in ("details", "span"):  # folded; where a link leads
            yield part


def _answers(part):
    """What the answers of a prediction or a quiz say when they are opened."""
    return [
        f"<p>{folded.summary.decode_contents()}: {folded.p.decode_contents()}</p>"
        for folded in part.select("fieldset details")
    ]


def _page(title, slides, seconds):
    styles = [*(file.name for file in VENDOR if file.suffix == ".css"), *STYLES, "slides.css"]
    scripts = [*(file.name for file in VENDOR if file.suffix == ".js"), *SCRIPTS]
    scripts.insert(0, LOOKS["mathjax_path"])
    head = [f'<link rel="stylesheet" href="_static/{name}">' for name in styles]
    head += [f'<script defer src="_static/{name}"></script>' for name in scripts]
    return PAGE.format(
        title=escape(title),
        head="\n".join(head),
        mathjax=json.dumps(LOOKS["mathjax3_config"]),
        options="{ disableLayout: true, hash: true, overview: false, slideNumber: 'c/t', "
        f"totalTime: {seconds}, transition: 'none', plugins: [RevealNotes] }}",
        slides="\n".join(f"<section>{''.join(map(str, stack))}</section>" for stack in slides),
    )
