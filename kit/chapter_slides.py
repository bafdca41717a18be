"""The slides of a chapter, from its built page: one sentence each, the rest in the notes.

A chapter gives its idea, the brain's wiring where it is drawn, equations for the board, predictions
with the demos that answer them, questions of its quiz, and its recap with the question that it
leaves; of its exercises only where they are checked, and no demo whose cell carries the tag
`off-slides`.
"""

import re
from dataclasses import dataclass, field
from html import escape
from itertools import takewhile
from operator import itemgetter
from typing import NamedTuple

from bs4 import Comment, Tag

from book._ext.numbering import EQUATION_NUMBER

WRAPPERS = {"cell", "cell_output", "output", "text_html"}  # of a cell's output
WIRING = "What the brain does"  # a section: what it draws, and asks nothing about
EXERCISES = "<p>Exercises: the chapter's page checks your lines; nothing to install.</p>"
FULL_STOP = re.compile(r"(?<!Eq)(?<!Eqs)(?<!Fig)[.?!](?=\s|$)")


@dataclass
class Slide:
    """A slide: its body, which all see, and the speaker's notes; both as elements of a page."""

    body: list
    notes: list = field(default_factory=list)
    seconds: float = 0  # that it stays; 0 where its part of the session says that
    active: bool = False  # whether students do something

    def __str__(self):
        notes = "".join(map(str, self.notes))
        body = "\n".join(map(str, self.body))
        active = " data-active" if self.active else ""
        return (
            f'<section data-timing="{self.seconds:.0f}"{active}><div class="fit">{body}</div>'
            f'<aside class="notes">{notes}</aside></section>'
        )


class Chapter(NamedTuple):
    """What a chapter gives to slides; demos and wiring as (place in the page, [Slide])."""

    title: Slide
    wiring: list
    asked: list  # demos with a prediction
    others: list  # demos without
    quiz: list
    recap: Slide
    blocks: list  # (heading, element), what the page shows
    cells: list  # of code

    def text(self, count):
        """Its title, its wiring and so many of its demos, in the page's order."""
        chosen = self.wiring + spread(self.asked, count)
        return [self.title, *(slide for _, pair in sorted(chosen, key=PLACE) for slide in pair)]

    def demo_of(self, section):
        """Take out the slides of the first demo of a section, by its heading, or of the chapter.

        ValueError where it has none.
        """
        found = [(one, several) for several in (self.asked, self.others) for one in several]
        heads = [self.blocks[place][0] for (place, _), _ in found]
        for wanted in (lambda head: head.get_text() == section, lambda head: head.name == "h1"):
            for head, (one, several) in zip(heads, found, strict=True):
                if wanted(head):
                    several.remove(one)
                    return one[1]
        raise ValueError(f"{self.title.body[0].get_text()}: no demo to open it")

    def equations(self, numbers):
        """A slide for each section's equations of these numbers."""
        slides = {}
        for place, (heading, part) in enumerate(self.blocks):
            if _has_class(part, "math") and numbers & {
                *map(int, EQUATION_NUMBER.findall(str(part)))
            }:
                if heading not in slides:
                    words = _words_of(self.blocks, place)
                    notes = _texts(self.blocks, heading)
                    slides[heading] = Slide([_plain_heading(heading), sentence(words)], notes, 60)
                slides[heading].body.append(part)
        return [*slides.values()]


PLACE = itemgetter(0)
SHORT = 8  # words of a sentence that needs the next one
MINUTE = 60  # s
PAIR = 5 * MINUTE  # a prediction with its demo, or a drawing of the brain's wiring


def chapter_slides(article, headings=None):
    """The `Chapter` of a built page: what stands under `headings`, or all that is not optional."""
    title, idea, *aims = article.find_all(["h1", "p"], recursive=False)
    *_, last = article.find_all("section", recursive=False)
    exercises = [EXERCISES] if article.select("form[data-function]") else []
    _remove_exercises(article)
    cells = article.select(".cell_input")
    sources = dict.fromkeys(cite["title"] for cite in article.select("cite[title]"))
    cited = "; ".join(f"<cite>{escape(text)}</cite>" for text in sources)
    notes = [*aims, f"<details><summary>Sources</summary>{cited}</details>"]
    first = Slide([title, idea], notes, MINUTE)
    heading, *text = last.find_all(["h2", "p", "ul"], recursive=False)
    left = [_open_question(words) for words in last.select("p > strong")[-1:]]
    gist, *more = sentences(text[0])
    gist = f"<p>{' '.join([gist, *more[: len(gist.split()) < SHORT]])}</p>"
    recap = Slide([heading, gist, *left, *exercises], text)
    blocks = [*_blocks(article)]
    if headings is not None:
        shown = {*map(_bare_title, headings)}
        blocks = [one for one in blocks if _bare_title(one[0].get_text()) in shown]
    demos = [*_pairs(blocks)]
    wiring = [one for one in demos if len(one[1]) == 1 and WIRING in blocks[one[0]][0].get_text()]
    asked = [one for one in demos if len(one[1]) > 1]
    others = [one for one in demos if one not in asked and one not in wiring]
    for _, [slide] in wiring:
        slide.seconds, slide.active = PAIR, False
    quiz = [Slide([box], _answers(box), active=True) for box in article.select(".vmc-quiz")]
    return Chapter(first, wiring, asked, others, quiz, recap, blocks, cells)


