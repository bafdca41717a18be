"""The slides of a session by the clock: its parts, as the page on teaching times them.

Students do something on every `active` slide; a prediction takes five minutes with its demo, and
there are as many of them as the ninety minutes leave room for.
"""

import re
from copy import copy
from html import escape
from itertools import cycle, pairwise

from bs4 import BeautifulSoup

from book._ext.numbering import equations_named
from kit.chapter_slides import MINUTE, PAIR, Slide, sentences

MINUTES = 90  # of a session
TIMED = re.compile(r"(\w[\w ]*) \((\d+) minutes\)")


def deck(title, chapters, read, runs, plan):
    """The slides of a session, {part: [Slide]}, from its `Chapter`s by name; `read` are those read.

    `runs` is the page on teaching's list of what a session consists of, `plan` its section on this
    one. Raises ValueError where the section leads to a demo that no slide can show.
    """
    fixed = {word: MINUTE * int(count) for word, count in TIMED.findall(runs.get_text())}
    lists = plan.select("ul")
    items = [item for part in lists for item in part.select("li")]
    in_class, board, line = (item for item in items if TIMED.search(item.em.get_text()))
    heads = (chapter.title.body[0].get_text() for chapter in chapters.values())
    contents = "".join(f"<li>{head}</li>" for head in heads)
    begin = Slide([f"<h1>{escape(title)}</h1><ul>{contents}</ul>"], [runs, *map(copy, lists)])
    *_, last = chapters.values()
    for before, after in pairwise(chapters.values()):
        after.title.notes += ["<p>Before it:</p>", *before.recap.notes]
    for name in chapters.keys() - {*read}:
        chapters[name].wiring.clear()
    parts = {
        "Begin": _share_time([begin], fixed["Begin"]),
        "In class": _class_slides(in_class, chapters),
        "Predict and drag": [],
        "One equation": _board_slides(board, chapters),
        "Break": _share_time([_break_slide(runs, fixed["Break"])], fixed["Break"]),
        "One cell": [_cell_slide(line, chapters)],
        "Quiz": _share_time(_quiz_slides([chapters[name].quiz for name in read]), fixed["Quiz"]),
        "Next": _share_time(
            [_next_slide([chapters[name].recap for name in read], last)], fixed["Next"]
        ),
    }
    taken = sum(slide.seconds for slides in parts.values() for slide in slides)
    parts["Predict and drag"] = _predict(list(chapters.values()), MINUTE * MINUTES - taken)
    return parts


def clock(parts):
    """A list, HTML, of when each part of a deck begins, and of how long students act."""
    lines, number, seconds = [], 1, 0
    for part, slides in parts.items():
        lines.append(f"<li>{part}: from minute {seconds / MINUTE:.0f}, slide {number}</li>")
        number, seconds = number + len(slides), seconds + sum(slide.seconds for slide in slides)
    active = sum(one.seconds for slides in parts.values() for one in slides if one.active)
    lines.append(f"<li>Students do something in {active / MINUTE:.0f} minutes of {MINUTES}.</li>")
    return f"<ul>{''.join(lines)}</ul>"


def make_room(parts):
    """Give a lecturer's own slides a minute each, at the cost of the predictions and demos."""
    own = [slide for slides in parts.values() for slide in slides if not slide.seconds]
    rest = [slide for slide in parts["Predict and drag"] if slide.seconds]
    left = 1 - MINUTE * len(own) / sum(slide.seconds for slide in rest)
    for slide in rest:
        slide.seconds *= left
    for slide in own:
        slide.seconds = MINUTE


def _share_time(slides, seconds):
    """Slides that share so many seconds."""
    for slide in slides:
        slide.seconds = seconds / len(slides)
    return slides


def _lesson_slide(item):
    """The slide of a part that the page on teaching names, and what it says after a sentence."""
    name, minutes = TIMED.search(item.em.get_text()).groups()
    notes = copy(item)
    item.em.decompose()
    first, *rest = sentences(item.p)
    return Slide([f"<h2>{name}</h2>", f"<p>{first}</p>"], [notes], MINUTE * int(minutes)), rest


