"""The pinhole camera: projection, back-projection, and the size of what stands on the table."""

import numpy as np
import pytest

from vmc_lib import photos
from vmc_lib.box_selection import SIZES
from vmc_lib.camera import TABLE, Camera
from vmc_lib.photos import LEVELS

LOOK_DOWN = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])
DOWN = Camera(800.0, np.array([300.0, 200]), LOOK_DOWN, np.zeros(3))


def test_back_projection_inverts_projection():
    rng = np.random.default_rng(1)
    for shot in photos.load("free", "train"):
        points = shot.target + rng.uniform(-0.1, 0.1, (20, 3))
        points[:, 1] = -0.4
        again = shot.camera.back_project(shot.camera.project(points), height=-0.4)
        np.testing.assert_allclose(again, points, atol=1e-12)


def test_a_camera_that_looks_straight_down():
    assert np.linalg.det(DOWN.rotation) == pytest.approx(1)
    np.testing.assert_allclose(DOWN.project([0, -0.5, 0]), [[300, 200]])
    np.testing.assert_allclose(DOWN.project([0.1, -0.5, 0]), [[460, 200]])
    np.testing.assert_allclose(DOWN.back_project([460, 200], -0.5), [[0.1, -0.5, 0]])


def test_points_behind_the_camera_are_refused():
    with pytest.raises(ValueError, match="behind the camera"):
        DOWN.project([0, 0.5, 0])


def test_rays_that_miss_the_plane_are_an_error():
    ahead = Camera(800.0, DOWN.centre, np.diag([1.0, -1, -1]), np.zeros(3))
    with pytest.raises(ValueError, match="never meets the plane"):
        ahead.back_project([300, 200])  # along the horizon
    with pytest.raises(ValueError, match="never meets the plane"):
        ahead.back_project([300, 100])  # into the sky
    assert ahead.back_project([300, 201])[0, 1] == pytest.approx(TABLE)


def test_size_does_not_depend_on_distance():
    """A square of 10 cm that faces the camera, its lower edge on the table."""
    away = np.array([2.0, 4.0])
    camera = Camera(800.0, np.array([300.0, 200]), np.eye(3)[[0, 1, 2]] * [1, -1, 1], np.zeros(3))
    foot = camera.project(np.column_stack([[0, 0], [TABLE, TABLE], away]))
    top = camera.project(np.column_stack([[0.1, 0.1], [TABLE + 0.1] * 2, away]))
    boxes = np.column_stack([foot[:, 0], top[:, 1], top[:, 0], foot[:, 1]])
    assert boxes[0, 2] - boxes[0, 0] == pytest.approx(2 * (boxes[1, 2] - boxes[1, 0]))
    assert camera.sizes(boxes) == pytest.approx([0.1, 0.1])
    assert camera.sizes([[0, 10, 50, 60]]) == np.inf  # nothing stands above the horizon


@pytest.mark.parametrize("level", LEVELS)
def test_the_size_filter_keeps_every_training_shuttlecock(level):
    sizes = [
        shot.camera.sizes(shot.boxes["shuttlecock"][None]) for shot in photos.load(level, "train")
    ]
    smallest, largest = SIZES
    assert smallest < np.min(sizes) < np.max(sizes) < largest
