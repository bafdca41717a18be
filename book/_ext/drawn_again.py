"""Demos drawn again at a chapter's end, where a later cell may have changed what they read."""

import inspect

from vmc_lib import show
from vmc_lib.show import demo

DECLARED = []  # (its name, a function, its result) of each demo that moves


def record():
    """Let `explore` record the demos that it shows from now on."""
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


def draw_again():
    """Draw the last state of every demo; ValueError where it is another than at first."""
    changed = [name for name, state, before in DECLARED if state() != before]
    if changed:
        raise ValueError(f"these demos show something else now: {changed}")
