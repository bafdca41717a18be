"""What each idea of training buys: what is told of it, and what leaving one out leaves."""

import numpy as np
import pytest

from reproduce import ablation, pools
from reproduce.looks import ALL, cut, look
from vmc_lib import photos

SHOT = photos.load("real", "train")[0]
REAL = pools.by_kind(SHOT, pools.anywhere(np.random.default_rng(0)), np.random.default_rng(0))
RENDER = pools.by_kind(
    photos.load("rig", "train")[0],
    pools.anywhere(np.random.default_rng(1)),
    np.random.default_rng(0),
)
POOL = pools.pool({"real": [REAL], "rig": [RENDER]})


def test_what_is_told_is_there():
    found = ablation.load()
    assert list(found) == list(ablation.WITHOUT)
    for shares in found.values():
        assert shares.shape == (ablation.DRAWS,)
        assert 0 <= shares.min() <= shares.max() <= 1


def test_each_way_leaves_one_idea_out():
    whole, plain, windowless, rendered = (less(POOL) for less in ablation.WITHOUT.values())
    assert whole.looks is rendered.looks is windowless.looks is ALL
    assert plain.real is POOL.real
    assert not any(rendered.real.values())
    assert [kind for kind, shown in windowless.real.items() if not shown] == ["other", "scene"]
    crops, labels = rendered.examples(20, np.random.default_rng(0))
    assert len(set(labels)) == 2
    assert np.isfinite(crops).all()


def test_without_new_looks_a_box_always_looks_the_same():
    box = SHOT.boxes["shuttlecock"]
    one, other = (
        look(SHOT.image, box, np.random.default_rng(seed), 48, ablation.PLAIN) for seed in (0, 1)
    )
    np.testing.assert_array_equal(one, other)
    grey = cut(SHOT.image, box, 48) @ np.float32([0.299, 0.587, 0.114])
    assert np.corrcoef(one.ravel(), grey.ravel())[0, 1] == pytest.approx(1, abs=0.02)


def test_a_photograph_is_asked_about_its_things_and_some_windows():
    crops, labels = ablation.asked(POOL.real)
    assert crops.shape[1:] == (200, 200)
    assert labels.sum() == 2
    assert ablation.WINDOWS <= (~labels).sum() < 2 * ablation.WINDOWS
