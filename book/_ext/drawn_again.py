"""Demos are named by their cells, and drawn again at the end: a later cell may change them."""

import inspect
import itertools

from IPython import get_ipython

from vmc_lib import show
from vmc_lib.show import demo

DECLARED = []  # (its name, a function, its result) of each demo that moves


def record(cells):
    """Let `explore` record the demos that it shows from now on, each named by its cell.

    `cells` are the ids of the cells with code, as they will be executed.
    """
    waiting = iter(cells)

    def begin(_):
        demo.names = cell_names(next(waiting, ""))

    get_ipython().events.register("pre_run_cell", begin)
    explore = show.explore

    def explore_and_record(*given, **named):
        numbers = explore(*given, **named)
        asked = inspect.signature(explore).bind(*given, **named).arguments
        draw, alt = asked["draw"], asked.get("alt")
        last = {key: demo.as_control(key, one).values[-1] for key, one in asked["controls"].items()}

        def state():
            words = alt(**last) if callable(alt) else alt
            return words, demo.lines(demo.pictures(draw(**last), "again"))

        DECLARED.append((numbers.name, state, state()))
        return numbers

    show.explore = explore_and_record


def cell_names(cell):
    """The names of a cell's demos: its id, and then `…-2` and so on."""
    yield cell
    yield from (f"{cell}-{n}" for n in itertools.count(2))


def draw_again():
    """Draw the last state of every demo; ValueError where it is another than at first."""
    changed = [name for name, state, before in DECLARED if state() != before]
    if changed:
        raise ValueError(f"these demos show something else now: {changed}")
