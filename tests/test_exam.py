"""A private exam: other numbers than the public bank's and than another seed's."""

import re

import pytest

from kit import exam
from kit.bank import bank


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


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        (("", 5), "the seed '' is empty"),
        (("a", 5, (), ["a"]), "the seed 'a' is empty, or one that it must be unlike"),
        (("a", 5, ["7"]), "no chapter '7': give some of 01, 02"),
    ],
)
def test_what_cannot_be_an_exam_is_named(settings, words):
    with pytest.raises(ValueError, match=re.escape(words)):
        exam.exam(*settings)


def test_its_files_are_written_and_the_sheet_has_no_answer(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(exam, "print_sheets", lambda folder: None)
    exam.main([str(tmp_path), "--seed", "a", "--only", "07", "--variants", "40"])
    assert "Left out, for want of other numbers: flicker" in capsys.readouterr().out
    sheet, key = (
        (tmp_path / f"{name}.html").read_text(encoding="utf-8") for name in ("exam", "exam-key")
    )
    questions = exam.exam("a", 40, ["07"])
    for [question, *_] in questions.values():
        answer = question.decimal(question.answer) if not question.choices else question.answer
        assert f"<strong>{answer}" in key
    assert sheet.count("Answer: ____") == sum(not q.choices for [q, *_] in questions.values())
    assert (tmp_path / "questions.gift").stat().st_size > 1000
    with pytest.raises(SystemExit, match="no chapter '99'"):
        exam.main([str(tmp_path), "--seed", "a", "--only", "99"])
