import numpy as np

from reproduce.peers.window_proposals import edge_density, exhaustive, sliding_windows
from vmc_lib.boxes import area, iou


def windows(seed=0):
    return sliding_windows((400, 600), np.random.default_rng(seed))


def test_windows_lie_inside_in_random_order():
    boxes = windows()
    assert len(np.unique(boxes, axis=0)) == len(boxes) > 1000
    assert (boxes >= 0).all()
    assert (boxes <= [600, 400, 600, 400]).all()
    assert np.allclose(np.unique(np.sqrt(area(boxes)).round(3)), [40, 60, 90, 135, 200])
    assert (windows() == boxes).all()
    assert (windows(1) != boxes).any()


def test_an_image_smaller_than_every_window_has_none():
    none = sliding_windows((30, 30), np.random.default_rng(0))
    assert none.shape == (0, 4)
    assert edge_density(np.zeros((30, 30, 3), np.uint8), none).shape == (0,)


def test_edges_prefer_the_window_that_holds_the_outline():
    image = np.zeros((400, 600, 3), np.uint8)
    image[100:200, 200:350] = 255
    tight, inside, apart, around = edge_density(
        image,
        np.array(
            [[198, 98, 352, 202], [220, 120, 330, 180], [400, 250, 500, 350], [0, 0, 600, 400]]
        ),
    )
    assert tight > around > apart == 0 > inside


def test_exhaustive_windows_miss_no_box():
    everywhere, rng = exhaustive((400, 600)), np.random.default_rng(0)
    for _ in range(20):
        side, ratio = rng.uniform(40, 180), rng.uniform(0.5, 2)
        w, h = side * ratio**0.5, side / ratio**0.5
        x, y = rng.uniform(0, 600 - w), rng.uniform(0, 400 - h)
        assert iou(everywhere, [[x, y, x + w, y + h]]).max() >= 0.8
