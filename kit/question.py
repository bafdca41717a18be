"""Question templates: a text with numbers to draw, the formula of its answer, and its variants.

For example:

    @numeric("m", hint="speed × time", tolerance=0.1)
    def distance(speed=steps(1, 9, 0.5), seconds=(10, 20)):
        '''A car drives {seconds} s at {speed} m/s. How far does it come?'''
        return speed * seconds

A question with a picture has a function that draws the same numbers; its docstring is the text for
those who do not see it:

    @picture(journey)
    @numeric("m")
    ...
"""

import io
from collections import ChainMap
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from html import escape
from inspect import signature
from math import floor, log10
from typing import NamedTuple
from zlib import crc32

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

VARIANTS = 5
DRAWS = 20  # for each variant, at most
STYLE = {"axes.spines.top": False, "axes.spines.right": False, "font.size": 9}
# Room for every picture's words: a layout found anew for each takes as long as its drawing
MARGINS = {"left": 0.14, "right": 0.97, "bottom": 0.19, "top": 0.96}


@dataclass(frozen=True)
class Picture:
    """A drawing of a question's numbers, and the text for those who do not see it."""

    alt: str
    numbers: dict = field(compare=False)
    draw: Callable  # of axes and these numbers

    @property
    def figure(self):
        """The drawing, a new matplotlib figure."""
        with mpl.rc_context(mpl.rcParamsDefault | STYLE):
            figure = Figure(figsize=(5, 3.2), dpi=90)
            self.draw(figure.subplots(gridspec_kw=MARGINS), **self.numbers)
        return figure

    @cached_property
    def png(self):
        """The drawing as PNG (bytes), the same each time."""
        file = io.BytesIO()
        with mpl.rc_context(mpl.rcParamsDefault | STYLE):
            self.figure.savefig(file, metadata={"Software": None})
        return file.getvalue()


class Question(NamedTuple):
    """A question in plain text, or in HTML, and its right answer."""

    text: str
    answer: float | str  # a number, or the right one of the choices
    tolerance: float = 0.0  # of a number, in its own unit
    unit: str = ""
    hint: str = ""  # shown after the answer
    choices: tuple = ()  # texts; none where a number is wanted
    feedback: tuple = ()  # of each choice, if each has its own
    level: str = "apply"  # or "understand", or "predict": what is asked of a student
    html: bool = False
    picture: Picture | None = None

    @property
    def content(self):
        """What no two variants share: the text, and the numbers in the picture."""
        return f"{self.text} {self.picture.numbers}" if self.picture else self.text

    def with_picture(self, source):
        """The question as HTML, with its picture from the address `source`."""
        image = f'<p><img src="{source}" alt="{escape(self.picture.alt)}"></p>'
        return self._replace(
            text=f"<p>{escape(self.prompt)}</p>{image}",
            unit="",
            answer=escape(self.answer) if self.choices else self.answer,
            hint=escape(self.hint),
            choices=tuple(map(escape, self.choices)),
            html=True,
        )

    @property
    def prompt(self):
        """The text, with the unit of the answer."""
        return f"{self.text} (in {self.unit})" if self.unit else self.text

    def with_choice_at(self, place):
        """The question with its right choice at a place, counted around; the others in order."""
        old, count = self.choices.index(self.answer), len(self.choices)
        order = [k for k in range(count) if k != old]
        order.insert(place % count, old)
        choices, feedback = (
            tuple(texts[k] for k in order if texts) for texts in (self.choices, self.feedback)
        )
        return self._replace(choices=choices, feedback=feedback)

    def decimal(self, number):
        """A number as plain decimals, to a hundredth of the tolerance: platforms read no 1e-15."""
        digits = max(0, 2 - floor(log10(self.tolerance))) if self.tolerance else 0
        return f"{number:.{digits}f}"


