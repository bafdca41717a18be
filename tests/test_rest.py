"""No sentence says that a hand or an arm rests that moves faster than 2 mm/s."""

import ast
import re

import nbformat

from tests.project import CHAPTERS, ROOT, code

READ = [CHAPTERS[0], *CHAPTERS[8:], *sorted((ROOT / "book/figures").glob("*.py"))]
BODY = re.compile(r"\b(hand|finger|arm|wrist|elbow)s?\b", re.I)
RESTS = re.compile(
    r"\b(at rest|to rest|rests|rested|settle[sd]?|settling|holds? still|held still|stops?|stopped|"
    r"(stands?|stays?|keeps?|kept|stood|is|are|be|being) (perfectly |quite )?still)\b",
    re.I,
)
DENIED = re.compile(r"\b(not|never|neither|nor|nothing|cannot)\b", re.I)
ALLOWED = {  # a piece of the sentence: why it may say so
    "until the hand comes to rest where it should": "of templates, whose speed "
    "tests/motor/test_templates.py bounds",
}


def texts(path):
    """The prose of a chapter, and every string in its code or in a module's."""
    if path.suffix == ".ipynb":
        cells = nbformat.read(path, as_version=4).cells
        yield from (cell.source for cell in cells if cell.cell_type == "markdown")
    for node in ast.walk(ast.parse(code(path))):
        if isinstance(node, ast.JoinedStr):
            yield "".join(p.value if isinstance(p, ast.Constant) else "…" for p in node.values)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value


def sentences(path):
    for text in texts(path):
        yield from re.split(r"(?<=[.!?:;])\s+|\n\n|\n\||\n- ", text)


def said_to_rest(path):
    """Sentences that say that a part of the body rests, on one line each."""
    for sentence in sentences(path):
        found = RESTS.search(sentence)
        if found and BODY.search(sentence) and not DENIED.search(sentence[: found.start()]):
            yield " ".join(sentence.split())


def test_nothing_that_creeps_is_said_to_rest():
    said = {f"{path.stem}: {sentence}" for path in READ for sentence in said_to_rest(path)}
    assert [line for line in sorted(said) if not any(piece in line for piece in ALLOWED)] == []
    assert [piece for piece in ALLOWED if not any(piece in line for line in said)] == []
