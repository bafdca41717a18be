"""Ablation of the training of the ventral stream."""

import numpy as np

from reproduce.experiments import stream_ablation
from reproduce.training import samples
from reproduce.training.augmentation import ALL, augment
from vmc_lib import photos

SHOT = photos.load("real", "train")[0]
REAL = samples.boxes_by_kind(
    SHOT, samples.random_windows(np.random.default_rng(0)), np.random.default_rng(0)
)
RENDER = samples.boxes_by_kind(
    photos.load("rig", "train")[0],
    samples.random_windows(np.random.default_rng(1)),
    np.random.default_rng(0),
)
POOL = samples.training_samples({"real": [REAL], "rig": [RENDER], "pasted": [REAL]})


def test_shipped_results_have_their_shapes():
    results = stream_ablation.load_results()
    assert list(results) == list(stream_ablation.WITHOUT)
    for shares in results.values():
        assert shares.shape == (stream_ablation.DRAWS,)
        assert 0 <= shares.min() <= shares.max() <= 1


def test_each_ablation_leaves_one_idea_out():
    ways = {name: change(POOL) for name, (change, _) in stream_ablation.WITHOUT.items()}
    maps = [maps for _, maps in stream_ablation.WITHOUT.values()]
    assert [len(some) for some in maps] == [4, 2, 4, 4, 4, 4]

    def has(name):
        sources = ways[name].sources
        return {(s, kind) for s in sources for kind, boxes in sources[s].items() if boxes}

    everything = has("all of them")
    assert has("two stages, not four") == everything
    assert has("without new looks") == everything
    assert [way.augmentation is ALL for way in ways.values()] == [
        True,
        True,
        False,
        True,
        True,
        True,
    ]
    pasted = {(s, kind) for s, kind in everything if s == "pasted"}
    windows = {(s, kind) for s, kind in everything if s != "rendered" and kind == "scene"}
    assert has("without pasted scenes") == everything - pasted
    assert has("without windows of photographs") == everything - windows
    assert {s for s, _ in has("without photographs")} == {"rendered"}


def test_without_augmentation_crops_are_constant():
    box = SHOT.boxes["shuttlecock"]
    one, other = (
        augment(SHOT.image, box, False, np.random.default_rng(seed), stream_ablation.PLAIN)[0]
        for seed in (0, 1)
    )
    np.testing.assert_array_equal(one, other)


def test_evaluation_set_holds_objects_and_windows():
    exam = stream_ablation.evaluation_set([REAL])
    labels = [label for _, boxes, label in exam for _ in boxes]
    assert sum(labels) == 2
    assert stream_ablation.WINDOWS <= len(labels) - 2 < 2 * stream_ablation.WINDOWS
