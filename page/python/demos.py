"""A chapter's demos, drawn in the page: between their stops too, and by laws of the reader's."""

from contextlib import redirect_stdout
from functools import lru_cache
from inspect import signature
from io import StringIO

import matplotlib as mpl

from page.python.grader import changed_names, definitions
from vmc_lib import show
from vmc_lib.show.abbreviations import as_control
from vmc_lib.show.controls import Pad, Slider
from vmc_lib.show.demo import draw_state, lines
from vmc_lib.show.packed import unpack_arrays

mpl.use("svg")


def draw(above, book, cell, name, places, data=""):
    """What a demo shows where its controls stand, by the chapter's code as the reader has it.

    `above` is that code, a text for each cell before the demo's own and for each law after it, and
    `book` the same as the book has it; `places` are where the sliders and choices stand, by name;
    `data` are the arrays that the page brings: what a law of the reader's changes is made anew. The
    answer holds the lines of its words and `parts`, and its sliders' `texts`; or the `error` that a
    law of the reader's made. Without `places` it is only prepared.
    """
    own = unpack_arrays(data) if changed_names(above, book, cell) else {}
    stale = frozenset(array for array in own if changed_names(above, book, array))
    try:
        with redirect_stdout(StringIO()):
            demo, controls, _ = prepare(tuple(above), cell, data, stale)
            if places is None:
                return {"parts": [], "texts": {}}
            words, parts = draw_state(values=values_at(places, controls), name=name, **demo)
    except Exception as error:
        return {"error": repr(error)}
    return {"parts": [[words], *lines(parts)], "texts": _texts(places, controls)}


@lru_cache(8)
def prepare(above, cell, data="", stale=frozenset()):
    """What a cell asks `explore` for: a demo as `draw_state` takes it, its controls, its data.

    Of the page's `data` those whose names are `stale` are made anew.
    """
    asked, errors, kept = [], [], show.explore

    def explore(*given, **named):
        call = signature(kept).bind(*given, **named)
        call.apply_defaults()
        one = call.arguments
        controls = {key: as_control(key, spec) for key, spec in one["controls"].items()}
        demo = {"draw": one["draw"], "alt": one["alt"], "tables": not one["in_page"]}
        asked.append((demo, controls, one["data"]))

    show.explore = explore
    try:
        known = {name: one for name, one in unpack_arrays(data).items() if name not in stale}
        names = definitions(above, cell, errors, known)
        exec(compile(cell, "demo", "exec"), names)  # noqa: S102
    except NameError as error:  # what went wrong above says more
        raise (errors or [error])[-1] from error
    finally:
        show.explore = kept
    return asked[0]


def values_at(places, controls):
    """The controls' values at these places."""
    return {key: _value(key, one, places) for key, one in controls.items()}


def _value(key, control, places):
    if isinstance(control, Pad):
        return tuple(_value(f"{key}-{axis}", one, places) for axis, one in _pair(control))
    place = places[key]
    return control.value_at(place) if isinstance(control, Slider) else control.values[int(place)]


def _pair(pad):
    return zip("xy", pad.pair, strict=True)


def _texts(places, controls):
    """What stands beside each slider, by its name."""
    return {key: one.text(one.value_at(places[key])) for key, one in sliders(controls).items()}


def sliders(controls):
    """The sliders among controls by their names, the twins of pads with them."""
    found = {key: one for key, one in controls.items() if isinstance(one, Slider)}
    for key, pad in controls.items():
        if isinstance(pad, Pad):
            found |= {f"{key}-{axis}": one for axis, one in _pair(pad)}
    return found
