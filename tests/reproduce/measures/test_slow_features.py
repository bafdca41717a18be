import numpy as np

from reproduce.measures import slow_features
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


def test_the_steadiest_direction_is_the_one_that_changes_least(rng):
    """Of a slow wave and a quick one, mixed: the slow one alone is left, of unit variance."""
    t = np.arange(200)
    waves = np.stack([np.sin(t / 20), np.sin(2 * t)], axis=1)
    films = (waves @ rng.normal(size=(2, 2)))[None]
    first, second = (films[0] @ slow_features.slowest(films)).T
    assert abs(np.corrcoef(first, waves[:, 0])[0, 1]) > 0.999
    assert np.allclose([first.std(), second.std()], 1)
