"""The page of plans: a course of six, eight or twelve sessions, section by section."""

from book.figures.inventory import title_and_minutes
from book.figures.plans import BOOK, MORE, NAMES, PLANS, sections
from kit.session import MINUTES

INTRODUCTION = """# Plans: six, eight or twelve sessions of ninety minutes

All three are made from the chapters' words, demos and exercises, and from the tag *optional* of a
section. *Read* is the core of some chapters, or a part of it, before the session, at 43 words a
minute. The others are shown in class, from the slides, and whoever likes can read them. *Demos* is
the time that all demos of what is read take, 5 minutes each: the slides hold a choice of them, and
the minutes at a chapter's head count them, too. *Exercises*, of what is read, come after the
session. *Hours* are a student's, all in all: the session, what is read, the exercises; a project
takes about ten more.

*Slides* names the decks with these chapters. There are decks of the six sessions only, and one of
the chapters that these leave out. In a longer course stop a deck at a chapter's title, and go on
there the next time. Of a chapter that the six sessions read in part, the decks show that part.
"""
HEAD = """| session | read | read (min) | show | slides | demos (min) | exercises (min) |
|-|-|-|-|-|-|-|"""


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
        f"{_titles(session.shown)} | {_decks(session)} | {session.minutes('demos'):.0f} | "
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


def _decks(session):
    """Links to the decks that show a session's chapters."""
    decks = {f"session-{k}": six.chapters for k, six in enumerate(PLANS[6], 1)} | {"more": MORE}
    names = [name for name, held in decks.items() if {*held} & {*session.chapters}]
    return ", ".join(f"[{name.split('-')[-1]}](slides/{name}.html)" for name in names)


def _titles(chapters):
    return "; ".join(title_and_minutes(BOOK / f"{chapter}.ipynb")[0] for chapter in chapters)


def _sections():
    """Each chapter's sections: the core, what is optional, and the minutes to read of each.

    Exercises are no reading.
    """
    for chapter in NAMES:
        yield f"### {_titles([chapter])}\n"
        for part in sections(chapter):
            title = part.title if part.core else f"*{part.title}* (optional)"
            minutes = f"{part.read:.0f}" if part.read >= 0.5 else "under 1"
            if part.title != "Exercises":
                yield f"- {title}: {minutes} min"
        yield ""
