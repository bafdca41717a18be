from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from reproduce.experiments import fresh_test_set, localisation
from vmc_lib import photos
from vmc_lib.what.recogniser import READ_OUTS

ON_THE_RIG = {fresh_test_set.CEILING, fresh_test_set.UNCORRECTED}  # and PUBLISHED, on the rig alone
PUBLISHED = {  # what is asked of each training of the published recipe
    *product(
        (*localisation.TABLE_1_KERNELS, *fresh_test_set.READINGS), range(localisation.TRAININGS)
    ),
}


def test_counts_cover_two_hundred_photos_a_level():
    counts = fresh_test_set.load_results()
    assert set(counts) == ON_THE_RIG | PUBLISHED | {
        *fresh_test_set.KERNELS,
        *fresh_test_set.DETECTORS,
        *product(READ_OUTS, fresh_test_set.NETWORK_SEEDS),
    }
    for question, levels in counts.items():
        if question in ON_THE_RIG | PUBLISHED:
            continue
        assert list(levels) == list(photos.LEVELS)
        for level, (right, _, missed) in levels.items():
            if question in fresh_test_set.DETECTORS:  # a cup and a shuttlecock a photo
                assert right + missed == 400
            elif isinstance(question, tuple):  # shuttlecocks, among as many cups
                assert right + missed == 200
            else:  # candidates on an object, the same for both kernels, in the second hundred
                assert right + missed == sum(fresh_test_set.load_results()["rbf"][level][::2]) > 200


def test_published_recipe_is_tested_on_the_same_photos_by_every_training():
    counts = fresh_test_set.load_results()
    for name, seed in PUBLISHED:
        (right, _, missed), of = counts[name, seed]["rig"], counts[name, 0]["rig"]
        assert list(counts[name, seed]) == ["rig"]
        assert right + missed == of[0] + of[2]
        assert (right + missed == 400) == (name in fresh_test_set.READINGS)  # objects; candidates
    assert sum(counts[fresh_test_set.CEILING]["rig"][::2]) == 400


@pytest.mark.audit
def test_fresh_counts_of_shipped_photos_equal_the_tables():
    """Put to the photos that ship, its questions get the tables' answers: of the first training."""
    shots = photos.load("rig", "test")
    (rows,) = fresh_test_set.kernel_counts(
        "rig", "context", fresh_test_set.KERNELS, shots, trainings=1
    )
    counts = dict(zip(fresh_test_set.KERNELS, rows, strict=True))
    counts |= fresh_test_set.detector_counts("rig")
    counts |= fresh_test_set.published_counts("rig", shots, shots, trainings=1)
    objects = counts.pop(fresh_test_set.CEILING)
    assert objects[0] + objects[2] == 2 * len(shots)
    kernels = localisation.table_1("rig", "test", "context")
    tables = {kernel: rows[0] for kernel, rows in kernels.items()}
    tables |= localisation.table_2("rig", "test")
    for question in tables.keys() & counts.keys():
        numbers = counts[question]
        shares = [share for share, *_ in fresh_test_set.wilson_rates(*numbers)]
        assert shares == pytest.approx(tables[question], abs=0.02)


def test_shares_by_hand():
    (precision, low, high), (recall, *_) = fresh_test_set.wilson_rates(30, 10, 20)
    assert (precision, recall) == (0.75, 0.6)
    assert low < precision < high
    assert np.isclose(high - low, 0.26, atol=0.01)


def test_what_calls_nothing_has_no_precision():
    precision, recall = fresh_test_set.wilson_rates(0, 0, 3)
    assert np.isnan(precision).all()
    assert recall[0] == 0


def test_a_table_has_a_row_for_each_question():
    *_, first, last = fresh_test_set.markdown_table("linear", ("MP2", 1)).splitlines()
    assert first.startswith("| linear |")
    assert last.startswith("| MP2, seed 1 |")
    (precision, *_), (recall, *_) = fresh_test_set.wilson_rates(
        *fresh_test_set.load_results()["linear"]["rig"]
    )
    assert f"{precision:.3f}" in first.split("|")[2]
    assert f"{recall:.3f}" in first.split("|")[2]


def test_shipped_photos_are_refused_as_fresh(monkeypatch):
    """By name: the fresh ones beside them are no reason to delete what ships."""
    load, fresh = photos.load, replace(photos.load("rig", "test")[0], name="rig/test/new")
    mixed = [*load("rig", "test")[:2], fresh]
    monkeypatch.setattr(photos, "load", lambda *asked: mixed if asked[2:] else load(*asked))
    with pytest.raises(ValueError, match=r"delete \['rig/test/000', 'rig/test/001'\]"):
        fresh_test_set.make("exam")
