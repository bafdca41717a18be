"""Slow feature analysis: films of objects that drift before the eye, and what a unit tells."""

import numpy as np

from vmc_lib import photos
from vmc_lib.boxes import centres_and_sides
from vmc_lib.what.cdbn import CDBN
from vmc_lib.what.crops import crop
from vmc_lib.what.recogniser import read_outs

VIEWS, SHOTS, SHUFFLES = 5, 32, 20


def drift(photo, box, rng):
    """Crops (VIEWS, 200, 200) of an object while the eye drifts over it, nearer or farther."""
    centre, sides = centres_and_sides(box)
    angle = rng.uniform(0, 2 * np.pi)
    way = 0.3 * np.array([np.cos(angle), np.sin(angle)]) * sides
    nearer = rng.choice([-0.2, 0.2])
    times = np.linspace(-1, 1, VIEWS)[:, None]
    centres, half = centre + times * way, sides / 2 * (1 + nearer * times)
    return np.array([crop(photo.image, at) for at in np.hstack([centres - half, centres + half])])


def films(split, rng, cdbn=None):
    """P2's means over quarters in each object's film, (n, VIEWS, d), and which n are shuttlecocks.

    Of the first SHOTS photos of a split of the rig; by the network that ships, or another.
    """
    cdbn, shots = cdbn or CDBN.load(), photos.load("rig", split)[:SHOTS]
    things = [(shot, *pair) for shot in shots for pair in shot.boxes.items()]
    features = [read_outs(cdbn, drift(shot, box, rng))["P2"] for shot, _, box in things]
    return np.array(features), np.array([name == "shuttlecock" for _, name, _ in things])


def slowest(films):
    """Directions (d, d) of films (n, views, d), the steadiest first: slow feature analysis."""
    flat = films.reshape(-1, films.shape[-1])
    _, size, axes = np.linalg.svd(flat - flat.mean(0), full_matrices=False)
    even = axes.T / size * np.sqrt(len(flat))  # now all vary alike
    steps = np.diff(films @ even, axis=1).reshape(-1, len(size))
    return even @ np.linalg.eigh(steps.T @ steps)[1]


def views_right(answers, shuttlecock):
    """The share of each thing's views whose sign tells shuttlecocks (n,) from other things, (n,).

    Of answers (n, views); the better of both readings of the sign counts: chance gives more than a
    half.
    """
    same = ((answers > 0) == shuttlecock[:, None]).mean(axis=1)
    return same if same.mean() >= 0.5 else 1 - same


def separation(answers, shuttlecock):
    """The share of all views (n, views) that `views_right` counts."""
    return views_right(answers, shuttlecock).mean()


def most_varying(films):
    """Directions (d, d) of films (n, views, d), those that vary most first: PCA, blind to time."""
    flat = films.reshape(-1, films.shape[-1])
    return np.linalg.svd(flat - flat.mean(axis=0), full_matrices=False)[2].T


def steadiest_right(cdbn=None):
    """`views_right` in test films of the steadiest unit, (n,); after shuffled lessons; of PCA.

    It learns from the films of training photos; then, again and again, from the same views in
    another order, (SHUFFLES, n). The last, (n,), is of the unit that varies most in them.
    """
    rng = np.random.default_rng(0)
    lived, _ = films("train", rng, cdbn)
    new, shuttlecock = films("test", rng, cdbn)
    flat, shape = lived.reshape(-1, lived.shape[-1]), lived.shape
    lessons = [lived, *(rng.permutation(flat).reshape(shape) for _ in range(SHUFFLES))]
    learnt = [*map(slowest, lessons), most_varying(lived)]
    right, *shuffled, varying = (
        views_right((new - flat.mean(axis=0)) @ directions[:, 0], shuttlecock)
        for directions in learnt
    )
    return right, np.array(shuffled), varying
