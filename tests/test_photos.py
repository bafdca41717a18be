"""The photo set, and reading images."""

import hashlib
import json
import re
from copy import deepcopy
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from reproduce.training.photographs import COUNTEREXAMPLES
from vmc_lib import photos
from vmc_lib.arm.kinematics import turn_towards
from vmc_lib.camera import TABLE
from vmc_lib.photos import FOLDER, HEIGHT, LEVELS, SPLITS, WIDTH

EVERY = [(level, split) for level in LEVELS for split in SPLITS]
COUNTS = {(level, split): 40 if split != "validation" else 20 for level, split in EVERY}
COUNTS["varied", "train"] = 160
REAL = {"train": (33, 5, 10), "validation": (17, 3, 5), "test": (18, 3, 5)}


def test_levels_are_loaded_in_turn_in_steps():
    names = [photo.name for level in photos.LEVELS for photo in photos.load(level, "train")[::20]]
    assert [photo.name for photo in photos.load_levels("train", step=20)] == names


@pytest.mark.parametrize(("level", "split"), EVERY)
def test_every_photo_agrees_with_its_sidecar(level, split):
    shots = photos.load(level, split)
    assert len(shots) == COUNTS[level, split]
    for shot in shots:
        assert shot.image.shape == (HEIGHT, WIDTH, 3)
        assert shot.image.std() > 10
        assert not shot.image.flags.writeable
        assert not any(box.flags.writeable for box in shot.boxes.values())
        assert set(shot.boxes) == set(photos.CLASSES)
        for x0, y0, x1, y1 in shot.boxes.values():
            assert 0 < x0 < x0 + 15 < x1 < min(WIDTH, x0 + 250)
            assert 0 < y0 < y0 + 15 < y1 < min(HEIGHT, y0 + 250)
        rotation = shot.camera.rotation
        np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)
        assert np.linalg.det(rotation) == pytest.approx(1)

        box = shot.boxes["shuttlecock"]
        centre = shot.camera.project(shot.target)[0]
        middle, size = (box[:2] + box[2:]) / 2, box[2:] - box[:2]
        assert np.all(np.abs(centre - middle) < 0.2 * size)
        assert shot.pose in ("lying", "standing")
        assert 0.015 < shot.target[1] - TABLE < 0.05


def test_boxes_are_read_only_for_all_who_share_them(photo):
    with pytest.raises(TypeError, match="does not support item assignment"):
        photo.boxes["cup"] = np.zeros(4)


def test_a_photo_is_copied_with_its_boxes(photo):
    np.testing.assert_equal(deepcopy(photo).boxes, dict(photo.boxes))


@pytest.mark.parametrize("level", LEVELS)
def test_every_target_lies_where_the_turned_arm_can_reach(level):
    for shot in photos.load(level, "validation"):
        psi, plane = turn_towards(shot.target)
        assert 0.06 < plane[0] < 0.24
        assert psi == pytest.approx(shot.turn, abs=np.radians(6))
        assert plane[1] == pytest.approx(shot.target[1])


def test_boxes_match_the_pixels_of_their_things():
    for shot in photos.load("rig", "validation"):  # where only the table is orange
        red, _, blue = shot.image.astype(float).transpose(2, 0, 1)
        thing = blue > 0.65 * red
        for x0, y0, x1, y1 in shot.boxes.values():
            window = np.s_[int(y0) : int(y1), int(x0) : int(x1)]
            rows, columns = np.nonzero(thing[window])
            corners = [columns.min(), rows.min(), columns.max() + 1, rows.max() + 1]
            np.testing.assert_allclose(corners, [0, 0, x1 - x0, y1 - y0], atol=4)
        for x0, y0, x1, y1 in shot.boxes.values():
            thing[int(y0) - 2 : int(y1) + 2, int(x0) - 2 : int(x1) + 2] = False
        assert thing.mean() < 1e-4


def test_camera_differs_outside_the_rig():
    places = {
        level: {tuple(shot.camera.position) for shot in photos.load(level, "train")}
        for level in LEVELS
    }
    assert len(places["rig"]) == 1
    for level in ("free", "varied"):
        assert len(places[level]) == COUNTS[level, "train"]


