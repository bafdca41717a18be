"""The short path: sittings that are short, and lead from one to the next."""

import re
from functools import cache
from itertools import pairwise
from urllib.parse import urljoin

import pytest
from bs4 import BeautifulSoup
from docutils.nodes import make_id

from book._ext.short_path import PAGES, PIECES, QUIZ, SITTINGS
from book.figures.inventory import title_and_minutes
from tests.pages import BUILT, above_sections
from tools.main_line import article, main_line, words_of

BOOK = BUILT / "book"
each_sitting = pytest.mark.parametrize("sitting", SITTINGS, ids=range(1, len(SITTINGS) + 1))


@cache
def section_words(path):
    """The words of a built page's main line: what stands before its sections ("top"), then each."""
    page = article(path).select_one("section")
    sections = {part.get("id"): part.extract() for part in page.select(":scope > section")}
    return {name: words_of(part) for name, part in {"top": page, **sections}.items()}


def words(piece):
    """The words of a piece, the sections between its ends included."""
    sections = section_words(BOOK / f"{piece.page}.html")
    names = [*sections]
    first = names.index(make_id(piece.first)) if piece.first else 0
    last = names.index(make_id(piece.last)) if piece.last else len(names) - 1
    return sum(sections[name] for name in names[first : last + 1])


@each_sitting
def test_a_sitting_is_short(sitting):
    assert sum(map(words, sitting)) <= 1500


def minutes(piece):
    """Its share of the chapter's own minutes, by its words."""
    path = BOOK / f"{piece.page}.html"
    _, whole = title_and_minutes(BUILT.parents[1] / f"book/{piece.page}.ipynb")
    return whole * words(piece) / main_line(path).words


@each_sitting
def test_a_sitting_takes_about_twenty_minutes(sitting):
    """By the chapters' own clock; the last page states no minutes."""
    assert sum(map(minutes, sitting)) <= 27


@cache
def parsed(page):
    """A built page, parsed once for all pieces of it."""
    return BeautifulSoup((BOOK / f"{page}.html").read_text(encoding="utf-8"), "html.parser")


def test_each_piece_names_the_next():
    for (_, here), (_, then) in pairwise(PIECES):
        soup = parsed(here.page)
        last = soup.find("section", id=make_id(here.last))
        link = last.find_next_sibling().select_one("a")
        assert link.parent["class"] == ["vmc-next-sitting"]
        address = f"{then.page}.html{'#' * bool(then.first)}{make_id(then.first)}"
        assert urljoin(f"{here.page}.html", link["href"]) == address
        further = [soup.select_one(a["href"]) for a in link.find_next_siblings("a")]
        heads = ["Recap", "Quiz"] if here.page != then.page else []
        assert [section.h2.find(string=True) for section in further] == heads
        if heads:  # where the chapter itself ends, too
            *_, end = soup.select(".vmc-next-sitting a")
            assert end["href"] == link["href"]
            assert not end.find_all_next("section")
            assert re.search(r"\w\.$|\?$", end.parent.get_text())


@pytest.mark.parametrize("page", QUIZ)
def test_the_path_says_which_questions_it_answers(page):
    *_, end = parsed(page).select(".vmc-next-sitting:has([href='#quiz'])")
    assert f"the quiz {QUIZ[page]} about what you have read." in end.get_text()


@pytest.mark.parametrize("page", ["01_loop", "03_regions", "13_see_and_reach"])
def test_the_path_is_marked_at_the_side_and_in_the_strip(page):
    soup = above_sections(BOOK / f"{page}.html")
    marked = soup.select(".bd-sidebar-primary a.vmc-short-path")
    here = f"{page}.html"
    assert {urljoin(here, link["href"].rstrip("#")) for link in marked} == {
        f"{name.removeprefix('book/')}.html" for name in PAGES
    }
    numbers = {int(name[5:7]) for name in PAGES if name[5:7].isdigit()}
    strip = soup.select(".vmc-thread li a")
    lit = {n for n, mark in enumerate(strip, 1) if "vmc-short-path" in mark.get("class", [])}
    assert lit == numbers
