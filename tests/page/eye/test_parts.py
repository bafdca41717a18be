"""Each script of the page's eye computes what the module does whose twin it is."""

from functools import cache

import numpy as np
import pytest

from book._ext.packed import light_script
from page.eye import brain
from vmc_lib import boxes, camera, photos
from vmc_lib.loop import Sight, high_recall_detector
from vmc_lib.what.stream import FLIPS, VentralStream
from vmc_lib.where.appearance import COLOUR_SPACES
from vmc_lib.where.detector import Detections
from vmc_lib.where.features import gradients
from vmc_lib.where.selective_search import propose

pytestmark = pytest.mark.browser
SHOT = photos.load("real", "test")[4]


@cache
def detector():
    return high_recall_detector("real")


def random_boxes(rng, count):
    corners = rng.uniform(-20, [620, 420], (count, 2, 2))
    return np.concatenate([corners.min(1), corners.max(1)], axis=1)


def leaves(tree, name=""):
    """The arrays and numbers of nested dicts and lists, as lists, by their path."""
    items = tree.items() if isinstance(tree, dict) else enumerate(tree)
    for key, value in items:
        if isinstance(value, dict | list | tuple):
            yield from leaves(value, f"{name}/{key}")
        else:
            yield f"{name}/{key}", value


def test_the_brain_arrives_whole(ask):
    script = """const sums = {}, weigh = (sum, x, i) => sum + x * (1 + (i % 97));
    const walk = (tree, name) => {
      for (const [key, value] of Object.entries(tree))
        if (ArrayBuffer.isView(value))
          sums[`${name}/${key}`] = [value.length, value.reduce(weigh, 0)];
        else if (typeof value === "object") walk(value, `${name}/${key}`);
        else sums[`${name}/${key}`] = value;
    };
    walk(brain, "");
    return sums;"""
    here = dict(leaves(brain.brain()))
    here["/lab"] = np.cumsum(here["/lab"], axis=2)
    for name, array in here.items():
        if isinstance(array, np.ndarray):
            values = array.ravel().astype(float)
            here[name] = [array.size, values @ (1 + np.arange(array.size) % 97)]
    there = ask(script)
    assert there.keys() == here.keys()
    for name, value in here.items():
        assert there[name] == (value if isinstance(value, str) else pytest.approx(value, 1e-9)), (
            name
        )


def test_what_a_reader_loads_is_light():
    assert len(brain.script()) < 2e6
    chapter, photo = (light_script(f"book/{name}.js").encode() for name in ("chapter", "photo"))
    assert len(photo) - len(chapter) < 60e3


def test_boxes_are_suppressed_and_are_moved(ask, rng):
    spread = rng.uniform([0, 0, 80, 80], [60, 60, 140, 140], (40, 4))
    scores, deltas = rng.normal(size=40).round(1), rng.normal(0, 0.3, (40, 4))
    script = """const [boxes, scores, deltas] = asked, kept = eye.nms(boxes, scores, 0.5);
      return {
        kept,
        padded: boxes.map((box) => eye.padBox(box, 0.2)),
        moved: boxes.map((box, i) => eye.decodeDeltas(box, deltas[i])) };"""
    there = ask(script, [array.tolist() for array in (spread, scores, deltas)])
    kept = boxes.nms(spread, scores, 0.5)
    assert there["kept"] == kept.tolist()
    assert 1 < len(kept) < 40
    assert np.allclose(there["padded"], boxes.pad_boxes(spread, 0.2), atol=1e-10)
    assert np.allclose(there["moved"], boxes.decode_deltas(spread, deltas), atol=1e-10)


def test_boxes_exactly_at_a_limit(ask):
    """An overlap of a half is allowed where a half is."""
    rows = np.array([[0, 0, 10, 10], [0, 0, 10, 5]], float)
    below = float(np.nextafter(0.5, 0))
    script = """const [rows, overlaps] = asked;
      return overlaps.map((overlap) => eye.nms(rows, [2, 1], overlap));"""
    kept = ask(script, [rows.tolist(), [0.5, below]])
    assert kept == [boxes.nms(rows, [2, 1], limit).tolist() for limit in (0.5, below)]
    assert kept == [[0, 1], [0]]