def test_splits_share_no_photo_and_no_target():
    files = sorted(FOLDER.glob("*/*/*.jpg"))
    with_sheet = photos.load(photos.SHEET_LEVEL, "test")
    assert len(files) == sum(COUNTS.values()) + sum(map(sum, REAL.values())) + len(with_sheet)
    assert len({hashlib.sha256(file.read_bytes()).digest() for file in files}) == len(files)
    targets = {tuple(shot.target) for group in EVERY for shot in photos.load(*group)}
    assert len(targets) == sum(COUNTS.values())


def test_the_real_level_shows_shuttlecocks_cups_and_neither():
    for split, counts in REAL.items():
        shots = photos.load("real", split)
        kinds = [tuple(shot.boxes) for shot in shots]
        assert tuple(map(kinds.count, [("shuttlecock",), ("cup",), ()])) == counts
        for shot in shots:
            assert shot.name.startswith(f"real/{split}/")
            assert shot.camera is None
            for x0, y0, x1, y1 in [*shot.boxes.values(), *shot.more, *shot.unclear]:
                assert 0 <= x0 < x0 + 20 <= x1 <= WIDTH
                assert 0 <= y0 < y0 + 20 <= y1 <= HEIGHT
    assert any(len(shot.more) for shot in photos.load("real", "train"))


def test_further_boxes_belong_to_a_photos_one_kind():
    (shot,) = [one for one in photos.load("real", "train") if one.name.endswith("001")]
    boxes = photos.boxes_of(shot, "shuttlecock")
    np.testing.assert_array_equal(boxes, [shot.boxes["shuttlecock"], *shot.more])
    assert photos.boxes_of(shot, "cup").shape == (0, 4)
    both = replace(shot, boxes=shot.boxes | {"cup": boxes[0]})
    with pytest.raises(ValueError, match="shuttlecock, cup"):
        photos.boxes_of(both, "cup")


def test_the_real_level_is_split_by_place_and_credited():
    credits = (FOLDER.parents[2] / "CREDITS.md").read_text(encoding="utf-8")
    places = {}
    for file in FOLDER.glob("real/*/*.json"):
        sidecar = json.loads(file.read_bytes())
        assert places.setdefault(sidecar["place"], file.parent.name) == file.parent.name
        assert sidecar["licence"] in credits
        assert photos.load("real", file.parent.name)[0].credit.endswith(sidecar["licence"])
        link = re.search(r"universe.roboflow.com/[\w/-]*\w", sidecar["credit"])
        assert link[0].removesuffix("/dataset/29") in credits


def test_everyday_photos_are_small_and_credited():
    shots = photos.everyday()
    assert len(shots) == len(list(photos.EVERYDAY.glob("*.jpg"))) >= 8
    credits = (FOLDER.parents[2] / "CREDITS.md").read_text(encoding="utf-8")
    for shot in (*shots, *photos.load("real", "train")):
        assert shot.image.shape == (HEIGHT, WIDTH, 3)
        assert not shot.image.flags.writeable
    for shot in shots:
        assert shot.image.std() > 10
        assert (photos.EVERYDAY / f"{shot.name}.jpg").stat().st_size <= 60_000
        assert f"`{shot.name}`" in credits
        assert shot.credit.split("; ")[-1] in credits
        for x0, y0, x1, y1 in shot.boxes.values():
            assert 0 <= x0 < x0 + 20 <= x1 <= WIDTH
            assert 0 <= y0 < y0 + 20 <= y1 <= HEIGHT


def test_counterexamples_are_split_by_scene_and_credited():
    credits = (FOLDER.parents[2] / "CREDITS.md").read_text(encoding="utf-8")
    splits = {}
    for file in sorted(COUNTEREXAMPLES.glob("real/*/*.json")):
        sidecar = json.loads(file.read_text(encoding="utf-8"))
        assert splits.setdefault(sidecar["scene"], file.parent.name) == file.parent.name
        assert not sidecar["boxes"]
        assert sidecar["credit"]
        assert sidecar["licence"].startswith(("CC BY 2.0", "CC BY 4.0", "MIT"))
        assert sidecar["source"].split("@")[0] in credits
    for split in photos.SPLITS:
        assert all(one.image.std() > 10 for one in photos.load("real", split, COUNTEREXAMPLES))


def test_an_unknown_level_or_split_is_refused():
    with pytest.raises(ValueError, match="unknown level 'rigg'"):
        photos.load("rigg", "train")
    with pytest.raises(ValueError, match="unknown split 'dev'"):
        photos.load("rig", "dev")


@pytest.fixture
def picture(rng):
    return rng.integers(0, 256, (HEIGHT, WIDTH, 3), dtype=np.uint8)


