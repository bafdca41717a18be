"""How demos are rendered: in a live kernel, for the built book, or in a test."""

import os
from pathlib import Path

STATIC = Path(__file__).parent / "static"  # what pages and kernels show demos with
MODES = ("live", "book", "test")


def render_mode():
    """What the variable VMC_RENDER_MODE says: one of `MODES`, "live" where it is unset or empty.

    ValueError for anything else.
    """
    if (mode := os.environ.get("VMC_RENDER_MODE") or "live") not in MODES:
        raise ValueError(f"VMC_RENDER_MODE={mode!r}: must be one of {MODES}")
    return mode
