"""Marks: which exercises are right in notebooks that were handed in, as a table.

`python -m kit.marks FOLDER > marks.csv` runs each of them, so do it where a stranger's code can do
no harm. A mark says where to look, and is good for a pass, not for a grade: whoever wants to can
fool it, and all solutions are public.
"""

import argparse
import asyncio
import csv
import os
import re
import sys
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import nbformat
from joblib import Parallel, delayed
from nbclient import NotebookClient
from nbclient.util import run_sync

from kit.__main__ import CHAPTERS
from kit.marking import RIGHT_MARK, TOO_LONG, WORDS, errors, known_mistakes, mark_of, points
from kit.student import POINTS, checks, place

CELL, NOTEBOOK = 60, 600  # s that each may run
MOST_OUTPUTS, LARGEST_OUTPUT = 1000, 100_000  # of a cell, signs: a check says less
COLUMNS = "file", "exercise", "points", "of", "mark"
BY_FILE = "file", "points", "of", "not right", "for you to read"
GONE = " (the check's cell was deleted)"
MISSING = re.compile(r"NameError: name '(\w+)' is not defined")
# Where a cell may begin, also where the separator is a semicolon, as in much of Europe
FORMULA = re.compile(r"""(^|;)(?=[\s"]*[=+@＝＋－＠-])""")


def marks(chapter, submission, cell_limit=CELL, limit=NOTEBOOK):
    """The mark of each exercise of a chapter's notebook, {label: text}, in a hand-in.

    Runs the hand-in with our own checks in the places of the student's, which are known by the
    exercise in their metadata or, where an editor dropped that, by their source; where a student
    deleted that place, our check runs at the end. Answers in words are left to the lecturer. A cell
    is interrupted after `cell_limit` seconds, one that is as in the chapter after a quarter of
    `limit`; TimeoutError where the whole takes longer than that.
    """
    sources = checks(chapter)
    code = [cell for cell in submission.cells if cell.cell_type == "code"]
    labels = [_label(cell, sources) for cell in code]
    cells = [
        nbformat.v4.new_code_cell(sources.get(label) or cell.source)
        for cell, label in zip(code, labels, strict=True)
    ]
    gone = [label for label, check in sources.items() if check and label not in labels]
    cells += [nbformat.v4.new_code_cell(sources[label]) for label in gone]
    notebook = nbformat.v4.new_notebook(cells=cells)  # with our kernel, whatever the student's was
    # The chapter's own may be slow, but may also call a student's function that never ends
    own = {cell.source for cell in chapter.cells} - {*sources.values()}
    _run(notebook, lambda cell: limit / 4 if cell.source in own else cell_limit, limit)
    results = {label: "" if source else WORDS for label, source in sources.items()}
    known, ran = known_mistakes(chapter), []
    for label, cell in zip(labels + gone, cells, strict=True):
        ran.append(cell)  # since the last check
        if label and results[label] != RIGHT_MARK:  # of two copies, one that is right will do
            mark = _cause(mark_of(cell.outputs, known.get(label, ())), ran)
            slow = any(map(_was_interrupted, ran))
            mark = TOO_LONG.format(cell_limit) if slow and not points(mark) else mark
            results[label] = mark if label not in gone or mark == RIGHT_MARK else mark + GONE
        if label:
            ran = []
    return results


def _cause(mark, cells):
    """A mark; if that is a missing name, the first error of the cells in which the name stands."""
    missing = MISSING.match(mark)
    named = [cell for cell in cells if missing and re.search(rf"\b{missing[1]}\b", cell.source)]
    return next((error for cell in named for error in errors(cell.outputs)), mark)


def _was_interrupted(cell):
    return any(output.get("ename") == "KeyboardInterrupt" for output in cell.outputs)


class _Client(NotebookClient):
    """Keeps little of what a hand-in shows, which may have no end, and nothing that it prints."""

    def output(self, outs, msg, *place):
        large = len(outs) >= MOST_OUTPUTS or len(repr(msg["content"])) > LARGEST_OUTPUT
        if msg["msg_type"] == "error" or not (msg["msg_type"] == "stream" or large):
            return super().output(outs, msg, *place)


@run_sync
async def _run(notebook, limit_of, limit):
    """Run all cells as a reader's, in an empty folder, from which Python imports nothing."""
    limits = {"timeout_func": limit_of, "interrupt_on_timeout": True, "allow_errors": True}
    quiet = ["--IPKernelApp.log_level=ERROR"]  # or each kernel warns that loopback is plain
    client = _Client(notebook, store_widget_state=False, extra_arguments=quiet, **limits)
    fresh = partial(TemporaryDirectory, ignore_cleanup_errors=True)
    with fresh() as folder, fresh() as settings:  # IPython's: the next hand-in finds others
        try:
            async with asyncio.timeout(limit) as clock:
                own = {"PYTHONSAFEPATH": "1", "VMC_RENDER_MODE": "live", "IPYTHONDIR": settings}
                own |= {"OMP_NUM_THREADS": "1"}  # more only wait for each other
                environment = os.environ | own
                await client.async_execute(cwd=folder, env=environment)
        except Exception as error:
            if clock.expired():  # a cell may refuse to be interrupted
                raise TimeoutError(f"it ran longer than {limit} s") from error
            raise