def test_reading_keeps_a_photo_as_it_is(picture, tmp_path):
    np.testing.assert_array_equal(photos.read_image(picture), picture)
    Image.fromarray(picture).save(tmp_path / "photo.png")
    np.testing.assert_array_equal(photos.read_image(tmp_path / "photo.png"), picture)
    np.testing.assert_array_equal(photos.read_image(str(tmp_path / "photo.png")), picture)


def test_reading_converts_grey_transparent_and_float_images(picture):
    grey = picture[..., 0]
    for image in (grey, grey[..., None]):
        np.testing.assert_array_equal(photos.read_image(image), np.dstack([grey] * 3))
    glass = np.dstack([picture, np.full_like(grey, 255)])
    np.testing.assert_array_equal(photos.read_image(glass), picture)
    glass[:200, :, 3] = 0
    np.testing.assert_array_equal(photos.read_image(glass)[:200], np.full((200, 600, 3), 255))
    np.testing.assert_array_equal(photos.read_image(glass)[200:], picture[200:])
    np.testing.assert_array_equal(photos.read_image(picture / 255.0), picture)


def test_reading_takes_huge_and_transparent_files(tmp_path, monkeypatch):
    Image.new("RGB", (8000, 6000), (200, 30, 30)).save(tmp_path / "huge.jpg")
    monkeypatch.setenv("HOME", str(tmp_path))
    image = photos.read_image("~/huge.jpg")
    assert np.all(abs(image[200, 300].astype(int) - (200, 30, 30)) < 4)
    clear = Image.new("LA", (30, 20), (9, 0))
    clear.save(tmp_path / "clear.png")
    assert np.all(photos.read_image(tmp_path / "clear.png") == 255)


def test_reading_letterboxes_other_sizes():
    tall = photos.read_image(np.full((800, 400, 3), 200, np.uint8))
    assert tall.shape == (HEIGHT, WIDTH, 3)
    assert np.all(tall[:, 200:400] == 200)
    assert np.all(tall[:, :200] == 128)
    small = photos.read_image(np.full((20, 30), 9, np.uint8))
    assert np.all(small == 9)


@pytest.mark.parametrize(
    ("array", "message"),
    [
        (np.zeros((400, 600, 3)) - 1, "finite values in 0..1"),
        (np.full((400, 600, 3), np.nan), "finite values in 0..1"),
        (np.full((400, 600, 3), 255.0), "finite values in 0..1"),
        (np.zeros((400, 600, 3), np.int64), "int64"),
        (np.zeros((400, 600, 2), np.uint8), "shape \\(400, 600, 2\\)"),
        (np.zeros((0, 600, 3), np.uint8), "shape \\(0, 600, 3\\)"),
        (np.zeros(7, np.uint8), "shape \\(7,\\)"),
        (None, "NoneType"),
    ],
)
def test_reading_refuses_wrong_arrays(array, message):
    with pytest.raises(ValueError, match=message):
        photos.read_image(array)


def test_reading_refuses_damaged_files(picture, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ValueError, match=f"no photo at {tmp_path}/missing.jpg"):
        photos.read_image("missing.jpg")
    with pytest.raises(ValueError, match="is a folder: name a file in it"):
        photos.read_image(tmp_path)
    (tmp_path / "text.jpg").write_text("not a photo", encoding="utf-8")
    with pytest.raises(ValueError, match="not an image"):
        photos.read_image(tmp_path / "text.jpg")
    for name in ("cut.jpg", "cut.png"):
        Image.fromarray(picture).save(tmp_path / name)
        contents = (tmp_path / name).read_bytes()
        (tmp_path / name).write_bytes(contents[: len(contents) // 2])
        with pytest.raises(ValueError, match="cannot be read"):
            photos.read_image(tmp_path / name)
    Image.fromarray(np.zeros((40, 60), np.uint16)).save(tmp_path / "deep.png")
    with pytest.raises(ValueError, match="more than 8 bits"):
        photos.read_image(tmp_path / "deep.png")


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("https://example.org/a.jpg", "is an address: save the photo"),
        ("file:///a.jpg", "is an address"),
        ("~nobody-of-that-name/a.jpg", "cannot be read"),
        (".", "is a folder"),
    ],
)
def test_what_is_no_file_is_told(name, words):
    with pytest.raises(ValueError, match=words):
        photos.read_image(name)