def _class_slides(item, chapters):
    """Its slide, and the demos to which it has links, each by its section or by its chapter.

    The slide itself leads to a page of the kit that the item names. The last demo takes half.
    """
    links = [(link["data-to"].split(".html")[0], link) for link in item.select("[data-to]")]
    pages = dict.fromkeys(re.findall(r"\w+\.html", item.get_text()))
    slide, _ = _lesson_slide(item)
    slide.body += [f'<p><a href="../{page}" target="_blank">{page}</a></p>' for page in pages]
    demos = [one for name, link in links for one in chapters[name].demo_of(link.get_text())]
    slide.active = True
    half = slide.seconds / 2 if demos else 0
    return [
        *_share_time([slide, *demos[:-1]], slide.seconds - half),
        *_share_time(demos[-1:], half),
    ]


def _board_slides(item, chapters):
    """The equations that it names, then its question, with them and the answer step by step."""
    numbers = equations_named(item.get_text())
    slide, steps = _lesson_slide(item)
    equations = [one for chapter in chapters.values() for one in chapter.equations(numbers)]
    lines = [part for one in equations for part in one.body[2:]]
    text = "".join(f'<p class="fragment">{step}</p>' for step in steps)
    maths = "".join(map(str, lines))
    slide.body.append(
        f'<div class="board"><div>{maths}</div><div>{text}</div></div>' if maths else text
    )
    slide.seconds -= sum(one.seconds for one in equations)
    return [*equations, slide]


def _cell_slide(item, chapters):
    """Its question, with the cell of the chapters that it quotes, the line in it marked."""
    line = item.code.get_text() if item.code else None
    slide, _ = _lesson_slide(item)
    slide.active = True
    cells = [cell for chapter in chapters.values() for cell in chapter.cells]
    for cell in [cell for cell in cells if line and line in cell.get_text()][:1]:
        lines = [
            f"<mark>{html}</mark>"
            if line in BeautifulSoup(html, "html.parser").get_text()
            else html
            for html in cell.pre.decode_contents().split("\n")
        ]
        code = "\n".join(lines)
        slide.body.append(f'<div class="highlight"><pre>{code}</pre></div>')
    return slide


def _break_slide(runs, seconds):
    [item] = (item for item in runs.select("li") if "Break" in item.strong.get_text())
    return Slide(["<h2>Break</h2>", f"<p>{seconds // MINUTE} minutes.</p>"], [copy(item)])


def _quiz_slides(quizzes):
    """Two questions: of two chapters the last and the middle one, of one its first and last.

    None of these asks of what is left out of a chapter that is read in part.
    """
    if len(quizzes) == 1:
        return [quizzes[0][0], quizzes[0][-1]]
    first, second = quizzes
    return [first[-1], second[len(second) // 2]]


def _next_slide(recaps, last):
    """What the chapters that were read say in a sentence, and what the last one leaves open."""
    heading, gist, *asked = last.recap.body
    gists = [recap.body[1] for recap in recaps if recap is not last.recap] + [gist]
    notes = [note for recap in recaps for note in recap.notes if recap is not last.recap]
    return Slide([heading, *gists, *asked], [*notes, *last.recap.notes])


def _predict(chapters, seconds):
    """Titles, wiring and predictions with their demos: a minute or more, and five, five."""
    wiring = [slide for chapter in chapters for _, pair in chapter.wiring for slide in pair]
    room = seconds - sum(slide.seconds for slide in wiring) - MINUTE * len(chapters)
    left, counts = room // PAIR, [0] * len(chapters)
    for place in cycle(range(len(chapters))):
        if not left or all(len(one.asked) == n for one, n in zip(chapters, counts, strict=True)):
            break
        if counts[place] < len(chapters[place].asked):
            counts[place], left = counts[place] + 1, left - 1
    rest = room - PAIR * sum(counts)
    for chapter in chapters:
        chapter.title.seconds += rest / len(chapters)
    texts = (chapter.text(count) for chapter, count in zip(chapters, counts, strict=True))
    return [slide for text in texts for slide in text]
