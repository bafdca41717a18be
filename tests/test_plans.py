"""Plans of a course: every chapter once, and no more to read than an hour a session."""

import pytest

from book.figures.inventory import core_minutes
from book.figures.plans import PLANS, minutes, sections
from tests.project import CHAPTERS, each_chapter


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


def test_the_core_of_a_session_is_read_in_an_hour():
    sessions = (tuple(session.read) for plan in PLANS.values() for session in plan)
    assert [(read, minutes(read)) for read in sessions if not 0 < minutes(read) <= 60] == []