@dataclass(frozen=True)
class Template:
    """A question whose numbers are drawn.

    The docstring of `formula` is the text; {name} in it stands for a parameter or for a constant of
    the module. A parameter's default is what it is drawn from: a sequence of values, or a function
    of an rng. The formula returns the answer, or the answer and a dictionary of further words.
    """

    formula: Callable
    unit: str = ""
    hint: str = ""
    tolerance: float | None = None  # None: one per cent of the answer
    choices: tuple = ()  # texts like the docstring; the formula returns the index of the right one
    zero: bool = False  # whether 0 may be the answer; else such numbers are drawn again
    draw: Callable | None = None  # of axes and the numbers; its docstring is the alternative text

    @property
    def name(self):
        """The question's name in the bank."""
        return self.formula.__name__

    def question(self, rng):
        """A `Question` with numbers drawn by `rng`; ValueError where it has no one right answer."""
        parameters = signature(self.formula).parameters.items()
        numbers = {name: _draw(parameter.default, rng) for name, parameter in parameters}
        answer = self.formula(**numbers)
        answer, words = answer if isinstance(answer, tuple) else (answer, {})
        names = {name: _as_list(value) for name, value in (numbers | words).items()}
        names = ChainMap(names, self.formula.__globals__)
        text = _fill(self.formula, names)
        picture = self._picture(numbers, names) if self.draw else None
        if self.choices:
            choices = tuple(choice.format_map(names) for choice in self.choices)
            if answer not in range(len(choices)) or len({*choices}) < len(choices):
                raise ValueError(f"{text!r}: choice {answer} is not the one right one of {choices}")
            right = choices[int(answer)]
            return Question(
                text, right, hint=self.hint, choices=choices, level="understand", picture=picture
            )
        if not np.isfinite(answer):
            raise ValueError(f"the answer to {text!r} is {answer}: draw other numbers")
        answer = float(answer)
        tolerance = 0.01 * abs(answer) if self.tolerance is None else self.tolerance
        return Question(text, answer, tolerance, self.unit, self.hint, picture=picture)

    def _picture(self, numbers, names):
        _, *drawn = signature(self.draw).parameters  # the first are the axes
        shown = {name: numbers[name] for name in drawn}
        return Picture(_fill(self.draw, names), shown, self.draw)

    def variants(self, count=VARIANTS, seed="", without=()):
        """The first `count` questions that differ, the same at every call with this `seed`.

        The empty seed draws the public bank. None has a `content` in `without`. Raises ValueError
        where there are fewer.
        """
        start = [crc32(text.encode()) for text in (self.name, seed) if text]
        questions = {}
        for draw in range(DRAWS * count):
            question = self.question(np.random.default_rng([*start, draw]))
            if question.choices:
                question = question.with_choice_at(start[-1] + len(questions))
            unclear = not question.choices and abs(question.answer) <= 10 * question.tolerance
            if not (unclear and not self.zero) and question.content not in without:
                questions.setdefault(question.content, question)
            if len(questions) == count:
                return list(questions.values())
        raise ValueError(f"{self.name} has no {count} variants: let it draw from more numbers")


def _fill(function, names):
    """A function's docstring as one line, with names in braces filled in."""
    return " ".join(function.__doc__.split()).format_map(names)


def _draw(domain, rng):
    return domain(rng) if callable(domain) else domain[rng.integers(len(domain))]


def _as_list(value):
    """An array as a list, which prints without NumPy's name."""
    return value.tolist() if isinstance(value, np.ndarray) else value


def numeric(unit="", hint="", tolerance=None, zero=False):
    """Decorator: a `Template` for a number, by default to one per cent."""
    return lambda formula: Template(formula, unit, hint, tolerance, zero=zero)


def count(unit="", hint=""):
    """Decorator: a `Template` for a whole number, with no tolerance."""
    return numeric(unit, hint, tolerance=0)


def choice(*choices, hint=""):
    """Decorator: a `Template` whose formula returns the index of the right choice."""
    return lambda formula: Template(formula, hint=hint, choices=choices)


def picture(draw):
    """Decorator: a `Template` with a picture, which `draw` draws on axes from the numbers."""
    return lambda template: replace(template, draw=draw)


def steps(low, high, step, zero=None):
    """Numbers from low to high, both included, as short in print as the step; `zero` for any 0."""
    numbers = [round(low + step * k, 6) for k in range(round((high - low) / step) + 1)]
    return [x if x or zero is None else zero for x in numbers]


def tenths(low, high, count):
    """A function of an rng: so many numbers (count,), drawn evenly, to one decimal."""
    return lambda rng: np.round(rng.uniform(low, high, count), 1)


def successes(sizes, groups=1):
    """A function of an rng: how many of n succeed, at least half, in each group; n of `sizes`."""

    def draw(rng):
        n = sizes[rng.integers(len(sizes))]
        return *(n // 2 + int(rng.integers(n - n // 2 + 1)) for _ in range(groups)), n

    return draw
