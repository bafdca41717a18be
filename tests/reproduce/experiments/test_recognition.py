import numpy as np
import pytest
import torch

from reproduce.experiments import recognition
from reproduce.experiments.recognition import (
    METHODS,
    confusion_counts,
    correct_by_method,
    load_classifiers,
    load_probabilities,
    mcnemar_tests,
    probabilities,
    rates_of_counts,
    table_3,
)
from reproduce.peers.hmax import c1, draw_prototypes, hmax, s1
from vmc_lib import photos


def test_counts_by_hand():
    counts = confusion_counts([0.9, 0.8, 0.2, 0.6, 0.1], np.array([True, True, True, False, False]))
    assert counts == (2, 1, 1, 1)
    assert rates_of_counts(counts) == pytest.approx((2 / 3, 2 / 3))
    assert np.isnan(rates_of_counts((0, 0, 3, 1))[0])


def test_methods_are_compared_in_pairs_and_corrected_for_their_number():
    right = {"a": np.ones(9, bool), "b": np.arange(9) < 1, "c": np.arange(9) < 8}
    rows = mcnemar_tests(right, ["a", "c"])
    assert [row[:4] for row in rows] == [("a", "b", 8, 0), ("a", "c", 1, 0), ("c", "b", 7, 0)]
    chances, corrected = zip(*(row[4:] for row in rows), strict=True)
    assert chances == pytest.approx((2 / 2**8, 1, 2 / 2**7))
    assert corrected == pytest.approx((3 * 2 / 2**8, 1, 2 * 2 / 2**7))


def test_a_precision_without_calls_is_not_a_number(monkeypatch):
    nothing = {method: np.zeros(2) for method in METHODS}, np.array([True, False])
    monkeypatch.setattr(recognition, "load_probabilities", lambda level, split: nothing)
    shares = {measure: rows["held-out"][METHODS[0]][0] for measure, rows in table_3("rig").items()}
    assert np.isnan(shares.pop("precision"))
    assert shares == {"named right": 0.5, "recall": 0}


@pytest.mark.audit
def test_shipped_probabilities_are_reproducible():
    cdbn, linear = load_classifiers()
    chances, truth = probabilities("rig", photos.load("rig", "validation"), cdbn, linear)
    stored, stored_truth = load_probabilities("rig", "validation")
    assert (truth == stored_truth).all()
    for method in METHODS:
        assert chances[method] == pytest.approx(stored[method], abs=1e-3)


def test_fresh_names_cover_a_hundred_photos_a_level():
    assert {len(right) for right in correct_by_method("fresh").values()} == {
        2 * 100 * len(photos.LEVELS)
    }


def test_s1_answers_to_direction_not_contrast():
    stripes = torch.cos(2 * torch.pi * torch.arange(60) / 5.6).expand(1, 1, 60, 60)
    answers = s1(stripes, 11)[0, :, 20:40, 20:40].amax((1, 2))
    assert answers.argmax() == 0
    assert answers[0] > 2 * answers[2]
    assert s1(10 * stripes, 11)[0, 0, 20:40, 20:40].amax() == pytest.approx(
        float(answers[0]), rel=0.05
    )


def test_c2_of_a_prototypes_own_crop_is_one():
    crops = np.float32(np.random.default_rng(0).random((2, 200, 200)))
    prototypes = draw_prototypes(crops[:1], 5, np.random.default_rng(0))
    assert prototypes.shape == (5, 4, 4, 4)
    assert hmax(crops[:1], prototypes)[0] == pytest.approx(1, abs=1e-3)
    assert (hmax(crops[1:], prototypes) < 0.99).any()
    assert [maps.shape[1] for maps in c1(crops)] == [4] * 4
