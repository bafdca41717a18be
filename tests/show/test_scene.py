"""Recorded scenes: values that compare, travel as text and open no port."""

import base64
import json
from types import SimpleNamespace

import numpy as np
import pytest
import umsgpack
from meshcat import geometry as g
from meshcat.transformations import translation_matrix

from vmc_lib import photos
from vmc_lib.arm.simulate import simulate
from vmc_lib.show import Scene, props
from vmc_lib.show.arm import BEYOND, arm_scene


def decode(scene):
    split = (message.split("|") for message in scene.messages())
    return {key: umsgpack.unpackb(base64.b64decode(data)) for key, data in split if " " in key}


def ball(position):
    scene = Scene()
    scene["ball"].set_object(g.Sphere(0.5), g.MeshLambertMaterial(color=0xFF0000))
    scene["ball"].set_transform(translation_matrix(position))
    return scene


def test_equal_scenes_are_equal_messages():
    assert ball([1, 2, 3]).messages() == ball([1, 2, 3]).messages()
    assert ball([1, 2, 3]).messages() != ball([1, 2, 4]).messages()


def test_messages_are_meshcats_own():
    sent = decode(ball([1, 2, 3]))
    assert sent["set_transform /meshcat/ball "]["matrix"][12:15] == [1, 2, 3]
    data = sent["set_object /meshcat/ball "]["object"]
    assert data["geometries"][0]["radius"] == 0.5
    assert data["object"]["geometry"] == data["geometries"][0]["uuid"]
    assert data["object"]["material"] == data["materials"][0]["uuid"]
    assert data["geometries"][0]["uuid"] != data["materials"][0]["uuid"]


def test_copied_scene_keeps_the_last_transform():
    base = ball([1, 2, 3])
    copy = Scene(base)
    copy["ball"].set_transform(translation_matrix([4, 5, 6]))
    copy.look((1, 0, 0), at=(0, 0, 0))
    assert len(copy.messages()) == len(base.messages())
    assert decode(copy)["set_transform /meshcat/ball "]["matrix"][12:15] == [4, 5, 6]
    assert decode(base)["set_transform /meshcat/ball "]["matrix"][12:15] == [1, 2, 3]
    assert json.loads(copy.messages()[0].split("|")[1]) == [[1, 0, 0], [0, 0, 0]]


def message(scene, name):
    """What the scene tells the viewer under that name."""
    [data] = [m.removeprefix(f"{name}|") for m in scene.messages() if m.startswith(f"{name}|")]
    return json.loads(data)


def test_moving_the_arm_changes_only_the_motion():
    before, after = (dict(m.split("|") for m in arm_scene((-0.3, q)).messages()) for q in (1, 1.2))
    assert {key for key in before if before[key] != after[key]} == {"motion"}
    assert before.keys() == after.keys()


def test_movement_is_sampled_at_50_hz():
    q, active = np.random.default_rng(0).random((2, 101, 6))
    motion = message(arm_scene(q[:, :2], active, turn=np.linspace(0, 1, 101), grasp=True), "motion")
    assert np.allclose(motion["q"], q[::20, :2], atol=1e-4)
    assert np.allclose(motion["activation"], active[::20], atol=1e-4)
    assert motion["turn"] == pytest.approx([0, 0.2, 0.4, 0.6, 0.8, 1])
    assert motion["grasp"][-1] == 1 > motion["grasp"][0]


def test_target_is_offset_by_the_length_of_the_hand():
    turn, place = 0.5, (0.2, -0.39, 0.1)
    scene = arm_scene((-0.3, 1.0), turn=turn, balls=[(place, "green"), (place, "red")])
    sent = decode(scene)
    for i in range(2):
        assert np.allclose(sent[f"set_transform /meshcat/goal/ball{i} "]["matrix"][12:15], place)
    beyond = sent["set_transform /meshcat/goal "]["matrix"][12:15]
    assert np.linalg.norm(beyond) == pytest.approx(np.linalg.norm(BEYOND))
    assert beyond[1] == pytest.approx(BEYOND[1])
    assert message(scene, "target") == list(place)


def test_a_scene_tells_where_a_movement_ends_and_how_fast_the_hand_is_there():
    target, place = (0.2, -0.39, 0.1), (0.2, -0.38, 0.1)
    scene = arm_scene((-0.3, 1.0), balls=[(target, "green")], end=(place, 0.0123))
    assert message(scene, "end") == {"off": 0.01, "speed": 0.0123}
    assert np.allclose(decode(scene)["set_transform /meshcat/goal/end "]["matrix"][12:15], place)


def test_cup_and_table_have_the_colours_of_the_photo():
    photo = photos.load("rig", "test")[1]
    image = np.full_like(photo.image, (10, 120, 30))
    x0, y0, x1, y1 = photo.boxes["cup"].astype(int)
    image[y0:y1, x0:x1] = 20, 40, 200
    image[::3] = 255  # what is lit is not what it is like
    painted = SimpleNamespace(**vars(photo) | {"image": image, "camera": photo.camera})
    sent = decode(arm_scene((-0.3, 1.0), photo=painted))
    for name, colour in {
        "goal/cup": 0x1428C8,
        "table/top": 0x0A781E,
        "table/leg0": 0x0A781E,
    }.items():
        [material] = sent[f"set_object /meshcat/{name} "]["object"]["materials"]
        assert material["color"] == colour, name


def projects_into(photo, point, name):
    pixel, box = photo.camera.project(point)[0], photo.boxes[name]
    return (box[:2] < pixel).all() and (pixel < box[2:]).all()


@pytest.mark.parametrize("pose", ["standing", "lying"])
def test_shuttlecock_and_cup_lie_as_in_the_photo(pose):
    shots = [p for level in photos.LEVELS for p in photos.load(level, "test") if p.pose == pose]
    for photo in shots[:10]:
        matrix = props.shuttlecock_pose(photo)
        middle = matrix @ [0, props.LENGTH / 2, 0, 1]
        assert np.allclose(middle[:3], photo.target)
        assert np.allclose(matrix[:3, :3].T @ matrix[:3, :3], np.eye(3))
        rim = matrix @ [0, props.LENGTH, 0, 1]
        assert projects_into(photo, rim[:3], "shuttlecock")
        sent = decode(arm_scene((-0.3, 1.0), photo=photo))
        cup = sent["set_transform /meshcat/goal/cup "]["matrix"][12:15]
        assert projects_into(photo, np.add(cup, (0, 0.045, 0)), "cup")


def test_a_movement_is_shown_as_it_was_returned():
    motion = simulate(np.full((50, 6), 0.1), (0.0, 1.0))
    assert decode(arm_scene(motion)) == decode(arm_scene(motion.q, motion.activation))
