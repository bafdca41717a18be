"""How demos are rendered: in a live kernel, for the built book, or in a test."""

import os
from pathlib import Path

# What a live kernel shows demos with: a wheel brings it along (tools/wheel.py), a clone has `page`
BROUGHT = Path(__file__).parent / "static"
STATIC = BROUGHT if (BROUGHT / "demo.css").is_file() else Path(__file__).parents[2] / "page/static"
MODES = ("live", "book", "test")


def render_mode():
    """What the variable VMC_RENDER_MODE says: one of `MODES`, "live" where it is unset or empty.

    ValueError for anything else.
    """
    if (mode := os.environ.get("VMC_RENDER_MODE") or "live") not in MODES:
        raise ValueError(f"VMC_RENDER_MODE={mode!r}: must be one of {MODES}")
    return mode
