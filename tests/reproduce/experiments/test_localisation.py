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


@pytest.mark.parametrize("name", localisation.TABLE_1_RECIPES)
def test_table_1_ships_as_it_is_measured(name):
    table = localisation.table_1("rig", "validation", name)
    assert list(table) == ["linear", "rbf", "poly", "sigmoid"]
    rows = table["linear"]
    assert rows.shape == (localisation.TRAININGS, 2)
    for seed in (0, localisation.TRAININGS - 1):
        again = localisation.measure_table_1("rig", name, seed, ["linear"])[
            photos.SPLITS.index("validation")
        ]
        assert rows[seed] == pytest.approx(again[0], abs=0.02)


def test_table_1_counts_the_examples_of_the_split():
    """With the cost of the detector that ships, its own precision and recall."""
    chosen = localisation.kernel_costs() | {"linear": RECIPES["published"].cost}
    rows = localisation.measure_table_1("rig", "published", 0, ["linear"], chosen=chosen)
    x, truth = labelled_candidates(photos.load("rig", "validation"))
    says = ObjectDetector.load("rig", "published").svm.score(x) > 0
    expected = (truth[says].mean(), says[truth].mean())
    assert rows[photos.SPLITS.index("validation"), 0] == pytest.approx(expected, abs=0.02)


def test_costs_are_chosen_on_validation_photos_from_one_grid():
    """With one training instead of all, to be quick: each chosen cost is as good as any."""
    chosen, grid = localisation.kernel_costs(), localisation.GRID
    assert list(chosen) == list(localisation.TABLE_1_KERNELS)
    assert set(chosen.values()) <= {*grid}
    for cost, f1 in zip(chosen.values(), localisation.f1_by_cost(trainings=1), strict=True):
        assert f1[grid.index(cost)] >= f1.max() - 0.01


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
