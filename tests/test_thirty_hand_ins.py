"""Thirty hand-ins of every kind, of one chapter: one row each, and the points that they earn."""

import csv
import io
import json
import re
import subprocess
import sys
from time import perf_counter

import nbformat
import pytest
from nbformat.v4 import new_code_cell

from kit.__main__ import CHAPTERS
from kit.student import student
from tests.project import ROOT

CHAPTER = next(path for path in CHAPTERS if path.stem == "07_muscle")
ANSWERS = """from book.exercises.muscle import ACTIVATION_RATES, ACTIVATION_TO_HOLD
activation_rates = ACTIVATION_RATES.right
activation_to_hold = ACTIVATION_TO_HOLD.right
answer = 0.8"""
KNOWN = "activation_rates = [*ACTIVATION_RATES.mistakes.values()][0]"

PDF, CANNOT = b"%PDF-1.7\n%\xe2\xe3", "cannot be marked"


def code(notebook):
    return [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]


def handed_in(*lines, answers=ANSWERS):
    """What a student hands in, as JSON: the chapter with `answers` before each check, and `lines`.

    The lines run in a cell of their own before the first check.
    """
    notebook = student(nbformat.read(CHAPTER, as_version=4))
    cells = []
    for cell in notebook.cells:
        graded = cell.cell_type == "code" and "graded" in cell.metadata.get("tags", ())
        cells += [new_code_cell(answers)] if graded else []
        cells.append(cell)
    first = next(k for k, cell in enumerate(cells) if cell.source == answers)
    cells[first:first] = [new_code_cell(line) for line in lines]
    return json.loads(nbformat.writes(nbformat.from_dict(notebook | {"cells": cells})))


def changed(change, *lines):
    """A right hand-in, after a change in place."""
    notebook = handed_in(*lines)
    change(notebook)
    return notebook


def without_heading(notebook):
    notebook["cells"][0]["source"] = "# My work"


def bare(notebook):
    notebook["nbformat_minor"] = 4
    for cell in notebook["cells"]:
        del cell["id"]
        cell["metadata"] = {}


def colab(notebook):
    notebook["metadata"] = {"colab": {"provenance": []}, "kernelspec": {"name": "python3"}}
    for cell in notebook["cells"]:
        cell["metadata"] |= {"id": "x1", "outputId": "y2", "colab": {"height": 35}}


def vs_code(notebook):
    notebook["metadata"] = {"language_info": {"name": "python", "version": "3.9.1"}}
    for cell in notebook["cells"]:
        cell["metadata"] |= {"vscode": {"languageId": "python"}}


def of_another_language(notebook):
    spec = {"name": "ir", "display_name": "R", "language": "R"}
    notebook["metadata"] = {"kernelspec": spec}


def with_outputs(notebook):
    for cell in code(notebook):
        cell["outputs"] = [{"output_type": "stream", "name": "stdout", "text": "x" * 20_000}]


def without_checks(notebook):
    graded = [c for c in code(notebook) if "graded" in c["metadata"].get("tags", ())]
    notebook["cells"] = [cell for cell in notebook["cells"] if cell not in graded]


def twice(notebook):
    notebook["cells"] += [dict(cell, id=f"again-{k}") for k, cell in enumerate(code(notebook)[-2:])]


def forged(notebook):
    for cell in code(notebook):
        if "graded" in cell["metadata"].get("tags", ()):
            cell["source"] = "print('✓ Right.')"


def dumped(notebook, **settings):
    return json.dumps(notebook, **settings).encode()


def hand_ins():
    """Every kind, by the file's name: what it holds, and its points, or how its row begins."""
    right = handed_in()
    whole = dumped(right)
    return {
        "right": (right, 6),
        "Müller 张": (right, 6),
        "CAPITALS.IPYNB": (right, 6),
        "no heading": (changed(without_heading), 6),
        "no metadata": (changed(bare), 6),
        "from colab": (changed(colab), 6),
        "from vs code": (changed(vs_code), 6),
        "of R": (changed(of_another_language), 6),
        "with outputs": (changed(with_outputs), 6),
        "windows": (dumped(right, indent=1).replace(b"\n", b"\r\n"), 6),
        "with a mark of order": (b"\xef\xbb\xbf" + whole, 6),
        "in UTF-16": (json.dumps(right).encode("utf-16"), CANNOT),
        "checks deleted": (changed(without_checks), 6),
        "checks forged": (changed(forged), 6),
        "checks twice": (changed(twice), 6),
        "as handed out": (handed_in(answers="pass"), 0),
        "a known mistake (1)": (handed_in(answers=f"{ANSWERS}\n{KNOWN}"), 5),
        "two are missing": (handed_in(answers=f"{ANSWERS}\nanswer = activation_rates = None"), 2),
        "one is wrong": (handed_in(answers=f"{ANSWERS}\nanswer = 0.5"), 4),
        "a comma for the point": (handed_in(answers=f"{ANSWERS}\nanswer = '0,8'"), 6),
        "floods": (handed_in("for _ in range(100_000): print('flood')"), 6),
        "loops": (handed_in("while True: pass"), 6),
        "asks": (handed_in("input('your name?')"), 6),
        "raises": (handed_in("import no_such_module"), 6),
        "leaves": (handed_in("import sys; sys.exit(1)"), 6),
        "dies": (handed_in("import os; os._exit(1)"), CANNOT),
        "writes": (handed_in("open('numpy.py', 'w').write('no')"), 6),
        "cut": (whole[:-300], CANNOT),
        "empty": (b"", CANNOT),
        "a PDF": (PDF, CANNOT),
    }


def write(folder, contents):
    for name, content in contents.items():
        file = folder / (name if name.endswith("IPYNB") else f"{name}.ipynb")
        file.write_bytes(content if isinstance(content, bytes) else dumped(content))


@pytest.mark.audit
def test_thirty_hand_ins_are_thirty_rows(tmp_path):
    by_name = hand_ins()
    assert len(by_name) == 30
    write(tmp_path, {name: content for name, (content, _) in by_name.items()})
    start = perf_counter()
    command = [sys.executable, "-m", "kit.marks", str(tmp_path), "--by", "file", "--jobs", "2"]
    table = subprocess.run(command, cwd=ROOT, capture_output=True, check=True).stdout
    taken = perf_counter() - start
    rows = list(csv.DictReader(io.StringIO(table.decode("utf-8-sig"))))
    earned = {re.split(r"[/\\]", row["file"])[-1].removesuffix(".ipynb"): row for row in rows}
    assert len(rows) == 30
    wrong = {
        name: row["points"] or row["not right"][:80]
        for name, row in earned.items()
        if not _as_expected(row, by_name[name][1])
    }
    assert wrong == {}
    print(f"thirty hand-ins in {taken:.0f} s")


def _as_expected(row, expected):
    if isinstance(expected, str):
        return row["not right"].startswith(expected)
    return float(row["points"]) == expected
