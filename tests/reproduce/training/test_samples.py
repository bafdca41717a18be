from types import SimpleNamespace

import numpy as np
import pytest

from reproduce.training import samples
from reproduce.training.scenes import SCENES, paste_photos
from vmc_lib import photos
from vmc_lib.boxes import iou


@pytest.fixture(scope="module")
def pools():
    rng, real = np.random.default_rng(0), photos.load("real", "train")[::12]
    shots = {"rig": photos.load("rig", "train")[:3], "real": [*real, photos.everyday()[0]]}
    return {
        level: [samples.boxes_by_kind(shot, samples.random_windows(rng), rng) for shot in some]
        for level, some in shots.items()
    }


def test_boxes_of_a_photo_by_kind(pools, rng):
    two = photos.load("real", "train")[0]
    kinds = samples.boxes_by_kind(two, np.array([two.more[0]]), rng)
    assert set(kinds) == {"shuttlecock", "scene"}
    image, boxes = kinds["shuttlecock"]
    assert image is two.image
    np.testing.assert_array_equal(boxes, [two.boxes["shuttlecock"], two.more[0]])
    assert iou(kinds["scene"][1], boxes).max() < samples.APART
    assert set(pools["rig"][0]) == set(samples.SHARES)


def test_windows_lie_in_the_photo_and_are_not_slivers(rng):
    windows = np.vstack([samples.random_windows(rng) for _ in range(20)])
    assert (windows >= 0).all()
    assert (windows <= [photos.WIDTH, photos.HEIGHT] * 2).all()
    assert ((windows[:, 2:] - windows[:, :2]) >= 30).all()


def test_kinds_are_drawn_by_their_shares(pools, rng):
    pool = samples.training_samples(
        pools | {"pasted": [{"shuttlecock": pools["real"][0]["shuttlecock"]}]}
    )
    draws = [pool.draw(rng) for _ in range(2000)]
    assert abs(np.mean([label for *_, label in draws]) - samples.SHARES["shuttlecock"]) < 0.05
    renders = {shot.image[0].tobytes() for shot in photos.load("rig", "train")[:3]}
    rendered = np.mean([image[0].tobytes() in renders for image, _, label in draws if label])
    assert abs(rendered - samples.SOURCES["rendered"]) < 0.06


def test_renders_fill_in_for_photographs(pools, rng):
    alone = samples.training_samples({"rig": pools["rig"]})
    draws = [alone.draw(rng) for _ in range(30)]
    assert 0 < sum(label for *_, label in draws) < 30
    assert all(box.shape == (4,) for _, box, _ in draws)


def test_decoys_are_other_things(rng):
    [photo] = paste_photos(photos.load("real", "train"), "train", 6, rng)[-1:]
    kinds = samples.boxes_by_kind(photo, photo.decoys, rng)
    assert "shuttlecock" not in kinds
    np.testing.assert_array_equal(kinds["other"][1], photo.decoys)


def test_samples_include_everyday_counterexamples_and_pasted_photos(monkeypatch, rng):
    class Blind:
        def detect(self, image):
            return SimpleNamespace(boxes=np.empty((0, 4)), scores=np.empty(0))

    monkeypatch.setattr(samples.loop, "high_recall_detector", lambda level: Blind())
    pools = samples.collect_samples(rng, everyday=2, pasted=7)
    assert list(pools) == [*photos.EVERY_LEVEL, "pasted"]
    for level in photos.EVERY_LEVEL:
        assert len(pools[level]) == len(photos.load(level, "train")) + 4 * (level == "real")
    assert ["shuttlecock" in photo for photo in pools["pasted"]] == 5 * [True] + 2 * [False]


def test_of_windows_that_are_alike_the_best_teaches():
    boxes, scores = np.array([[0, 0, 50, 50], [2, 0, 52, 50], [20, 0, 70, 50.0]]), np.arange(3)
    finder = type(
        "Finder", (), {"detect": lambda image: SimpleNamespace(boxes=boxes, scores=scores)}
    )
    kept = samples.detected_boxes(finder, SimpleNamespace(image=None))
    np.testing.assert_array_equal(kept, boxes[[2, 1]])


def test_validation_photos_hold_photographs_and_every_kind_of_scene(rng):
    first, *scenes = samples.validation_photos(rng, everyday=1, pasted=len(SCENES))
    assert first.name.startswith("real/validation/")
    assert [len(photos.boxes_of(one, "shuttlecock")) for one in scenes] == [
        count for count, *_ in SCENES.values()
    ]