def _label(cell, sources):
    """The exercise that a code cell of a hand-in has the place of, or None.

    In the book's own notebook that is the check itself.
    """
    label, source = cell.metadata.get("exercise"), cell.source.strip()
    checked = [label for label, check in sources.items() if check]
    own = {text: label for label in checked for text in (place(label), sources[label])}
    return label if label in checked else own.get(source)


def chapter_of(submission, name):
    """The notebook of the chapter that was handed in.

    It is known by its first heading, by its exercises, or by the number that `name`, the file's,
    begins with. ValueError where none of these tells it.
    """
    text = "\n".join(cell.source for cell in submission.cells if cell.cell_type == "markdown")
    signs = [heading.strip() for heading in re.findall(r"^# .*", text, re.M)[:1]]
    labels = [cell.metadata.get("exercise") for cell in submission.cells]
    signs += [label for label in labels if isinstance(label, str)]
    signs += map(int, re.findall(r"^\d+", name))
    chapters = {}
    for path in CHAPTERS:
        chapter = nbformat.read(path, as_version=4)
        own = (
            chapter.cells[0].source.splitlines()[0],
            *checks(chapter),
            int(path.name.split("_")[0]),
        )
        chapters |= dict.fromkeys(own, chapter)
    for sign in signs:
        if sign in chapters:
            return chapters[sign]
    raise ValueError(
        "no chapter has its first heading, its exercises, or the number that its name begins with"
    )


def rows(path):
    """A hand-in's rows: one an exercise and one for its sum, or one that says why it has none."""
    try:
        text = path.read_text(encoding="utf-8-sig")  # PowerShell begins a text with a mark
        submission = _notebook(text)
        results = marks(chapter_of(submission, path.name), submission)
    except Exception as error:  # whatever is wrong with one file, the others are marked
        reason, *_ = str(error).split("\n")
        return [(path, "", "", "", f"cannot be marked ({type(error).__name__}: {reason})")]
    earned = [points(mark) for mark in results.values() if mark != WORDS]
    return [
        *((path, label, points(mark), POINTS, mark) for label, mark in results.items()),
        (path, "all that is checked", sum(earned), POINTS * len(earned), ""),
    ]


def _notebook(text):
    """The notebook that a text holds; ValueError where it holds something else."""
    try:
        return nbformat.reads(text, as_version=4)
    except (AttributeError, TypeError) as error:  # of a list, for example
        raise ValueError("it holds no notebook") from error


def file_row(several):
    """The rows of one hand-in as one row: its points, what is not right, and what is to be read."""
    *exercises, (path, _, earned, of, error) = several
    wrong = [
        f"{label}: {mark}" for _, label, _, _, mark in exercises if mark not in (RIGHT_MARK, WORDS)
    ]
    read = [label for _, label, _, _, mark in exercises if mark == WORDS]
    return [(path, earned, of, error or "; ".join(wrong), ", ".join(read))]


def plain(cell):
    """A cell as one line of text, which no spreadsheet takes for a formula."""
    line = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in str(cell))
    return FORMULA.sub(r"\1'", line)


def main():
    """Write the table of the notebooks in some folders: CSV, UTF-8, with Excel's mark of that."""
    parser = argparse.ArgumentParser(prog="python -m kit.marks", description=__doc__)
    parser.add_argument("folders", nargs="+", type=Path, metavar="FOLDER", help="or a notebook")
    parser.add_argument("--jobs", type=int, default=1, help="notebooks that run at once")
    parser.add_argument("--by", choices=("exercise", "file"), default="exercise", help="rows")
    options = parser.parse_args()
    if options.jobs < 1:
        parser.error("--jobs: give 1 or more")
    if missing := [folder for folder in options.folders if not folder.exists()]:
        sys.exit(f"there is no folder {missing[0]}")
    found = sorted({path for folder in options.folders for path in (folder, *folder.rglob("*"))})
    own = [path for path in found if ".ipynb_checkpoints" not in path.parts]
    named = [path for path in own if path.suffix.lower() == ".ipynb"]
    handed_in = [path for path in named if path.is_file() or not path.exists()]  # or a dead link
    files = [path for path in own if path.is_file() or path in named]
    for path in files:
        if path not in handed_in:
            print(f"not marked, for it is no notebook: {plain(path)}", file=sys.stderr)
    if not handed_in:
        folders = ", ".join(map(str, options.folders))
        sys.exit(f"no notebooks under {folders}: use python -m kit.marks FOLDER > marks.csv")
    sys.stdout.reconfigure(encoding="utf-8-sig", newline="")
    table = csv.writer(sys.stdout)
    table.writerow(BY_FILE if options.by == "file" else COLUMNS)
    marked = Parallel(options.jobs, return_as="generator")(map(delayed(rows), handed_in))
    for several in marked:
        for row in file_row(several) if options.by == "file" else several:
            table.writerow(map(plain, row))
        sys.stdout.flush()


if __name__ == "__main__":
    main()
