"""Does anyone learn? Eight questions before a course and after it, and what a class answered.

`python -m kit.concepts LINES` reads the lines that students copied from `concepts.html`, in a text
file, and writes a report; `--simulate 30` writes one on answers that nobody gave, to show its form.
"""

import argparse
import json
import re
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np

from book._ext.policy import seal
from vmc_lib.statistics import t_interval

ROOT = Path(__file__).parents[1]
LINE = re.compile(r"concepts 1: (before|after); ([^;\n]+); ((?:(?:-1|[0-2]) )+)end")
SIMULATED = "simulated"  # begins the code of an answer that nobody gave


class Item(NamedTuple):
    """A question on a concept: the right choice, then two that a misconception chooses."""

    question: str
    right: str
    wrong: tuple
    place: int  # of the right choice, from 0

    @property
    def choices(self):
        """The choices as they are shown."""
        choices = [*self.wrong]
        choices.insert(self.place, self.right)
        return choices


ITEMS = (
    Item(
        "You bend your elbow, then straighten it. The biceps, which bends it,",
        "pulls for the one, and another muscle pulls for the other",
        ("pulls for the one, and pushes for the other", "pulls for both, in two directions"),
        1,
    ),
    Item(
        "A muscle is told to be half active, and stays so. Its force",
        "depends on its length and on how fast that changes, too",
        ("is half of its greatest, in every posture", "is half of its greatest, once it moves"),
        2,
    ),
    Item(
        "Someone cannot say what lies before her, but grasps it at once, in the right place. So",
        "what a thing is and where it is are told by partly different ways through the brain",
        (
            "she must know all the same what it is: nobody can grasp what nobody has recognised",
            "her eyes see only a blur",
        ),
        0,
    ),
    Item(
        "A program knows all the photos that it has practised with. How it does with new photos",
        "is open: it may know the old ones by heart",
        ("is known: as well", "is known: badly, for it has never seen them"),
        2,
    ),
    Item(
        "Goggles shift all you see to the right. You throw until you hit again. Now they come off. "
        "Your first throw",
        "lands on the other side than your first one with the goggles",
        ("hits, as before", "lands on the same side as your first one with the goggles"),
        1,
    ),
    Item(
        "Your eyes tell you a tenth of a second late where your hand is. You correct more strongly "
        "what they tell. The hand",
        "may begin to swing about its target",
        ("comes to rest on its target sooner", "does the same: the report is right, if late"),
        0,
    ),
    Item(
        "Without a working cerebellum a person",
        "moves, misses, and hardly learns from the misses",
        ("cannot move", "moves as well as before, but cannot plan"),
        2,
    ),
    Item(
        "Way A misses by 4 mm in one trial, way B by 5 mm in another. Which is better?",
        "That is open: one trial each does not tell",
        ("A", "They are equally good: 1 mm is too little to matter"),
        1,
    ),
)


def page():
    """The page with the questions, which gives each student a line to copy."""
    html = (ROOT / "kit/pages/concepts.html").read_text(encoding="utf-8")
    items = [{"question": item.question, "choices": item.choices} for item in ITEMS]
    return seal(html.replace("/*ITEMS*/[]", json.dumps(items).replace("<", "\\u003c")))


def read(text):
    """The choices of those who answered twice, {code: (before, after)}, each (8,), -1 for none.

    Who answered a questionnaire more than once counts with the last.
    """
    found = {"before": {}, "after": {}}
    for when, code, line in LINE.findall(text):
        choices = np.array([int(choice) for choice in line.split()])
        if len(choices) == len(ITEMS):
            found[when][code.strip().lower()] = choices
    before, after = found.values()
    return {code: (before[code], after[code]) for code in before if code in after}


def report(pairs):
    """What a class answered before and after, as Markdown; ValueError for fewer than three."""
    if len(pairs) < 3:
        raise ValueError(f"{len(pairs)} students answered before and after: three or more, please")
    chosen = np.array([*pairs.values()])  # (students, before and after, items)
    right = chosen == [item.place for item in ITEMS]
    score = right.sum(axis=2)
    gain, half = t_interval(score[:, 1] - score[:, 0])
    lines = [
        f"{len(pairs)} students, of {len(ITEMS)} right before {score[:, 0].mean():.1f}, after "
        f"{score[:, 1].mean():.1f}: {gain:+.1f} ± {half:.1f} (95 % interval of the mean).",
        "",
        "| question | right before | right after | what most of the others chose, after |",
        "|-|-|-|-|",
    ]
    for k, item in enumerate(ITEMS):
        counts = [(chosen[:, 1, k] == c).sum() * (c != item.place) for c in range(3)]
        most = f"{item.choices[np.argmax(counts)]} ({max(counts)})" if max(counts) else ""
        before, after = right[:, :, k].sum(axis=0)
        lines.append(f"| {item.question} | {before} | {after} | {most} |")
    lines += ["", "No group without the course: what else these weeks taught is in it."]
    if any(code.startswith(SIMULATED) for code in pairs):
        lines = ["**SIMULATED: nobody gave these answers.**", "", *lines]
    return "\n".join(lines) + "\n"


def simulate(count, rng):
    """Lines as from a class of so many, who know the half before and two thirds after."""
    lines = []
    for student_number in range(count):
        for when, share in (("before", 0.5), ("after", 0.67)):
            known = rng.random(len(ITEMS)) < share
            guesses = rng.integers(3, size=len(ITEMS))
            choices = np.where(known, [item.place for item in ITEMS], guesses)
            numbers = " ".join(map(str, choices))
            lines.append(f"concepts 1: {when}; {SIMULATED}-{student_number}; {numbers} end")
    return "\n".join(lines)


def main(arguments=None):
    """Write the report of some files, or of simulated answers."""
    parser = argparse.ArgumentParser("python -m kit.concepts", description=__doc__)
    parser.add_argument("files", nargs="*", type=Path, metavar="LINES")
    parser.add_argument("--simulate", type=int, help="so many students")
    asked = parser.parse_args(arguments)
    if asked.simulate is not None and asked.simulate < 3:
        parser.error("--simulate: three or more")
    if bool(asked.files) == (asked.simulate is not None):
        parser.error("give the files with the class's lines, or --simulate, and not both")
    try:
        text = "\n".join(file.read_text(encoding="utf-8") for file in asked.files)
        if asked.simulate:
            text = simulate(asked.simulate, np.random.default_rng(0))
        print(report(read(text)))
    except OSError as error:
        sys.exit(f"{error.filename} cannot be read: {error.strerror}")
    except ValueError as error:
        sys.exit(str(error))


if __name__ == "__main__":
    main()
