from functools import cache

import numpy as np
import pytest
from scipy.stats import sem, t

from reproduce.experiments import localisation
from reproduce.results import arrays
from reproduce.training.detectors import best_threshold, labelled_candidates
from vmc_lib import photos
from vmc_lib.where.detector import ObjectDetector
from vmc_lib.where.recipes import RECIPES


@pytest.mark.parametrize("level", photos.LEVELS)
@pytest.mark.parametrize("name", RECIPES)
def test_shipped_boxes_are_detected_again(level, name):
    """In all but a few photos: another processor may round a pixel differently."""
    some, same = photos.load(level, "test")[:5], 0
    for photo, regions in zip(some, localisation.detect_photos(level, "test", name), strict=False):
        stored = arrays("localisation")[f"{photo.name}/{name}"]
        same += len(stored) == len(regions.boxes) and np.allclose(stored, regions.boxes, atol=1)
    assert same >= 4


def test_localisation_by_hand():
    photo = photos.load("rig", "train")[0]
    cup = photo.boxes["cup"]
    assert localisation.precision_recall([photo], [np.array([cup, cup + 300])]) == (0.5, 0.5)
    assert localisation.precision_recall([photo], [np.empty((0, 4))]) == (0, 0)
    assert localisation.precision_recall([photo], [list(photo.boxes.values())]) == (1, 1)


@cache
def linear_rows(name, seed):
    """Precision and recall of the linear kernel on the rig, trained again, by split."""
    rows = localisation.measure_table_1("rig", name, seed, ["linear"])
    return dict(zip(photos.SPLITS, rows[:, 0], strict=True))


@pytest.mark.parametrize(
    ("name", "off"), [("published", 0.01), pytest.param("context", 0.02, marks=pytest.mark.audit)]
)
def test_table_1_ships_as_it_is_measured(name, off):
    for split in photos.SPLITS:
        table = localisation.table_1("rig", split, name)
        assert list(table) == ["linear", "rbf", "poly", "sigmoid"]
        assert table["linear"].shape == (localisation.TRAININGS, 2)
        for seed in (0, localisation.TRAININGS - 1):
            assert table["linear"][seed] == pytest.approx(linear_rows(name, seed)[split], abs=off)


def test_table_1_counts_the_examples_of_the_split():
    """Its linear kernel is the detector's that ships: one cost, the same precision and recall."""
    assert localisation.kernel_settings()["linear"].tolist() == [RECIPES["published"].cost, 1]
    x, truth = labelled_candidates(photos.load("rig", "validation"))
    says = ObjectDetector.load("rig", "published").svm.score(x) > 0
    expected = (truth[says].mean(), says[truth].mean())
    assert linear_rows("published", 0)["validation"] == pytest.approx(expected, abs=0.02)


@pytest.mark.audit
def test_settings_are_chosen_on_validation_photos_from_one_grid(monkeypatch):
    """In a small part of the grid, to be quick."""
    few = dict.fromkeys(("rbf", "sigmoid"), (0.03, 1.0))
    part = {"linear": (0.01, 0.1), "rbf": (0.1, 10.0), "poly": (0.1, 1.0), "sigmoid": (10.0, 1e3)}
    for kernel, (cost, scale) in localisation.kernel_settings().items():
        assert cost in localisation.COSTS
        assert scale in localisation.FREE_SCALES[kernel]
        with monkeypatch.context() as patch:
            patch.setattr(localisation, "COSTS", part[kernel])
            patch.setattr(localisation, "FREE_SCALES", localisation.FREE_SCALES | few)
            best = localisation.best_setting(kernel, localisation.f1_by_setting(kernel))
        assert best == (cost, scale)


def test_sixteen_pixels_are_as_good_as_other_sizes():
    """The best of the linear kernel on validation photos, and 8 pixels as they are measured."""
    f1 = localisation.f1_by_size()
    assert max(f1, key=f1.get) == 16
    assert localisation.f1_by_setting("linear", "8 pixels").max() == pytest.approx(f1[8], abs=0.02)


@pytest.mark.parametrize("name", localisation.RETRAINED)
def test_shipped_detector_is_the_first_of_its_seeds(name):
    """Its Table II row is the first of the seeds' rows: the same training and tuning."""
    rows = arrays("localisation")[f"rig/{name}/seeds"]
    assert rows.shape == (localisation.TRAININGS, 2)
    assert localisation.table_2("rig")[name] == pytest.approx(rows[0], abs=0.03)
    mean, half = localisation.table_2_interval("rig", name)
    low, high = t.interval(0.95, len(rows) - 1, rows.mean(0), sem(rows))
    assert mean - half == pytest.approx(low)
    assert mean + half == pytest.approx(high)


@pytest.mark.parametrize("level", photos.LEVELS)
def test_a_stricter_overlap_finds_less(level):
    lenient, strict = (localisation.table_2(level, "validation", at) for at in (0.5, 0.95))
    for name in RECIPES:
        assert lenient[name][1] > strict[name][1]


def test_figure_6_narrows():
    counts = localisation.figure_6("rig", "validation")
    assert counts["candidates"] > counts["passed"] > counts["kept"] > 0


def noisy(n, rng):
    """Scores (n,), and whether each is right: the more likely, the higher it is."""
    scores = rng.normal(size=n)
    return scores, rng.random(n) < 1 / (1 + np.exp(-4 * scores))


def test_smoothed_threshold_equals_the_best_for_many_examples():
    scores, right = noisy(5000, np.random.default_rng(0))
    best = best_threshold(scores, right, right.sum())
    assert localisation.smoothed_threshold(scores, right) == pytest.approx(best, abs=0.15)


def test_smoothed_threshold_varies_less():
    rng = np.random.default_rng(0)
    draws = [noisy(100, rng) for _ in range(50)]
    best = np.std([best_threshold(scores, right, right.sum()) for scores, right in draws])
    steady = np.std([localisation.smoothed_threshold(*draw) for draw in draws])
    assert steady < 0.8 * best