def test_physical_size(ask):
    eye = photos.load("sheet", "test")[0].camera
    given = {name: np.asarray(value).tolist() for name, value in vars(eye).items()}
    regions = [[10, 10, 60, 90], [300, 200, 420, 330], [0, -9000, 10, -8000]]
    script = "return asked[1].map((box) => String(eye.physicalSize(asked[0], box, asked[2])));"
    there = np.float64(ask(script, [given, regions, camera.TABLE]))
    assert np.allclose(there, eye.sizes(regions), rtol=1e-9)
    assert np.isinf(there).any()


@pytest.mark.parametrize("space", ["HSV", "Lab"])
def test_colours_are_those_of_opencv(ask, rng, space):
    image = rng.integers(0, 256, (100, 320, 3), dtype=np.uint8)
    image[0, :2] = [[0, 0, 0], [255, 255, 255]]
    script = "return eye.colourSpaces[asked](photo, brain.lab).map((plane) => Array.from(plane));"
    there = np.float32(ask(script, space, image))
    here = COLOUR_SPACES[space](photos.as_float(image))
    assert (there.T.reshape(here.shape) == here).all()


def test_crops_and_gradients(ask, rng):
    image, regions = SHOT.image, random_boxes(rng, 40)
    regions[0] = regions[0, [0, 1, 0, 1]]  # of no area
    script = """return asked.map((box) =>
      [eye.crop(photo, box, 16), eye.gradients(photo, box)].map((row) => Array.from(row)));"""
    crops, slopes = zip(*ask(script, regions.tolist(), image), strict=True)
    here = photos.crops(image, regions, 16)
    assert (np.float32(crops).reshape(here.shape) == here).all()
    assert np.abs(slopes - gradients(image, regions)).max() < 2e-4


def test_the_detectors_scores_of_features(ask, rng):
    x = gradients(SHOT.image, random_boxes(rng, 20))
    script = "return asked.map((x) => eye.svmScore(brain.detector, x));"
    assert np.allclose(ask(script, x.tolist()), detector().svm.score(x), atol=1e-6)


def test_the_detectors_boxes(ask):
    candidates = propose(SHOT.image, detector().recipe.strategy)
    script = "return eye.finish(eye.detect(brain.detector, photo, asked));"
    there, here = (
        ask(script, candidates.tolist(), SHOT.image),
        detector().detect(SHOT.image, candidates),
    )
    assert len(there["boxes"]) == pytest.approx(len(here.boxes), abs=1)
    best = min(8, len(here.boxes))
    assert best > 2
    assert np.allclose(there["boxes"][:best], here.boxes[:best])


@pytest.mark.parametrize("flips", [FLIPS[:1], FLIPS])
def test_the_streams_answers(ask, rng, flips):
    image, regions = SHOT.image, random_boxes(rng, 6)
    script = """const [boxes, flips] = asked;
      return boxes.map((box) => eye.look(brain.stream, photo, box, flips));"""
    there = ask(script, [regions.tolist(), flips], image)
    log_odds, deltas = VentralStream.load().predict(image, regions, flips)
    assert np.allclose([answer["logOdds"] for answer in there], log_odds, atol=1e-4)
    assert np.allclose([answer["deltas"] for answer in there], deltas, atol=1e-5)


def test_where_no_code_can_be_compiled_the_reader_is_told_what_helps(ask):
    script = """try { eye.build(new Uint8Array(8), []); } catch (error) { return error.message; }"""
    assert "those since 2023 do" in ask(script)


@pytest.mark.parametrize("probability", [[], [0.3], [0.31, 0.2], [0.9], [0.997, 0.6, 0.2]])
def test_a_sight_is_described_in_the_same_words(ask, probability):
    regions = np.arange(4.0 * len(probability)).reshape(-1, 4)
    script = """const [boxes, probability] = asked;
      const sight = new eye.Sight({ boxes, probability }, 0.4);
      return [sight.summary, sight.box];"""
    here = Sight(Detections(*[regions] * 5), np.array(probability), 0.4)
    box = None if here.box is None else here.box.tolist()
    assert ask(script, [regions.tolist(), probability]) == [here.summary, box]
