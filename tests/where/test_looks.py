"""On photos that the shipped finder never saw."""

from dataclasses import replace

import numpy as np
import pytest

from vmc_lib import photos
from vmc_lib.where import looks
from vmc_lib.where.boxes import corrected, iou
from vmc_lib.where.lessons import lessons
from vmc_lib.where.recipes import IMPROVED
from vmc_lib.where.regions import RegionFinder


@pytest.fixture(scope="module")
def finder():
    return RegionFinder.load("rig")


def astray(photo, by):
    """A photo's true boxes, and boxes off by so many sides."""
    truth = np.array(list(photo.boxes.values()))
    return truth, corrected(truth, np.tile(by, (len(truth), 1)))


def test_looking_again_brings_a_box_nearer(finder):
    first, rest = [], []
    for photo in photos.load("rig", "validation")[:5]:
        truth, off = astray(photo, [0.2, -0.2, 0.1, 0.1])
        boxes = [finder.look_again(photo.image, off, n) for n in (0, 1, 4)]
        before, once, again = (np.diag(iou(b, truth)).mean() for b in boxes)
        first.append(once - before)
        rest.append(again - once)
    assert np.mean(first) > 0.05 and np.mean(rest) > 0.05


def test_a_judge_tells_a_fit_from_a_near_miss(finder):
    """Boxes off by a sixth score below the true ones, mostly."""
    better = []
    for photo in photos.load("rig", "validation")[:10]:
        boxes = astray(photo, [0.15, 0.1, 0, 0])
        fits, misses = (finder.judge(finder.recipe.describe(photo.image, some)) for some in boxes)
        better += list(fits > misses)
    assert np.mean(better) > 0.9


def test_a_bare_photo_teaches_the_judge_misfits(finder, monkeypatch):
    """Candidates beside no object at all are counter-examples, like others far from one."""
    monkeypatch.setattr(looks, "JUDGED", 600)
    seen = lessons(photos.load("rig", "train")[:3], replace(IMPROVED, mirror=False))
    bare = replace(seen[0], truth=np.empty((0, 4)))
    judge = looks.learn_to_judge(
        [*seen, bare], IMPROVED, finder.machine, finder.looks, np.random.default_rng(0)
    )
    assert judge.axes.shape == (800, looks.DIRECTIONS)
    shown = (IMPROVED.describe(seen[0].image, boxes) for boxes in (bare.boxes, seen[0].truth))
    bared, objects = (judge(x).mean() for x in shown)
    assert bared < 0.2 < objects
