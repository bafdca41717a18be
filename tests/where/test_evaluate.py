import numpy as np
import pytest

from vmc_lib import photos
from vmc_lib.where import evaluate
from vmc_lib.where.regions import RECIPES, stored


@pytest.mark.parametrize("level", photos.LEVELS)
@pytest.mark.parametrize("name", RECIPES)
def test_what_ships_as_found_is_found(level, name):
    """In all but a few photos: another processor may round a pixel differently."""
    some, same = photos.load(level, "test")[:5], 0
    for photo, regions in zip(some, evaluate.search(level, "test", name), strict=False):
        kept = stored("found")[f"{photo.name}/{name}"]
        same += len(kept) == len(regions.boxes) and np.allclose(kept, regions.boxes, atol=1)
    assert same >= 4


def test_localisation_by_hand():
    photo = photos.load("rig", "train")[0]
    cup = photo.boxes["cup"]
    assert evaluate.localisation([photo], [np.array([cup, cup + 300])]) == (0.5, 0.5)
    assert evaluate.localisation([photo], [np.empty((0, 4))]) == (0, 0)
    assert evaluate.localisation([photo], [list(photo.boxes.values())]) == (1, 1)


def test_table_1_counts_examples_of_the_split():
    table = evaluate.table_1("rig", "validation")
    assert list(table) == ["linear", "rbf", "poly", "sigmoid"]
    x, truth = evaluate.examples(photos.load("rig", "validation"))
    says = evaluate._machine("rig", "linear").score(x) > 0
    assert table["linear"] == pytest.approx((truth[says].mean(), says[truth].mean()))


def test_a_stricter_overlap_finds_less():
    lenient, strict = (evaluate.table_2("rig", "validation", at) for at in (0.5, 0.9))
    for name in RECIPES:
        assert lenient[name][1] > strict[name][1]


def test_figure_6_narrows():
    counts = evaluate.figure_6("rig", "validation")
    assert counts["candidates"] > counts["passed"] > counts["kept"] > 0
