"""Numbers in a chapter's prose, held to its run.

`the two still overlap by 0.68<!--{tenth:.2f}-->` reads 0.68 in every notebook. The comment holds
what an f-string would: here it is evaluated among the chapter's own names, and must give the word
before it, or the words since `<!--[-->`. A bool is not written anywhere: it must be true.
"""

import re

import numpy as np
from nbformat.v4 import new_code_cell

from vmc_lib.show.markup import minus

NUMBER = re.compile(
    r"(?:<!--\[-->(?P<words>[^<]*)|(?P<word>[^\s>*(]*)\**)"
    r"<!--\{(?P<value>.+?)(?::(?P<form>[-+.,%\w]*))?\}-->"
)
COMMENT = re.compile(r"<!--(?:\[|\{.+?\})-->")

CHECK = "import vmc_lib.show.prose as _prose\n_prose.check_numbers({!r}, globals())"
UPDATE = "import vmc_lib.show.prose as _prose\nprint(_prose.update({!r}, globals()), end='')"


def evaluate(number, names):
    """The text that a match of `NUMBER` must have; None where it needs none, and is true.

    ValueError where what has to be true is false.
    """
    value = eval(number["value"], {**names, "nearest": nearest})  # noqa: S307  (the chapter's own)
    if not isinstance(value, bool | np.bool_):
        return minus(format(value, number["form"] or ""))
    if not value:
        raise ValueError(f"the text needs {number['value']}, and the run says that it is false")
    return None


def update(text, names):
    """The text with its numbers as the run has them."""

    def rewrite(number):
        value = evaluate(number, names)
        part = "word" if number["words"] is None else "words"
        start, end = (place - number.start() for place in number.span(part))
        return number[0] if value is None else number[0][:start] + value + number[0][end:]

    return NUMBER.sub(rewrite, text)


def check_numbers(text, names):
    """Raise ValueError where a number of the text is another in the run, with both."""
    numbers = [(one, evaluate(one, names)) for one in NUMBER.finditer(text)]
    both = [(one["words"] or one["word"], value) for one, value in numbers]
    if wrong := [pair for pair in both if pair[1] not in (None, pair[0])]:
        raise ValueError("; ".join(f"the text says {a!r}, the run {b!r}" for a, b in wrong))


def nearest(value, *choices):
    """The choice, among numbers, that is nearest to a value."""
    return min(choices, key=lambda choice: abs(choice - value))


def with_code(cells, line):
    """A notebook's cells, each with numbers in its prose replaced by code: a `line` of its text."""
    return [_code(cell, line) if _has_numbers(cell) else cell for cell in cells]


def _has_numbers(cell):
    return cell.cell_type == "markdown" and NUMBER.search(cell.source)


def _code(cell, line):
    first, *_ = cell.source.splitlines()
    return new_code_cell(f"# {first}\n{line.format(cell.source)}", id=cell.id)
