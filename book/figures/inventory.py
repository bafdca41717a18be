"""What the book holds, counted: its chapters, and the tests of each part of the library."""

import re
from collections import Counter

import nbformat

OF_PAGES = ("tests/test_pages.py", "tests/test_site.py")
DEMO = re.compile(
    r"^(?:\w+ = )?(?:explore|where\.segmentation_demo|live_arm|live_whole_arm)\(", re.M
)
WITH_DEMO = "**Predict.**", "**Figure.**"
UNREAD = re.compile(r"<details>.*?</details>|<!--.*?-->|\]\(.*?\)", re.S)
EXERCISE = {"raises-exception", "solution"}  # tags of the cells below an exercise's text
TEST = re.compile(r"^def test_(\w+)\(", re.M)


def tests_by_folder(root):
    """How many test functions each folder of `root`/tests holds, a Counter; "" is tests itself."""
    counts = Counter()
    for file in (root / "tests").rglob("test_*.py"):
        [folder, *_] = [*file.relative_to(root / "tests").parts[:-1], ""]
        counts[folder] += len(TEST.findall(file.read_text(encoding="utf-8")))
    return counts


def names_of_page_tests(root):
    """The names of the tests that open built pages, as words."""
    source = "".join((root / file).read_text(encoding="utf-8") for file in OF_PAGES)
    return [name.replace("_", " ") for name in TEST.findall(source)]


def chapter_counts(paths):
    """How much of each kind chapters hold: cells, demos, exercises, answers, questions."""
    cells = [cell for path in paths for cell in nbformat.read(path, as_version=4).cells]
    code = "\n".join(cell.source for cell in cells if cell.cell_type == "code")
    return {
        "numbered chapters": len(paths),
        "cells that compute": sum(cell.cell_type == "code" for cell in cells),
        "demos": len(DEMO.findall(code)),
        "questions to answer before them": sum(c.source.startswith("**Predict.**") for c in cells),
        "exercises": sum("exercise" in cell.metadata for cell in cells),
        "checked answers": len(re.findall(r"\bcheck\(", code)),
        "graded functions": len(re.findall(r"\bgrade\(", code)),
        "quiz questions": sum(cell.source.startswith("**Quiz.**") for cell in cells),
    }


def title_and_minutes(path):
    """A page's title, and the reading minutes that its aims state; 0 where it states none."""
    title, *cells = nbformat.read(path, as_version=4).cells
    aims = next((cell.source for cell in (title, *cells) if "be able to" in cell.source), "")
    stated = re.search(r"(\d+)\s+minutes", aims)
    return title.source.splitlines()[0].removeprefix("# "), int(stated[1]) if stated else 0


def core(cells):
    """The cells outside optional sections, whose heading's cell carries the tag `optional`."""
    optional = 0  # the level of the heading that began one
    for cell in cells:
        heading = cell.cell_type == "markdown" and re.match(r"(##+) ", cell.source)
        if heading and (not optional or len(heading[1]) <= optional):
            optional = "optional" in cell.metadata.get("tags", []) and len(heading[1])
        if not optional:
            yield cell


def reading_and_demos(cells):
    """Minutes to read cells and to play with their demos: 43 words a minute, 5 a demo.

    A demo's minutes are its prediction's and its caption's, too. Exercises, quizzes and what is
    folded apart. Fitted to one cold reading of six chapters.
    """
    prose, demos, solving = "", 0, False
    for cell in cells:
        tags = cell.metadata.get("tags", [])
        solving = "exercise" in cell.metadata or (solving and {*tags} & EXERCISE)
        if cell.cell_type == "code":
            demos += len(DEMO.findall(cell.source))
        elif not solving and "remove-cell" not in tags and not cell.source.startswith(WITH_DEMO):
            prose += UNREAD.sub(" ", cell.source)
    return len(re.findall(r"\w+", prose)) / 43, 5 * demos
