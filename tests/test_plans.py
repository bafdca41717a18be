"""Plans of a course: every chapter once, and no more to read than an hour a session."""

import re

import nbformat
import pytest

from book.figures.plans import BOOK, PLANS, Session, sections
from kit.plan import plans
from tests.project import CHAPTERS, core_minutes, each_chapter


def test_a_plan_takes_each_chapter_once_and_in_order():
    """Chapter 12, with its feedback and after-effects, is read in every plan."""
    names = [path.stem for path in CHAPTERS]
    for count, plan in PLANS.items():
        taken = [chapter for session in plan for chapter in session.chapters]
        assert len(plan) == count
        assert taken == names[: len(taken)]
        assert any("12_while_it_moves" in session.read for session in plan)
    assert taken == names


@each_chapter
def test_the_core_sections_add_up_to_the_minutes_of_the_core(path):
    parts = [part for part in sections(path.stem) if part.core]
    assert sum(part.read + part.demos for part in parts) == pytest.approx(core_minutes(path), 0.02)


def test_what_a_session_reads_is_read_in_an_hour():
    read = [(session.read, session.minutes()) for plan in PLANS.values() for session in plan]
    assert [one for one in read if not 0 < one[1] <= 60] == []


def test_each_session_of_each_plan_names_the_decks_of_its_chapters():
    text = plans()
    rows = re.findall(r"^\| \d+ \|.*$", text, re.M)
    decks = [re.findall(r"\((slides/[\w-]+\.html)\)", row) for row in rows]
    numbers = [*range(1, 7), 1, 1, 2, 3, 4, 5, 5, 6, 1, 1, 2, 2, 3, 4, 4, 5, 5, 6, 6, "more"]
    names = [n if n == "more" else f"session-{n}" for n in numbers]
    assert decks == [[f"slides/{name}.html"] for name in names]
    assert "stop a deck at a chapter's title" in text


def test_the_page_of_plans_says_which_minutes_and_never_none():
    text = plans()
    assert text.count("| read (min) |") == len(PLANS)
    assert " 0 min" not in text
    assert "- *What draws the eye by itself* (optional): under 1 min" in text
    assert "- Exercises" not in text


def test_the_last_chapter_of_a_session_asks_its_question_in_bold():
    """Which the lecturer reads aloud: not the word "Next:" alone."""
    for session in PLANS[6]:
        cells = nbformat.read(BOOK / f"{session.chapters[-1]}.ipynb", as_version=4).cells
        [recap] = [cell.source for cell in cells if cell.source.startswith("## Recap")]
        *_, bold = re.findall(r"\*\*([^*]+)\*\*", recap)
        assert "?" in bold, session


def test_what_is_read_in_part_is_some_of_its_core():
    parts = [session for plan in PLANS.values() for session in plan if session.parts]
    assert parts
    for session in parts:
        assert session.parts.keys() <= {*session.read}
        assert session.minutes() < Session(session.read, [], {}).minutes()
    with pytest.raises(ValueError, match=r"07_muscle has no core sections \['Tendons'\]"):
        [*Session(["07_muscle"], [], {"07_muscle": ["Tendons"]}).sections()]


def test_six_sessions_read_both_calibrations_before_they_show_them():
    """And chapter 11, the cerebellum's, as a whole."""
    read = [name for session in PLANS[6] for name in session.read]
    assert {"10_offline", "11_online"} <= {*read}
    assert all("11_online" not in session.parts for session in PLANS[6])
