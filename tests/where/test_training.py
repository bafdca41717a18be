from dataclasses import replace

import numpy as np
import pytest

from vmc_lib import photos
from vmc_lib.boxes import iou
from vmc_lib.data import arrays
from vmc_lib.where.recipes import PUBLISHED
from vmc_lib.where.selective_search import propose
from vmc_lib.where.training import candidates, examples, training_examples, training_images


@pytest.fixture(scope="module")
def photo():
    return photos.load("rig", "validation")[0]


@pytest.mark.parametrize("strategy", ["single", "finer"])
def test_candidates_that_ship_are_those_of_the_search(photo, strategy):
    """Most of them: another processor may round a pixel differently."""
    known, found = candidates(photo, strategy), propose(photo.image, strategy)
    assert arrays("candidates")[f"{photo.name}/{strategy}"].dtype == np.int16
    shipped, again = ({tuple(box) for box in boxes} for boxes in (known, found))
    assert len(shipped & again) > 0.9 * len(shipped | again)
    assert (candidates(replace(photo, name="mine"), strategy) == found).all()


def test_examples_are_clear_cases(photo):
    x, y = examples([photo])
    overlap = iou(candidates(photo), list(photo.boxes.values())).max(1)
    assert x.shape == (len(y), 768)
    assert y.sum() == (overlap >= 0.8).sum() > 0
    assert (~y).sum() == (overlap <= 0.5).sum() > 50


def test_what_is_learnt_from(photo):
    """Every example, so many shaken boxes an object, and no more counter-examples than asked."""
    recipe = replace(PUBLISHED, jittered=5, mirror=True)
    seen = training_images([photo] * 30, recipe)
    x, y = training_examples(seen, recipe, np.random.default_rng(0))
    good = (seen[0].overlap >= 0.8).sum()
    assert x.shape == (len(y), 768) and y.sum() == 60 * (good + 10)
    assert (~y).sum() == 60 * min(79, (seen[0].overlap <= 0.5).sum())


def test_a_mirrored_image_is_as_hard(photo):
    seen = training_images([photo], replace(PUBLISHED, mirror=True))
    assert len(seen) == 2 and (seen[0].overlap == seen[1].overlap).all()
    assert (seen[1].pixels[:, 0] == photo.image[:, -1]).all()
