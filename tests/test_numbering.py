"""Numbers of equations: which of them a text names."""

import pytest

from book._ext.numbering import equations_named


@pytest.mark.parametrize(
    ("text", "numbers"),
    [
        ("By Eq.\n5, 2/3 and 1/3", {5}),
        ("Eqs. 3 and 5", {3, 5}),
        ("Eq. 6–8", {6, 7, 8}),
        ("Eq. 6 to 8", {6, 7, 8}),
        ("(Eq.\u00a04); Eq. 9", {4, 9}),
        ("5 muscles", set()),
    ],
)
def test_a_text_names_equations_one_by_one_or_from_one_to_another(text, numbers):
    assert equations_named(text) == numbers
