from itertools import product

import numpy as np
import pytest

from reproduce.experiments import fresh_test_set, localisation
from vmc_lib import photos
from vmc_lib.what.recogniser import READ_OUTS


def test_counts_cover_two_hundred_photos_a_level():
    assert set(fresh_test_set.load_counts()) == {
        *fresh_test_set.KERNELS,
        *fresh_test_set.DETECTORS,
        *product(READ_OUTS, fresh_test_set.NETWORK_SEEDS),
    }
    for question, levels in fresh_test_set.load_counts().items():
        assert list(levels) == list(photos.LEVELS)
        for level, (right, _, missed) in levels.items():
            if question in fresh_test_set.DETECTORS:  # a cup and a shuttlecock a photo
                assert right + missed == 400
            elif isinstance(question, tuple):  # shuttlecocks, among as many cups
                assert right + missed == 200
            else:  # candidates on an object, the same for both kernels, in the second hundred
                assert right + missed == sum(fresh_test_set.load_counts()["rbf"][level][::2]) > 200


def test_fresh_counts_of_shipped_photos_equal_the_tables():
    """Put to the photos that ship, its questions get the tables' answers: of the first training."""
    shots = photos.load("rig", "test")
    counts = fresh_test_set.kernel_counts("rig", shots, trainings=1)
    counts |= fresh_test_set.detector_counts("rig", shots)
    kernels = localisation.table_1("rig", "test", "context")
    tables = {kernel: rows[0] for kernel, rows in kernels.items()}
    tables |= localisation.table_2("rig", "test")
    for question, numbers in counts.items():
        shares = [share for share, *_ in fresh_test_set.rates(*numbers)]
        assert shares == pytest.approx(tables[question], abs=0.02)


def test_shares_by_hand():
    (precision, low, high), (recall, *_) = fresh_test_set.rates(30, 10, 20)
    assert (precision, recall) == (0.75, 0.6)
    assert low < precision < high
    assert np.isclose(high - low, 0.26, atol=0.01)


def test_a_table_has_a_row_for_each_question():
    *_, first, last = fresh_test_set.markdown_table("linear", ("MP2", 1)).splitlines()
    assert first.startswith("| linear |")
    assert last.startswith("| MP2, seed 1 |")
    (precision, *_), (recall, *_) = fresh_test_set.rates(
        *fresh_test_set.load_counts()["linear"]["rig"]
    )
    assert f"{precision:.3f}" in first.split("|")[2]
    assert f"{recall:.3f}" in first.split("|")[2]


def test_shipped_photos_are_refused_as_fresh():
    with pytest.raises(ValueError, match="rig/test/000"):
        fresh_test_set.make(photos.FOLDER)
