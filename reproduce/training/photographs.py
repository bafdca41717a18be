"""Photographs by split: those that ship, and counter-examples, which show no shuttlecock."""

from pathlib import Path

from vmc_lib import photos

COUNTEREXAMPLES = Path(__file__).parent / "counterexamples"


def load_photographs(split, folder=photos.FOLDER):
    """The photographs of a split: those that ship, and counter-examples."""
    return [
        shot
        for where in (folder, COUNTEREXAMPLES)
        for shot in photos.load(photos.REAL_LEVEL, split, where)
    ]
