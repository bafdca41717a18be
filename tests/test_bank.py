"""The bank of questions: variants that differ, and what a template may say."""

import re
from collections import Counter
from math import isfinite

import numpy as np
import pytest

from kit.__main__ import CHAPTERS, ROOT
from kit.bank import bank, templates
from kit.question import VARIANTS, Question, choice, numeric, picture, steps

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
    assert len({question.content for question in every}) == len(every)
    for question in every:
        assert question.picture or re.search(r"\d", question.text)
        assert not re.search(r"nan|np\.|array\(|[{}]|\(s\)", question.text)
        assert not re.search(
            r"(?<![\w.])1 (joint|dimension|block|layer|lesson|link)s\b", question.text
        )
        if question.choices:
            assert question.choices.count(question.answer) == 1
        else:
            assert isfinite(question.answer)
            assert 0 <= question.tolerance <= abs(question.answer) / 10 or question.answer == 0


def test_a_quadrant_is_named_as_one_says_it(questions):
    for question in questions["09_planning", "nearest_in_its_quadrant"]:
        named = r"from the quadrant (above|below) and (in front of|behind) it\?$"
        assert re.search(named, question.text)


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


# ---------------------------------------------------------------- pictures

PICTURES = {name: template for name, template in TEMPLATES.items() if template.draw}


def test_a_picture_is_drawn_from_the_numbers_and_is_small():
    def line(axes, high):
        """A line up to {high}, {word}."""
        axes.plot([0, high])

    @picture(line)
    @numeric("m")
    def top(high=(2, 3, 4), add=(1,)):
        """The line ends how far below {sum}?"""
        return add, {"word": "so", "sum": high + add}

    several = top.variants(3)
    assert {q.picture.alt for q in several} == {f"A line up to {high}, so." for high in (2, 3, 4)}
    assert all(question.picture.numbers.keys() == {"high"} for question in several)
    files = {question.picture.png for question in several}
    assert len(files) == 3
    assert top.variants(3)[0].picture.png in files  # drawn anew
    shown = several[0].with_picture("a.png")
    assert shown.html
    assert f'<img src="a.png" alt="{several[0].picture.alt}">' in shown.prompt


@pytest.mark.parametrize("name", PICTURES)
def test_what_a_picture_says_in_words_names_no_one_choice(name, questions):
    [several] = [several for (_, key), several in questions.items() if key == name]
    for question in several:
        alt = question.picture.alt
        named = [re.search(rf"\b{re.escape(choice)}", alt) for choice in question.choices]
        assert sum(map(bool, named)) != 1, alt
        assert not re.search(r"nan|np\.|array\(|[{}]", alt)


@pytest.mark.audit
@pytest.mark.parametrize("name", PICTURES)
def test_no_word_of_a_picture_is_cut(name, questions):
    [several] = [several for (_, key), several in questions.items() if key == name]
    for question in several:
        figure = question.picture.figure
        [axes] = figure.axes
        figure.draw_without_rendering()
        x0, y0, x1, y1 = axes.get_tightbbox().extents
        assert 0 < min(x0, y0)
        assert x1 < figure.bbox.width
        assert y1 < figure.bbox.height


def test_each_aim_of_the_course_has_pictures_that_ask_for_it():
    text = (ROOT / "kit/assistants.md").read_text(encoding="utf-8")
    aims = re.findall(r"^(\d)\. ", text, re.M)
    rows = dict(re.findall(r"^\| (\d) \|.*\|(.*)\|$", text, re.M))
    names = {aim: re.findall(r"`(\w+)`", row) for aim, row in rows.items()}
    assert [*names] == aims
    assert min(map(len, names.values())) >= 3
    assert sorted(name for row in names.values() for name in row) == sorted(PICTURES)
    assert len(PICTURES) >= 40
