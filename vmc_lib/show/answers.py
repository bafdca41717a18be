"""Typed answers: the numbers that a reader's text says, in the unit that is asked for.

The rules are data: questions.js follows the same ones where an answer is typed into a page.
"""

import math
import re
import unicodedata

import numpy as np

_NUMBER = r"[-+]?(?:[0-9]+(?:[.,][0-9]*)?|[.,][0-9]+)(?:e[-+]?[0-9]+)?"
# Patterns that Python and JavaScript read alike
RULES = {
    "clean": [  # what is replaced by what, in this order
        ("((?<=[0-9])[¼½¾⅐-⅞]|[⁺⁻]?[⁰¹²³⁴-⁹]+)", "^$1"),  # made plain digits after each step
        ("[\"'“”‘’()[\\]{}]", ""),
        ("[−–]", "-"),
        ("⁄", "/"),
        (r"\*\*", "^"),
        (r"(^|[,;]\s*)(?:[^,;=≈~]*[=≈~]|about\b|ca\b\.?)\s*", "$1"),
        (r"([0-9.,])\s*[·⋅×*x]\s*10\s*\^\s*", "$1e"),
        (r"(^|[^0-9.,])10\^(?=[-+]?[0-9])", "$11e"),
        (r"\s*(?:[×&]|\band\b)\s*|([0-9])\s*x\s*(?=[0-9])", "$1; "),
        (r"\s*/\s*", "/"),
        (r"^\s+|[\s.,;!]+$", ""),
    ],
    "gaps": [r";\s*|,?\s+(?=[-+.,0-9])", r"[;,]\s*|\s+(?=[-+.,0-9])"],  # in "0,5 0,8", in "190,95"
    # No digit in a unit but its power's: "20/tan(60)" is a formula
    "number": rf"({_NUMBER})(?:/({_NUMBER}))?\s*"
    r"([^\s0-9.,;:^+-](?:[^\s0-9]|\^-?[0-9]+|\s(?![0-9]))*)?",
}
_QUANTITIES = (
    {
        "km kilometre kilometer": 1e3,
        "m metre meter": 1.0,
        "cm centimetre centimeter": 1e-2,
        "mm millimetre millimeter": 1e-3,
        "μm micrometre micrometer": 1e-6,
    },
    {"min minute": 60.0, "s sec second": 1.0, "ms millisecond": 1e-3},
    {"rad radian": 1.0, "° deg degree": math.pi / 180},
    {"1 time": 1.0, "% percent": 0.01},
    {"pixel px": 1.0},
)


def judge(text, expected, tolerance, unit=""):
    """How a typed answer is: "right", "wrong", "unread", or in another "unit".

    `expected` is a number or a sequence of them, in `unit`; a number may be off by `tolerance`.
    """
    expected = np.ravel(expected)
    parts = [re.fullmatch(RULES["number"], part) for part in _split(_clean(text), len(expected))]
    if len(parts) != len(expected) or not all(parts):
        return "unread"
    scales = scales_of(unit)
    factors = [scales.get(_singular(part[3] or "")) for part in parts]
    if None in factors:
        return "unit"
    values = np.multiply([_value(*part.groups("1")) for part in parts], factors)
    slack = tolerance + 1e-9 * abs(expected)  # of a conversion
    return "right" if (abs(values - expected) <= slack).all() else "wrong"


def scales_of(unit):
    """How many of `unit` a unit of its kind is, {spelling: number}; "" is `unit` itself."""
    for quantity in _QUANTITIES:
        scales = {name: scale for names, scale in quantity.items() for name in names.split()}
        if one := scales.get(_singular(unit or "1")):
            return {"": 1.0} | {name: scale / one for name, scale in scales.items()}
    return {"": 1.0, _singular(unit): 1.0}


def _clean(text):
    """A text without what says nothing: quotes, brackets, a name and "=", a final full stop."""
    text = text.lower()
    for pattern, by in RULES["clean"]:
        text = unicodedata.normalize("NFKC", re.sub(pattern, by.replace("$1", r"\g<1>"), text))
    return text


def _split(text, count):
    """The parts of a text that says so many numbers."""
    splits = [re.split(gap, text) for gap in RULES["gaps"]] if count > 1 else [[text]]
    return next((parts for parts in splits if len(parts) == count), [])


def _singular(unit):
    """A unit's name as it is looked up: "Pixels" and "pixel" are one, "ms" is no plural."""
    return re.sub(r"(?<=\w{3})s$", "", re.sub(r"[\s·]", "", unit.lower()))


def _value(over, under, _):
    over, under = (float(number.replace(",", ".")) for number in (over, under))
    return over / under if under else math.nan
