import numpy as np

from reproduce import pools
from vmc_lib import photos
from vmc_lib.boxes import iou

RNG = np.random.default_rng(0)
SHOWN = {
    "rig": [
        pools.by_kind(shot, pools.anywhere(RNG), RNG) for shot in photos.load("rig", "train")[:3]
    ],
    "real": [
        pools.by_kind(shot, pools.anywhere(RNG), RNG)
        for shot in [*photos.load("real", "train")[::12], photos.real()[0]]
    ],
}


def test_a_photo_shows_its_shuttlecocks_other_things_and_scene():
    two = photos.load("real", "train")[0]
    found = pools.by_kind(two, np.array([two.more[0]]), RNG)
    assert set(found) == {"shuttlecock", "scene"}
    image, boxes = found["shuttlecock"]
    assert image is two.image
    np.testing.assert_array_equal(boxes, [two.boxes["shuttlecock"], two.more[0]])
    assert iou(found["scene"][1], boxes).max() < pools.APART
    assert set(SHOWN["rig"][0]) == set(pools.SHARES)


def test_windows_lie_in_the_photo_and_are_not_slivers():
    windows = np.vstack([pools.anywhere(RNG) for _ in range(20)])
    assert (windows >= 0).all()
    assert (windows <= [photos.WIDTH, photos.HEIGHT] * 2).all()
    assert ((windows[:, 2:] - windows[:, :2]) >= 30).all()


def test_kinds_are_drawn_as_often_as_they_should_be():
    pool = pools.pool(SHOWN)
    drawn = [pool.draw(RNG) for _ in range(2000)]
    assert abs(np.mean([label for *_, label in drawn]) - pools.SHARES["shuttlecock"]) < 0.05
    renders = {shot.image[0].tobytes() for shot in photos.load("rig", "train")[:3]}
    real = np.mean([image[0].tobytes() not in renders for image, *_ in drawn])
    assert abs(real - pools.REAL) < 0.05


def test_what_photographs_lack_comes_from_renders():
    alone = pools.pool({"rig": SHOWN["rig"]})
    crops, labels = alone.examples(30, RNG)
    assert crops.shape == (30, pools.NARROW, pools.NARROW)
    assert 0 < labels.sum() < 30
    assert (crops.std((1, 2)) >= 0.01).all()


def test_everyday_photos_are_learnt_from_and_never_asked(monkeypatch):
    class Blind:
        def detect(self, image):
            return type("Found", (), {"boxes": np.empty((0, 4))})

    monkeypatch.setattr(pools.loop, "lenient_detector", lambda level: Blind())
    shown = pools.show(("train", "validation"), RNG, everyday=2)
    for level, both in shown.items():
        more = 2 * (level == "real"), 0
        for split, some, extra in zip(("train", "validation"), both, more, strict=True):
            assert len(some) == len(photos.load(level, split)) + extra
