import numpy as np

from reproduce.experiments import slow_features
from vmc_lib import photos
from vmc_lib.what.crops import crop


def test_the_better_reading_of_the_sign_counts():
    answers = np.array([[1, 2, -1, 3], [-1, -2, -3, -4]])
    kind = np.array([True, False])
    assert slow_features.separation(answers, kind) == 7 / 8
    assert slow_features.separation(answers, ~kind) == 7 / 8


def test_a_film_passes_over_the_object(rng):
    photo = photos.load("rig", "validation")[0]
    box = photo.boxes["cup"]
    film = slow_features.drift(photo, box, rng)
    assert len(film) == slow_features.VIEWS
    np.testing.assert_array_equal(film[len(film) // 2], crop(photo.image, box))
    assert all((view != film[0]).any() for view in film[1:])
