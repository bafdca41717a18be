"""The slides of a chapter, from its built page: one sentence each, the rest in the notes.

A chapter gives its idea, the brain's wiring where it is drawn, its first equation, predictions with
the demos that answer them, questions of its quiz, and its recap with the question that it leaves;
of its exercises only where they are checked, and no demo whose cell carries the tag `off-slides`.
"""

import re
from dataclasses import dataclass, field
from html import escape
from itertools import takewhile
from operator import itemgetter
from typing import NamedTuple

from bs4 import Tag

WRAPPERS = {"cell", "cell_output", "output", "text_html"}  # of a cell's output
WIRING = "What the brain does"  # a section: what it draws, and asks nothing about
EXERCISES = "<p>Exercises: the chapter's page runs and checks your lines. Nothing to install.</p>"
FULL_STOP = re.compile(r"(?<!Eq)(?<!Eqs)(?<!Fig)[.?!](?=\s|$)")


@dataclass
class Slide:
    """A slide: its body, which all see, and the speaker's notes; both as elements of a page."""

    body: list
    notes: list = field(default_factory=list)
    weight: int = 1  # how long it stays, beside the others of its part
    seconds: float = 0

    def __str__(self):
        notes = "".join(map(str, self.notes))
        body = "\n".join(map(str, self.body))
        return (
            f'<section data-timing="{self.seconds:.0f}"><div class="fit">{body}</div>'
            f'<aside class="notes">{notes}</aside></section>'
        )


class Chapter(NamedTuple):
    """The slides of a chapter, each part a list: what it teaches, its quiz, its recap."""

    text: list
    quiz: list
    recap: list


def chapter_slides(article, most):
    """A `Chapter` of at most so many slides, in the page's order; optional sections give none."""
    title, idea, *aims = article.find_all(["h1", "p"], recursive=False)
    *_, last = article.find_all("section", recursive=False)
    exercises = [EXERCISES] if article.select("form[data-function]") else []
    _remove_exercises(article)
    sources = dict.fromkeys(cite["title"] for cite in article.select("cite[title]"))
    cited = "; ".join(f"<cite>{escape(text)}</cite>" for text in sources)
    first = Slide([title, idea], [*aims, f"<details><summary>Sources</summary>{cited}</details>"])
    heading, *text = last.find_all(["h2", "p", "ul"], recursive=False)
    asked = [f"<p>{question}</p>" for question in last.select("p > strong")[-1:]]
    recap = Slide([heading, sentence(text[0]), *asked, *exercises], text)
    blocks = [*_blocks(article)]
    demos = [*_pairs(blocks)]
    wiring = [one for one in demos if len(one[1]) == 1 and WIRING in blocks[one[0]][0].get_text()]
    fixed = [*wiring, *_first_equations(blocks)] if most > 6 else []  # else too few slides for them
    others = [pair for pair in demos if pair not in wiring]
    with_question = [(place, pair) for place, pair in others if len(pair) > 1]
    room = (most - 2 - len(fixed)) // 2  # a title and a question of the quiz apart
    chosen = _spread(with_question if len(with_question) >= room else others, room)
    middle = [slide for _, pair in sorted(fixed + chosen, key=itemgetter(0)) for slide in pair]
    quiz = [Slide([box], _answers(box)) for box in article.select(".vmc-quiz")]
    return Chapter([first, *middle], _spread(quiz, most - 1 - len(middle)), [recap])


def _spread(items, count):
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
    heading, *rest = _unfolded(section)
    for part in rest:
        if part.name != "section":
            yield heading, part
        elif not _is(part, "vmc-optional"):
            yield from _blocks(part)


def _unfolded(section):
    """The elements of a section: outputs out of their cells, without what is folded."""
    for part in section.find_all(recursive=False):
        if _is(part, "tag_off-slides"):
            continue
        if WRAPPERS & {*part.get("class", [])}:
            yield from _unfolded(part)
        elif part.name not in ("details", "span"):  # folded; where a link leads
            yield part


def _is(part, kind):
    return kind in part.get("class", ())


def _first_equations(blocks):
    """A slide of the chapter's first equations that stand together, as [(place, [slide])].

    With the sentence before them, which in a list is that of the last point; where they come first
    in their section, with the sentence after them.
    """
    for place, (heading, part) in enumerate(blocks):
        if _is(part, "math"):
            run = [math for _, math in takewhile(lambda one: _is(one[1], "math"), blocks[place:])]
            above, before = blocks[place - 1]  # a chapter opens with its title
            words = before if above is heading else blocks[place + len(run)][1]
            *_, words = [words, *words.select("li > p")]
            return [(place, [Slide([heading, sentence(words), *run], _texts(blocks, heading))])]
    return []


def _pairs(blocks):
    """Each demo, after the prediction that it answers if it has one, as (place, slides).

    The prediction stands above its demo, or below it where the demo opens the chapter.
    """
    box = under = None
    for place, (heading, part) in enumerate(blocks):
        box, under = box if heading is under else None, heading
        if part.select_one(".vmc-predict"):
            box = part
        elif _is(part, "vmc-demo"):
            if heading.name == "h1":
                below = (p for h, p in blocks[place:] if h is heading)
                box = box or next((p for p in below if p.select_one(".vmc-predict")), None)
            name = _plain_heading(heading)
            ask = [Slide([name, box], [ALONE, *_answers(box)], 2)] if box else []
            notes = _guide(part, box) + _texts(blocks, heading)
            yield place, [*ask, Slide([name, part], notes, 2)]
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
    html = ""
    for part in (paragraph.select_one("li > p") or paragraph).contents:
        end = None if isinstance(part, Tag) else FULL_STOP.search(part)
        html += str(part) if isinstance(part, Tag) else escape(part[: end and end.end()])
        if end:
            break
    return f"<p>{html}</p>"


def _answers(part):
    """The answers of a prediction or a quiz, as paragraphs."""
    return [
        f"<p>{folded.summary.decode_contents()}: {folded.p.decode_contents()}</p>"
        for folded in part.select("fieldset details, details.vmc-right, details.vmc-wrong")
    ]
