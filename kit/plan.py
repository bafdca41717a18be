"""The page of plans: a course of six, eight or twelve sessions, section by section."""

from book.figures.inventory import title_and_minutes
from book.figures.plans import BOOK, NAMES, PLANS, sections
from kit.session import MINUTES

INTRODUCTION = """# Plans: six, eight or twelve sessions of ninety minutes

All three are made from the chapters' words, demos and exercises, and from the tag *optional* of a
section. *Read* is the core of some chapters, or a part of it, before the session, at 43 words a
minute. The others are shown in class, from the slides, and whoever likes can read them. *Demos* is
the time that all demos of what is read take, 5 minutes each: the slides hold a choice of them, and
the minutes at a chapter's head count them, too. *Exercises*, of what is read, come after the
session. *Hours* are a student's, all in all: the session, what is read, the exercises; a project
takes about ten more.
"""
HEAD = """| session | read | min | show | demos (min) | exercises (min) |
|-|-|-|-|-|-|"""


def plans():
    """The page as Markdown."""
    return "\n".join([INTRODUCTION, *map(_plan, PLANS), "## The sections\n", *_sections()])


def hours(count):
    """What a course of so many sessions takes a student, in hours, without a project."""
    homework = (session.minutes() + session.minutes("exercises") for session in PLANS[count])
    return (MINUTES * count + sum(homework)) / 60


def _plan(count):
    rows = [
        f"| {number} | {_read(session)} | {session.minutes():.0f} | "
        f"{_titles(session.shown)} | {session.minutes('demos'):.0f} | "
        f"{session.minutes('exercises'):.0f} |"
        for number, session in enumerate(PLANS[count], start=1)
    ]
    taken = {chapter for session in PLANS[count] for chapter in session.chapters}
    left = _titles(name for name in NAMES if name not in taken)
    without = f"\nNot in it: {left}\n" if left else ""
    head = f"## {count} sessions, about {hours(count):.0f} hours\n"
    return "\n".join([head, HEAD, *rows, without])


def _read(session):
    """The chapters that are read; of those in part, their sections."""
    return "; ".join(
        f"{_titles([name])} (only *{'*, *'.join(session.parts[name][1:])}*)"
        if name in session.parts
        else _titles([name])
        for name in session.read
    )


def _titles(chapters):
    return "; ".join(title_and_minutes(BOOK / f"{chapter}.ipynb")[0] for chapter in chapters)


def _sections():
    """Each chapter's sections: the core, what is optional, and the minutes to read of each."""
    for chapter in NAMES:
        yield f"### {_titles([chapter])}\n"
        for part in sections(chapter):
            title = part.title if part.core else f"*{part.title}* (optional)"
            yield f"- {title}: {part.read:.0f} min"
        yield ""
