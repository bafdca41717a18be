"""Localisation of the target from a box, fitted on training photos, beside plain geometry."""

import numpy as np
import pytest

from vmc_lib import photos
from vmc_lib.where.localiser import Localiser


@pytest.fixture(scope="module")
def localiser():
    return Localiser.fit(photos.load("rig", "train"), np.random.default_rng(0))


def errors(place, shots):
    return [np.linalg.norm(place(p, p.boxes["shuttlecock"]) - p.target) for p in shots]


def test_localiser_beats_plain_geometry(localiser):
    """On held-out photos, to less than a centimetre."""
    height = np.mean([p.target[1] for p in photos.load("rig", "train")])

    def plain(photo, box):
        return photo.camera.back_project((box[:2] + box[2:]) / 2, height)[0]

    def fitted(photo, box):
        return localiser.locate(photo.image, box, photo.camera)

    shots = photos.load("rig", "validation")
    assert np.mean(errors(fitted, shots)) < 0.01 < np.mean(errors(plain, shots))


def test_fit_is_repeatable(localiser):
    again = Localiser.fit(photos.load("rig", "train"), np.random.default_rng(0))
    photo = photos.load("rig", "validation")[0]
    view = photo.image, photo.boxes["shuttlecock"], photo.camera
    np.testing.assert_array_equal(again.locate(*view), localiser.locate(*view))


def test_an_unknown_level_is_refused():
    with pytest.raises(ValueError, match=r"'attic': choose from .'rig', 'free', 'varied'.$"):
        Localiser.load("attic")


def test_a_line_of_sight_above_the_horizon_is_an_error(localiser):
    photo = photos.load("free", "train")[0]
    with pytest.raises(ValueError, match="never meets the plane"):
        localiser.locate(photo.image, [200, -9000, 300, -8900], photo.camera)
