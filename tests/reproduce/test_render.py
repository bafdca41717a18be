"""Random scenes, meshes and sidecar files; rendering itself is not tested."""

import numpy as np
import pytest

from reproduce.render import decoys, furniture, scene, shuttlecocks
from reproduce.render.sidecar import store
from vmc_lib import photos


@pytest.mark.parametrize("furnish", [scene.setting, furniture.setting])
def test_scene_objects_are_in_view_and_apart(furnish):
    view = scene.draw("varied", np.random.default_rng(1), furnish)
    things = list(view.things.values())
    assert list(view.things)[:2] == list(photos.CLASSES)
    assert all(scene.is_whole(thing, view.camera) for thing in things[:2])
    for thing in things:
        assert scene.is_apart(thing, [other for other in things if other is not thing])
    assert view.table.shape == (2048, 2048, 3)


def test_occluded_scenes_are_redrawn_and_photos_load_as_stored(tmp_path):
    full, half, scenes = np.zeros((400, 600), bool), np.zeros((400, 600), bool), []
    full[10:30, 40:80], half[10:30, 40:60] = True, True

    def draw():
        scenes.append(scene.draw("varied", np.random.default_rng(len(scenes)), furniture.setting))
        return scenes[-1]

    def masks(view):
        return {"shuttlecock": (full, full if view is not scenes[0] else half), "cup": (full, full)}

    last, boxes = scene.draw_in_full_view(draw, masks)
    assert len(scenes) == 2
    assert last is scenes[1]
    assert boxes["shuttlecock"] == [40, 10, 80, 30]
    path = tmp_path / "varied/test/000.jpg"
    store(path, np.full((400, 600, 3), 9, np.uint8), last, boxes, (4, 2, 0))
    (photo,) = photos.load("varied", "test", tmp_path)
    assert photo.target.tolist() == last.target.tolist()
    assert photo.camera.focal == last.camera.focal
    assert photo.boxes["cup"].tolist() == boxes["cup"]


def make_nylon(rng):
    return shuttlecocks.nylon(rng, np.ones(3))


@pytest.mark.parametrize(
    "make", [shuttlecocks.shuttlecock, shuttlecocks.worn_shuttlecock, make_nylon]
)
def test_a_shuttlecock_stands_on_its_cork_and_has_its_length(make):
    for seed in range(3):
        mesh = make(np.random.default_rng(seed))
        low, high = mesh.vertices[:, 1].min(), mesh.vertices[:, 1].max()
        assert low == pytest.approx(0, abs=1e-3)
        assert high == pytest.approx(shuttlecocks.LENGTH, abs=0.01)
        cork = mesh.vertices[mesh.vertices[:, 1] < 0.02]
        assert np.hypot(cork[:, 0], cork[:, 2]).max() == pytest.approx(shuttlecocks.BALL, abs=1e-3)
        assert mesh.faces.max() < len(mesh.vertices) == len(mesh.colours)


@pytest.mark.parametrize("make", [*decoys.TRAINING_KINDS, *decoys.HELD_OUT_KINDS])
def test_a_decoy_is_a_finite_mesh_with_its_colour(make):
    rng, colour = np.random.default_rng(0), np.array([0.9, 0.1, 0.2])
    mesh = make(rng, colour)
    assert np.isfinite(mesh.vertices).all()
    assert np.isfinite(mesh.normals()).all()
    assert mesh.faces.max() < len(mesh.vertices) == len(mesh.colours)
    assert 0.02 < np.ptp(mesh.vertices, axis=0).max() < 0.6
    assert ((mesh.colours >= 0) & (mesh.colours <= 1)).all()