def _open_question(words):
    """A paragraph of what a recap has in bold: a question, or "Next:" with what it asks."""
    follows = []
    if words.get_text().strip().endswith(":"):
        follows = takewhile(lambda part: not _is_link(part), words.next_siblings)
    return f"<p>{''.join(map(str, (words, *follows))).strip()}</p>"


def _is_link(part):
    return isinstance(part, Tag) and part.has_attr("data-to")


def _bare_title(title):
    """A title without the chapter's number, and with plain apostrophes."""
    return re.sub(r"^\d+\. ", "", title.strip()).replace("’", "'")


def spread(items, count):
    """So many of the items, evenly from the first on."""
    count = min(count, len(items))
    return [items[k * len(items) // count] for k in range(count)]


def _remove_exercises(article):
    """Remove the exercises, each from its text to the end of its solution."""
    for exercise in article.select(".exercise"):
        solution = exercise.find_next_sibling(class_="solution")
        while solution and exercise.next_sibling is not solution:
            exercise.next_sibling.extract()
        for part in filter(None, (solution, exercise)):
            part.extract()


def _blocks(section):
    """The elements of a section and of those in it, each with the heading above it."""
    heading, *rest = _unfold(section)
    for part in rest:
        if part.name != "section":
            yield heading, part
        elif not _has_class(part, "vmc-optional"):
            yield from _blocks(part)


def _unfold(section):
    """The elements of a section: outputs out of their cells, without what is folded."""
    for part in section.find_all(recursive=False):
        if _has_class(part, "tag_off-slides"):
            continue
        if WRAPPERS & {*part.get("class", [])}:
            yield from _unfold(part)
        elif part.name not in ("details", "span"):  # folded; where a link leads
            yield part


def _has_class(part, kind):
    return kind in part.get("class", ())


def _words_of(blocks, place):
    """The paragraph before an equation, in a list its last point; or else that after it.

    What is after it counts where it comes first in its section.
    """
    heading, _ = blocks[place]
    above, before = blocks[place - 1] if place else (None, None)
    words = before if above is heading else blocks[place + 1][1]
    *_, words = [words, *words.select("li > p")]
    return words


def _pairs(blocks):
    """Each demo, after the prediction that it answers if it has one, as (place, slides).

    The prediction stands above its demo, or below it where the demo opens the chapter, whose first
    part has no other.
    """
    box = under = None
    for place, (heading, part) in enumerate(blocks):
        box, under = box if heading is under else None, heading
        if part.select_one(".vmc-predict"):
            box = part
        elif _has_class(part, "vmc-demo"):
            if heading.name == "h1":
                below = [p for h, p in blocks[place + 1 :] if h is heading]
                if not any(_has_class(p, "vmc-demo") for p in below):
                    box = box or next((p for p in below if p.select_one(".vmc-predict")), None)
            for folded in part.select(".vmc-live-form .vmc-more"):
                folded["open"] = ""  # a class calls out what each of its sliders should be
            name = _plain_heading(heading)
            ask = [Slide([name, box], [ALONE, *_answers(box)], PAIR / 2, True)] if box else []
            notes = _guide(part, box) + _texts(blocks, heading)
            yield place, [*ask, Slide([name, part], notes, PAIR / 2, True)]
            box = None


ALONE = (
    "<p><strong>Ask.</strong> Everybody writes an answer, alone; then neighbours compare; then "
    "hands up. Do not comment.</p>"
)


def _plain_heading(heading):
    """A chapter's title as a section's, above the demo that opens it."""
    return f"<h2>{heading.decode_contents()}</h2>" if heading.name == "h1" else heading


def _guide(demo, box):
    """What to ask before a demo is moved, what to look for in it, and where to stop: paragraphs."""
    control = demo.select_one(".vmc-controls :is(legend, label)")
    question = "What do you see?"
    if box:
        question = box.legend.decode_contents()
    elif control:
        question = f"Before <em>{control.get_text().strip()}</em> moves: what will change?"
    caption = demo.figcaption.decode_contents() if demo.figcaption else "What changes."
    stop = box.select_one("details p").decode_contents() if box else "When the class can say why."
    prompts = {"Ask": question, "Look for": caption, "Stop at": stop}
    return [f"<p><strong>{word}.</strong> {text}</p>" for word, text in prompts.items()]


def _texts(parts, heading):
    """The paragraphs and lists under a heading."""
    return [part for above, part in parts if above is heading and part.name in ("p", "ul", "ol")]


def sentence(paragraph):
    """The first sentence of a paragraph or a list: to the first full stop outside its markup."""
    return f"<p>{sentences(paragraph)[0]}</p>"


def sentences(paragraph):
    """The sentences of a paragraph, or of the first point of a list, each as HTML."""
    found = [""]
    for part in (paragraph.select_one("li > p") or paragraph).contents:
        if isinstance(part, Tag):
            found[-1] += str(part)
            continue
        if isinstance(part, Comment):
            continue
        start = 0
        for stop in FULL_STOP.finditer(part):
            found[-1] += escape(part[start : stop.end()])
            found.append("")
            start = stop.end()
        found[-1] += escape(part[start:])
    return [text.strip() for text in found if text.strip()]


def _answers(part):
    """The answers of a prediction or a quiz, as paragraphs."""
    return [
        f"<p>{folded.summary.decode_contents()}: {folded.p.decode_contents()}</p>"
        for folded in part.select("fieldset details, details.vmc-right, details.vmc-wrong")
    ]
