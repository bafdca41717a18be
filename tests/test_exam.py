"""A private exam: other numbers than the public bank's and than another seed's."""

import ast
import re
from collections import Counter
from inspect import getsource

import pytest

from book.figures.plans import NAMES
from kit import exam
from kit.bank import bank, templates
from kit.page import markdown_page


def contents(questions):
    return {question.content for variants in questions.values() for question in variants}


def test_two_seeds_ask_the_same_of_other_numbers():
    first = exam.exam("a", 5, ["07", "11"])
    second = exam.exam("b", 5, ["07", "11"], unlike=["a"])
    assert first == exam.exam("a", 5, ["07", "11"])
    assert len(second) >= len(first) - 2  # templates that have no other numbers left
    assert second.keys() <= first.keys()
    public = contents(bank())
    assert (
        not contents(first) & contents(second)
        | contents(first) & public
        | contents(second) & public
    )


def test_a_third_exam_repeats_neither_of_two():
    """The second was drawn unlike the first, and so are its questions when the third looks."""
    first = exam.exam("a", 5, ["07", "11"])
    second = exam.exam("b", 5, ["07", "11"], unlike=["a"])
    third = exam.exam("c", 5, ["07", "11"], unlike=["a", "b"])
    assert third
    assert not contents(third) & (contents(first) | contents(second))


def given(question):
    """How many numbers a question gives, and how many choices."""
    return len(re.findall(r"\d+(?:\.\d+)?", question.prompt)), len(question.choices)


def operations(template):
    """How many operations a template's formula writes out; a call counts as one."""
    [formula] = ast.parse(getsource(template.formula)).body
    parts = [part for line in formula.body for part in ast.walk(line)]
    return sum(isinstance(part, ast.BinOp | ast.Compare | ast.Call) for part in parts)


def test_two_exams_of_the_whole_bank_share_no_item_and_are_equally_hard():
    first, second = exam.exam("a", 1), exam.exam("b", 1, unlike=["a"])
    steps = {(name, one.name): operations(one) for name in NAMES for one in templates(name)}
    totals = [sum(steps[key] for key in drawn) for drawn in (first, second)]
    assert second.keys() == first.keys()  # none is left out for want of other numbers
    assert totals[1] == totals[0]
    for key, [other] in second.items():
        [one] = first[key]
        assert one.content != other.content
        assert given(one) == given(other)


def test_more_than_a_third_of_the_bank_asks_several_steps():
    counts = [operations(template) for name in NAMES for template in templates(name)]
    assert sum(count >= 3 for count in counts) > len(counts) / 3


def test_an_exam_on_paper_ends_with_the_equations_that_it_names():
    questions = exam.exam("a", 1, ["07", "09"])
    text = exam.sheet(questions)
    asked, equations = text.split("## The equations")
    named = {int(number) for number in re.findall(r"Eq\. (\d+)", asked)}
    assert {int(tag) for tag in re.findall(r"tag\{(\d+)\}", equations)} == named
    assert {5, 9, 10, 11} <= named
    assert "##" not in exam.sheet(exam.exam("a", 1, ["03"]))


def test_a_key_ends_with_both_equations_of_a_hint():
    name = "10_offline", "change_of_a_weight"
    _, equations = exam.sheet({name: bank()[name]}, key=True).split("## The equations")
    assert re.findall(r"tag\{(\d+)\}", equations) == ["6", "7"]


def test_a_question_on_paper_is_one_block_with_boxes_and_no_dots():
    """A page's end parts no question from its picture, its choices or its line."""
    questions = exam.exam("a", 1, ["07"])
    for key in (False, True):
        page = markdown_page("exam", exam.sheet(questions, key))
        blocks = re.findall(r'<div class="whole">(.*?)</div>', page, re.S)
        for block, [question, *_] in zip(blocks, questions.values(), strict=False):
            assert block.count("☐") == len(question.choices)
            assert block.count("<img") == bool(question.picture)
            assert ("Answer: ____" in block) == (not question.choices and not key)
        assert ("Name: ____" in page, "Date: ____" in page) == (not key, not key)
        assert ".whole, tr { break-inside: avoid; }" in page
        assert ".whole ul { padding: 0; list-style: none; }" in page


def test_a_short_exam_asks_of_every_chapter_the_same_with_the_same_seed():
    questions = exam.exam("a", 1, ["07", "08", "09"])
    short = exam.shorten(questions, 7, "a")
    counts = Counter(chapter for chapter, _ in short)
    assert sorted(counts.values()) == [2, 2, 3]
    assert short == exam.shorten(questions, 7, "a")
    assert [*short] == [name for name in questions if name in short]
    assert short.keys() != exam.shorten(questions, 7, "b").keys()
    with pytest.raises(ValueError, match=r"0 of .* questions: ask for 1 to"):
        exam.shorten(questions, 0, "a")


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        (("", 5), "the seed '' is empty"),
        (("a", 5, (), ["a"]), "the seed 'a' is empty, or one that it must be unlike"),
        (("a", 0), "0 variants of each question make no exam: ask for 1 or more"),
        (("a", 5, ["7"]), "no chapter '7': give some of 01, 02"),
    ],
)
def test_what_cannot_be_an_exam_is_named(settings, words):
    with pytest.raises(ValueError, match=re.escape(words)):
        exam.exam(*settings)


def test_its_files_are_written_and_the_sheet_has_no_answer(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(exam, "print_sheets", lambda folder: None)
    exam.main([str(tmp_path), "--seed", "a", "--only", "07", "--variants", "16"])
    assert "Left out, for want of other numbers: flicker" in capsys.readouterr().out
    sheet, key = (
        (tmp_path / f"{name}.html").read_text(encoding="utf-8") for name in ("exam", "exam-key")
    )
    questions = exam.exam("a", 16, ["07"])
    for [question, *_] in questions.values():
        answer = question.decimal(question.answer) if not question.choices else question.answer
        assert f"<strong>{answer}" in key
    assert sheet.count("Answer: ____") == sum(not q.choices for [q, *_] in questions.values())
    assert (tmp_path / "questions.gift").stat().st_size > 1000
    with pytest.raises(SystemExit, match="no chapter '99'"):
        exam.main([str(tmp_path), "--seed", "a", "--only", "99"])


@pytest.mark.parametrize("only", ["7,8", "07, 08"])
def test_chapters_may_be_named_as_one_writes_them(only, tmp_path, monkeypatch):
    monkeypatch.setattr(exam, "print_sheets", lambda folder: None)
    words = ["--seed", "a", "--variants", "1", "--questions", "4"]
    exam.main([str(tmp_path), *words, "--only", only])
    text = (tmp_path / "questions.gift").read_text(encoding="utf-8")
    asked = re.findall(r"course\$/(\d+)_", text)
    pictures = (tmp_path / "exam.html").read_text(encoding="utf-8").count("<img")
    assert len(asked) + pictures == 4  # GIFT holds none
    assert {*asked} <= {"07", "08"}


def test_no_exam_is_written_into_a_file(tmp_path):
    (tmp_path / "a").touch()
    with pytest.raises(SystemExit, match="a is a file: name a folder"):
        exam.main([str(tmp_path / "a"), "--seed", "b", "--only", "07", "--variants", "1"])


def test_no_exam_is_written_over_another(tmp_path):
    (tmp_path / "exam.html").touch()
    with pytest.raises(SystemExit, match=re.escape(f"the folder {tmp_path} is not empty")):
        exam.main([str(tmp_path), "--seed", "b", "--only", "07", "--variants", "1"])
    assert [file.name for file in tmp_path.iterdir()] == ["exam.html"]
