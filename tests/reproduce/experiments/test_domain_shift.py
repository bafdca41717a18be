"""Recognition under domain shift and from few labels: shipped results, and the small parts."""

import numpy as np
import pytest

from reproduce.experiments import domain_shift
from vmc_lib import photos


def test_shipped_results_have_their_shapes():
    results, columns = domain_shift.load_results(), 1 + len(domain_shift.LEVELS)
    assert results["shift"].shape == (len(domain_shift.LEVELS), 2, domain_shift.DRAWS, columns)
    assert results["few"].shape == (len(domain_shift.LABELS), 3, domain_shift.DRAWS, columns)
    assert all(0 <= x.min() <= x.max() <= 1 for x in results.values())


@pytest.mark.audit
def test_shipped_results_are_reproducible():
    sets = [domain_shift.level_crops("rig", split) for split in photos.SPLITS]
    train, validation, test = [(domain_shift.hog_features(x), y) for x, y in sets]
    again = domain_shift.evaluate_over_draws(
        domain_shift.evaluate_linear_readout, train, validation, [test], domain_shift.EQUAL, 6
    )
    stored = domain_shift.load_results()["shift"][0, 0, :, :2]
    assert again == pytest.approx(stored, abs=0.02)


def test_a_photo_gives_its_things_and_a_window():
    crops, labels = domain_shift.level_crops("rig", "test")
    assert crops.shape == (120, 200, 200)
    assert labels.sum() == 40
    _, real = domain_shift.level_crops("real", "test")
    shots = photos.load("real", "test")
    assert real.sum() == sum(len(photos.boxes_of(shot, "shuttlecock")) for shot in shots)


def test_pictures_are_scaled_down_by_areas():
    pictures = np.random.default_rng(0).random((2, 40, 40)).astype(np.float32)
    small = domain_shift.downsample(pictures, 10)
    np.testing.assert_allclose(small, pictures.reshape(2, 10, 4, 10, 4).mean((2, 4)), atol=1e-6)


def test_both_kinds_count_alike():
    truth = np.array([True, False, False, False])
    assert domain_shift.balanced_accuracy(np.ones(4, bool), truth) == 0.5
    assert domain_shift.balanced_accuracy(truth, truth) == 1


def test_labels_are_drawn_until_both_kinds_are_there(rng):
    labels = np.arange(50) == 7
    for count in (2, 10):
        rows = domain_shift.draw_rows(labels, count, rng)
        assert len(set(rows)) == count
        assert 7 in rows
    assert len(domain_shift.draw_rows(labels, 640, rng)) == 50


def test_settings_are_chosen_on_validation_crops():
    """Of two choices the second does better there, and worse elsewhere."""

    def two(train, validation, exams, rng):
        return [[1.0, 0.6, 0.9], [0.8, 0.7, 0.5]]

    labels = np.arange(9) < 4
    scores = domain_shift.evaluate_over_draws(two, (labels, labels), None, None, 5, draws=3)
    assert scores.tolist() == [[0.8, 0.5]] * 3


def test_linear_readout_separates_separable_classes(rng):
    labels = np.arange(40) % 2 == 0
    features = labels[:, None] + 0.01 * rng.standard_normal((40, 3))
    scores = domain_shift.evaluate_linear_readout(
        (features, labels), (features, labels), [(features, ~labels)], rng
    )
    assert np.shape(scores) == (len(domain_shift.INVERSE_PENALTIES), 3)
    assert scores[-1] == [1, 1, 0]


def test_end_to_end_has_a_choice_for_each_rate_and_penalty(rng):
    crops, labels = rng.random((6, 200, 200), np.float32), np.arange(6) < 3
    few = crops, labels
    scores = domain_shift.evaluate_end_to_end(few, few, [few], rng, steps=2)
    assert np.shape(scores) == (len(domain_shift.RATES) * len(domain_shift.INVERSE_PENALTIES), 3)
