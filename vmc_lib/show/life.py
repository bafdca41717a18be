"""Which of its three lives a demo leads: in a live kernel, in the built book, or in a test."""

import os

LIVES = ("live", "book", "test")


def life():
    """What the variable VMC_LIFE says: one of `LIVES`, "live" where nobody set it.

    ValueError for anything else.
    """
    if (told := os.environ.get("VMC_LIFE", "live")) not in LIVES:
        raise ValueError(f"VMC_LIFE={told!r}: must be one of {LIVES}")
    return told
