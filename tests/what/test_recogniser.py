from itertools import combinations

import numpy as np
import pytest
import torch

from reproduce.training.name_classifier import (
    JITTER,
    background_box,
    fit_name_classifier,
    labelled_crops,
)
from vmc_lib import photos
from vmc_lib.boxes import iou, jitter_boxes
from vmc_lib.what.cdbn import CDBN, crops_of
from vmc_lib.what.crops import crop, whiten
from vmc_lib.what.learning import Learner
from vmc_lib.what.recogniser import POOLED_LEVEL, READ_OUTS, Recogniser, readout_features


@pytest.mark.parametrize("name", READ_OUTS)
@pytest.mark.parametrize("level", ["rig", POOLED_LEVEL])
def test_recogniser_separates_shuttlecocks_from_cups(level, name):
    crops, shuttlecock = crops_of(photos.load("rig", "validation")[:8])
    chance = Recogniser.load(level, name).probability(crops)
    assert chance.shape == (16,)
    assert ((chance >= 0) & (chance <= 1)).all()
    assert ((chance > 0.5) == shuttlecock).mean() >= 14 / 16


def test_numpy_and_torch_give_equal_probabilities():
    crops, _ = crops_of(photos.load("varied", "validation")[:4])
    recogniser = Recogniser.load("varied")
    features = readout_features(CDBN.load(Learner), torch.from_numpy(whiten(crops)))
    theirs = recogniser.classifier.probability(features[recogniser.name].numpy())
    assert recogniser.probability(crops) == pytest.approx(theirs, abs=1e-5)


def test_the_table_is_no_shuttlecock():
    rng, shots = np.random.default_rng(0), photos.load("rig", "validation")[:8]
    crops = [crop(shot.image, background_box(shot, rng)) for shot in shots for _ in range(2)]
    assert (Recogniser.load().probability(crops) < 0.5).mean() >= 14 / 16


def test_no_crops_and_unknown_names():
    assert Recogniser.load().probability([]).shape == (0,)
    with pytest.raises(ValueError, match="contrast"):
        Recogniser.load().probability(np.ones((1, 200, 200)))
    for wrong in (("moon",), ("rig", "P3")):
        with pytest.raises(ValueError, match=f"no '{wrong[-1]}': choose from"):
            Recogniser.load(*wrong)


def test_each_level_has_a_recogniser_of_its_own():
    weights = [
        Recogniser.load(level).classifier.weights for level in (*photos.LEVELS, POOLED_LEVEL)
    ]
    assert all(not np.allclose(a, b) for a, b in combinations(weights, 2))


def test_box_probability_is_that_of_the_crop():
    shot, recogniser = photos.load("rig", "validation")[0], Recogniser.load("rig")
    boxes = np.array(list(shot.boxes.values()))
    crops = np.array([crop(shot.image, box) for box in boxes])
    np.testing.assert_array_equal(
        recogniser.box_probability(shot.image, boxes), recogniser.probability(crops)
    )
    assert recogniser.box_probability(shot.image, []).shape == (0,)


def blobs(n, rng, apart):
    y = np.arange(n) % 2 == 0
    return rng.normal(size=(n, 5)) + apart * y[:, None], y


def test_probabilities_are_calibrated():
    """Of the cases called 70 to 90 %, about 80 % are so."""
    rng = np.random.default_rng(0)
    classifier = fit_name_classifier(*blobs(400, rng, 0.6), *blobs(2000, rng, 0.6))
    x, y = blobs(20_000, rng, 0.6)
    chance = classifier.probability(x)
    for low in (0.1, 0.3, 0.5, 0.7):
        here = (chance > low) & (chance < low + 0.2)
        assert y[here].mean() == pytest.approx(chance[here].mean(), abs=0.05)


def test_fit_refuses_what_it_cannot_learn_from():
    x, y = blobs(40, np.random.default_rng(0), 1)
    bad = [(x[:0], y[:0]), (x, np.ones(40, bool)), (np.full_like(x, np.nan), y)]
    for features, labels in bad:
        with pytest.raises(ValueError, match="both classes"):
            fit_name_classifier(features, labels, x, y)
        with pytest.raises(ValueError, match="both classes"):
            fit_name_classifier(x, y, features, labels)


def test_examples():
    rng, shots = np.random.default_rng(0), photos.load("rig", "train")[:3]
    crops, labels = labelled_crops(shots, rng, copies=2, background=1)
    assert crops.shape == (15, 200, 200)
    assert labels.tolist() == [True, False, True, False, False] * 3
    for shot in shots:
        objects = np.array(list(shot.boxes.values()))
        assert iou([background_box(shot, rng)], objects).max() < 0.3
        near = [
            iou([jitter_boxes(box, JITTER, rng)], [box])[0, 0] for box in objects for _ in range(20)
        ]
        assert 0.6 < np.mean(near) < 0.95


def test_a_box_without_contrast_shows_nothing():
    shot = photos.load("rig", "test")[0]
    box, white = shot.boxes["shuttlecock"], np.array([0, 0, 100, 100])
    image = shot.image.copy()
    image[:110, :110] = 255
    chance = Recogniser.load("rig").box_probability(image, np.array([white, box]))
    assert chance[0] == 0
    assert chance[1] > 0.5
