"""Slow feature analysis: films of objects that drift before the eye, and what a unit tells."""

import numpy as np

from vmc_lib import photos
from vmc_lib.boxes import centres_and_sides
from vmc_lib.what.cdbn import CDBN
from vmc_lib.what.crops import crop
from vmc_lib.what.recogniser import read_outs

VIEWS, SHOTS = 5, 32


def drift(photo, box, rng):
    """Crops (VIEWS, 200, 200) of an object while the eye drifts over it, nearer or farther."""
    centre, sides = centres_and_sides(box)
    angle = rng.uniform(0, 2 * np.pi)
    way = 0.3 * np.array([np.cos(angle), np.sin(angle)]) * sides
    nearer = rng.choice([-0.2, 0.2])
    times = np.linspace(-1, 1, VIEWS)[:, None]
    centres, half = centre + times * way, sides / 2 * (1 + nearer * times)
    return np.array([crop(photo.image, at) for at in np.hstack([centres - half, centres + half])])


def films(split, rng):
    """P2's means over quarters in each object's film, (n, VIEWS, d), and which n are shuttlecocks.

    Of the first SHOTS photos of a split of the rig.
    """
    cdbn, shots = CDBN.load(), photos.load("rig", split)[:SHOTS]
    things = [(shot, *pair) for shot in shots for pair in shot.boxes.items()]
    features = [read_outs(cdbn, drift(shot, box, rng))["P2"] for shot, _, box in things]
    return np.array(features), np.array([name == "shuttlecock" for _, name, _ in things])


def separation(answers, shuttlecock):
    """The share of answers (n, views) whose sign tells shuttlecocks (n,) from other things.

    The better of both readings of the sign counts: chance gives more than a half.
    """
    same = ((answers > 0) == shuttlecock[:, None]).mean()
    return max(same, 1 - same)
