"""A mark: what the check of an exercise has shown, in words and as points."""

import re
from contextlib import contextmanager

from IPython.utils.capture import capture_output

from kit.key import SOLUTION, exercise_named
from kit.student import POINTS
from vmc_lib.grading import COMMA, NOT_YET, RIGHT, UNREAD
from vmc_lib.show.figures import inline

RIGHT_MARK, WORDS, KNOWN = "right", "in words: for you to read", "a known mistake: "
TOO_LONG = "ran longer than {} s"
LONGEST = 500  # characters of an error
SIGNS = {"ge": "≥", "le": "≤", "cdot": "·", "times": "×", "lVert": "‖", "rVert": "‖"}
CELL_FILE = re.compile(r"(?<=\()\d+\.py, (?=line \d+\)$)")  # the kernel's name for a cell


def known_mistakes(chapter):
    """What the graded exercises say to known mistakes, {label: hints}."""
    found, label = {}, None
    for cell in chapter.cells:
        label = cell.metadata.get("exercise", label)
        if graded := SOLUTION.fullmatch(cell.source):
            found[label] = [*exercise_named(chapter, graded[1]).mistakes]
    return found


def errors(outputs):
    """The errors that a cell's outputs show, each as one text."""
    found = (CELL_FILE.sub("", f"{o['ename']}: {o['evalue']}") for o in outputs if "ename" in o)
    return [text[:LONGEST] for text in found]


def mark_of(outputs, known):
    """The mark that a check's outputs give; `known` are the exercise's hints."""
    text = "".join(output.get("data", {}).get("text/html", "") for output in outputs)
    if RIGHT in text:
        return RIGHT_MARK
    hints = [f"{KNOWN}{_hint_text(hint)}" for hint in known if inline(hint) in text]
    unmarked = {NOT_YET: "not answered", COMMA: f"not read: write it {COMMA}", UNREAD: "not read"}
    states = [state for words, state in unmarked.items() if words in text]
    return " ".join(errors(outputs) or hints[:1] or states[:1]) or "not right"


def _hint_text(hint):
    """A hint, Markdown, without marks; of its maths the letters and the names: "tau_act ≥ u"."""
    text = re.sub(r"\\math\w+ ?|[{}$*`]", "", hint)
    text = re.sub(r"(?<=\d)(?=\\)", " ", text)
    text = re.sub(r"\\(\w+?)(?=\b|_)", lambda name: SIGNS.get(name[1], name[1]), text)
    return re.sub(r"‖ (.+?) ‖", r"‖\1‖", text)


def points(mark):
    """The points of a mark, half for a known mistake; none of ours for an answer in words."""
    if mark == WORDS:
        return ""
    return POINTS * (mark == RIGHT_MARK) + POINTS / 2 * mark.startswith(KNOWN)


@contextmanager
def points_of_check(known):
    """Runs a check, as nbgrader does; yields a function of nothing, which says its points then.

    AssertionError with the mark where it is worth none.
    """
    marks = []
    with capture_output() as shown:
        yield lambda: points(marks[0])
    marks.append(mark_of([{"data": output.data} for output in shown.outputs], known))
    if not points(marks[0]):
        raise AssertionError(marks[0])
