"""Eight questions before and after: a line without a name, and a report that says what it is."""

import re

import numpy as np
import pytest

from kit import concepts
from tests.pages import observe

RIGHT = [item.place for item in concepts.ITEMS]


def line(when, code, choices):
    return f"concepts 1: {when}; {code}; {' '.join(map(str, choices))} end"


def test_eight_items_have_three_choices_and_no_place_gives_the_right_one_away():
    assert len(concepts.ITEMS) == 8
    assert all(len({*item.choices}) == 3 for item in concepts.ITEMS)
    assert all(item.choices[item.place] == item.right for item in concepts.ITEMS)
    assert max(map(RIGHT.count, range(3))) == 3
    longest = [len(item.right) == max(map(len, item.choices)) for item in concepts.ITEMS]
    assert sum(longest) <= 5


def test_only_those_who_answered_twice_count_and_with_their_last_answer():
    none, cut = [-1] * 8, RIGHT[:7]
    lines = [line("before", "A1", RIGHT), line("before", "a1", none), line("after", "A1", RIGHT)]
    lines += [line("after", "b2", RIGHT), line("before", "c3", cut), line("after", "c3", RIGHT)]
    pairs = concepts.read("Ann, 9:02\n" + " thanks\n".join(lines))
    assert pairs.keys() == {"a1"}
    np.testing.assert_array_equal(pairs["a1"], [none, RIGHT])


@pytest.mark.parametrize("odd", ["- - 1", "1-1 2", "9" * 5000, "3 0 1"])
def test_a_line_that_is_none_is_passed_over(odd):
    lines = [line("before", "a1", RIGHT), f"concepts 1: after; a1; {odd} end"]
    assert concepts.read("\n".join([*lines, line("after", "a1", RIGHT)])).keys() == {"a1"}


def test_the_report_has_the_gain_and_what_is_still_thought():
    wrong = [(place + 1) % 3 for place in RIGHT]
    half = RIGHT[:4] + wrong[4:]
    pairs = {code: (half, RIGHT[:7] + wrong[7:]) for code in "abc"}
    pairs["d"] = half, half
    text = concepts.report(pairs)
    assert "4 students, of 8 right before 4.0, after 6.2: +2.2 ± 2.4 (95 %" in text
    last = concepts.ITEMS[-1]
    assert f"| 0 | 0 | {last.choices[wrong[-1]]} (4) |" in text
    assert "SIMULATED" not in text
    with pytest.raises(ValueError, match="2 students answered before and after"):
        concepts.report(dict([*pairs.items()][:2]))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["nowhere.txt"], "nowhere.txt cannot be read: No such file"),
        ([], "give the files with the class's lines, or --simulate"),
        (["--simulate", "3", "lines.txt"], "or --simulate, and not both"),
        (["--simulate", "0"], "--simulate: three or more"),
    ],
)
def test_what_gives_no_report_is_said_in_a_sentence(arguments, words, capsys):
    with pytest.raises(SystemExit) as left:
        concepts.main(arguments)
    assert words in f"{left.value} {capsys.readouterr().err}"


def test_a_simulated_class_gains_what_was_put_in_and_is_marked(capsys):
    concepts.main(["--simulate", "400"])
    text = capsys.readouterr().out
    assert text.startswith("**SIMULATED: nobody gave these answers.**")
    gain = float(re.search(r"[+](\d\.\d) ±", text)[1])
    assert gain == pytest.approx(8 * 0.17 * 2 / 3, abs=0.2)  # a third is guessed anyway


@pytest.mark.browser
def test_the_page_gives_a_line_without_a_name(tmp_path, window):
    (tmp_path / "concepts.html").write_text(concepts.page(), encoding="utf-8")
    page = observe(window().new_page())
    page.goto((tmp_path / "concepts.html").as_uri())
    page.click("#copy")
    assert "First a code" in page.inner_text("#status")
    page.fill("#code", "k; 7")
    page.check("[name=when][value=after]")
    for k, place in enumerate(RIGHT[:7]):
        page.check(f"[name=item-{k}][value='{place}']")
    page.click("#copy")
    page.wait_for_selector("#line:not(:empty)")
    assert page.inner_text("#line") == line("after", "k 7", [*RIGHT[:7], -1])
    assert page.errors == []
