"""Plans of a course in six, eight and twelve sessions, from the chapters' cells and their tags.

A section whose heading's cell carries the tag `optional` is optional, the others are core. Reading
comes before a session, the demos are played in it, and the exercises come after.
"""

import re
from pathlib import Path
from typing import NamedTuple

import nbformat

from book.figures.inventory import core, reading_and_demos

BOOK = Path(__file__).parents[1]
HEAD = re.compile(r"^##+ (.+)$", re.M)
EXERCISE = 10  # minutes
CONTENTS = (BOOK.parent / "_toc.yml").read_text(encoding="utf-8")
NAMES = re.findall(r"file: book/(\d\w+)$", CONTENTS, re.M)  # of the chapters; no reader's copy
MORE = [name for name in NAMES if name > "15"]  # for those who want more


class Session(NamedTuple):
    """Chapters to be read before a session, and those that are only shown in it, from slides.

    Of a chapter in `parts`, {name: titles}, only these sections are read, and no other is shown.
    """

    read: list
    shown: list
    parts: dict

    @property
    def chapters(self):
        """All of them, in the book's order."""
        return sorted([*self.read, *self.shown])

    def sections(self):
        """The `Section`s that are read; ValueError where a part is none of its chapter's core."""
        for chapter in self.read:
            core_sections = {part.title: part for part in sections(chapter) if part.core}
            titles = self.parts.get(chapter, core_sections)
            if missing := [title for title in titles if title not in core_sections]:
                raise ValueError(f"{chapter} has no core sections {missing}: {[*core_sections]}")
            yield from (core_sections[title] for title in titles)

    def headings(self, chapter):
        """All headings of what is read of a chapter in part; None for any other."""
        if chapter in self.parts:
            read = Session([chapter], [], self.parts).sections()
            return [heading for section in read for heading in section.headings]
        return None

    def minutes(self, kind="read"):
        """Minutes of these sections: to "read", or for "demos" or "exercises"."""
        return sum(getattr(section, kind) for section in self.sections())


def _session(numbers, shown="", parts=None):
    """The session of chapters, by their numbers."""
    chosen = ([n for n in NAMES if n[:2] in which.split()] for which in (numbers, shown))
    return Session(*chosen, parts or {})


TITLES = (
    "The whole, and where",
    "From edges to a name",
    "Muscles and an arm",
    "A plan, and its correction",
    "The cerebellum",
    "See and reach; beyond",
)
PARTS_4 = {  # of chapters that are read in part
    "09_planning": (
        "Habitual planning: a new reach from old ones",
        "The hard way, and the lazy way",
        "What the brain does",
        "Two reasons to miss",
        "Recap",
    ),
    "10_offline": (
        "Off-line calibration: learning from a miss",
        "Beside the target",
        "What the brain does",
        "The paper's correction",
        "Does the direction matter?",
        "Recap",
    ),
}
PARTS_5 = {
    "12_while_it_moves": (
        "While it moves: late senses, and a model that foresees",
        "Make it shake, and calm it",
        "A field that bends the way",
        "Recap",
    ),
}
PLANS = {  # by the number of sessions
    6: (
        _session("01", "02 03"),
        _session("04", "05 06"),
        _session("07 08"),
        _session("09 10", parts=PARTS_4),
        _session("11 12", parts=PARTS_5),
        _session("13", "14"),
    ),
    8: (
        _session("01", "02"),
        _session("03"),
        _session("04", "05 06"),
        _session("07 08"),
        _session("09", "10"),
        _session("11"),
        _session("12"),
        _session("13", "14"),
    ),
    12: (
        _session("01", "02"),
        _session("03"),
        _session("04"),
        _session("05 06"),
        _session("07 08"),
        *map(_session, ("09", "10", "11", "12", "13", "14")),
        Session(MORE[-1:], MORE[:-1], {}),
    ),
}


class Section(NamedTuple):
    """A section of a chapter, and its minutes: to read, for its demos, for its exercises.

    Its cells may have several `headings`, of which its title is the first.
    """

    headings: list
    core: bool
    read: float
    demos: float
    exercises: float

    @property
    def title(self):
        """The first heading."""
        return self.headings[0]


def sections(chapter):
    """The `Section`s of a chapter such as "07_muscle", from its title to its recap."""
    cells = nbformat.read(BOOK / f"{chapter}.ipynb", as_version=4).cells
    open_cells = {cell.id for cell in core(cells)}
    parts = [[cells[0]]]
    for cell in cells[1:]:
        if cell.cell_type == "markdown" and HEAD.search(cell.source):
            parts.append([])
        parts[-1].append(cell)
    return [_section(part, part[0].id in open_cells) for part in parts]


def _section(cells, is_core):
    headings = HEAD.findall(cells[0].source) or [cells[0].source.splitlines()[0].strip("# ")]
    exercises = sum("exercise" in cell.metadata for cell in cells)
    names = [heading.strip() for heading in headings]
    return Section(names, is_core, *reading_and_demos(cells), EXERCISE * exercises)
