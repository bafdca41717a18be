"""The bank of questions: variants that differ, and what a template may say."""

import re
from collections import Counter
from math import isfinite

import numpy as np
import pytest

from kit.__main__ import CHAPTERS
from kit.bank import bank, templates
from kit.question import VARIANTS, Question, choice, numeric, steps

TEMPLATES = {
    template.name: template for chapter in CHAPTERS for template in templates(chapter.stem)
}


@pytest.fixture(scope="module")
def questions():
    return bank()


def test_the_bank_covers_every_chapter(questions):
    chapters = Counter(chapter for chapter, _ in questions)
    assert chapters.keys() == {path.stem for path in CHAPTERS}
    assert min(chapters.values()) >= 5
    assert len(questions) == len(TEMPLATES) >= 100  # no name twice


def test_every_variant_is_another_question_with_an_answer(questions):
    assert {len(variants) for variants in questions.values()} == {VARIANTS}
    every = [question for variants in questions.values() for question in variants]
    assert len({question.text for question in every}) == len(every)
    for question in every:
        assert re.search(r"\d", question.text)
        assert not re.search(r"nan|np\.|array\(|[{}]|\(s\)", question.text)
        assert not re.search(
            r"(?<![\w.])1 (joint|dimension|block|layer|lesson|link)s\b", question.text
        )
        if question.choices:
            assert question.choices.count(question.answer) == 1
        else:
            assert isfinite(question.answer)
            assert 0 <= question.tolerance <= abs(question.answer) / 10 or question.answer == 0


def test_the_right_choice_has_no_place_of_its_own(questions):
    for variants in questions.values():
        if variants[0].choices:
            places = {question.choices.index(question.answer) for question in variants}
            assert len(places) == min(len(variants), len(variants[0].choices))


def test_only_marked_questions_have_the_answer_zero(questions):
    for (_, name), variants in questions.items():
        for question in variants:
            if not question.choices and abs(question.answer) <= question.tolerance:
                assert TEMPLATES[name].zero


def test_the_bank_is_the_same_at_every_call(questions):
    assert bank() == questions


def test_a_text_takes_numbers_words_and_constants():
    @numeric("m", hint="Multiply.", tolerance=0.1)
    def distance(speed=(3,), seconds=lambda rng: np.arange(10, 11)):
        """For {seconds} s at {speed} m/s, {VARIANTS} {what}:
        how far?"""
        return speed * seconds[0], {"what": "times"}

    question = distance.question(np.random.default_rng(0))
    assert question == Question("For [10] s at 3 m/s, 5 times: how far?", 30, 0.1, "m", "Multiply.")


def test_a_bad_template_is_refused(rng):
    @numeric()
    def infinite(n=(1, 2)):
        """How many are {n}?"""
        return float("nan")

    @choice("a", "b")
    def third(n=(1, 2)):
        """Which of {n}?"""
        return 2

    @numeric()
    def single(n=(1, 2)):
        """How many?"""
        return n

    with pytest.raises(ValueError, match="draw other numbers"):
        infinite.question(rng)
    with pytest.raises(ValueError, match="choice 2 is not the one right one"):
        third.question(rng)
    with pytest.raises(ValueError, match="single has no 5 variants"):
        single.variants()


def test_steps_include_both_ends():
    assert steps(-0.2, 0.2, 0.1, zero=0.5) == [-0.2, -0.1, 0.5, 0.1, 0.2]
