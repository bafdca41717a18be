from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sklearn.svm import SVC

from vmc_lib import photos
from vmc_lib.where import regions
from vmc_lib.where.boxes import iou
from vmc_lib.where.regions import Machine, RegionFinder, candidates, corrected, corrections
from vmc_lib.where.selective_search import propose

RNG = np.random.default_rng(0)


@pytest.fixture(scope="module")
def photo():
    return photos.load("rig", "validation")[0]


@pytest.mark.parametrize("kernel", regions.KERNELS)
def test_a_machine_scores_as_libsvm_does(kernel):
    x = RNG.normal(size=(60, 5))
    y = x[:, 0] + x[:, 1] ** 2 > 0.5
    ours = Machine.fit(x, y, kernel, 1.0)
    theirs = SVC(kernel=kernel, C=1.0).fit(x, y)
    assert ours.score(x) == pytest.approx(theirs.decision_function(x))
    assert len(ours.support) == (1 if kernel == "linear" else len(theirs.support_))


def test_a_machine_needs_both_labels_and_a_known_kernel():
    with pytest.raises(ValueError, match="counter-examples"):
        Machine.fit(np.eye(3), [True] * 3)
    with pytest.raises(ValueError, match="linear, poly, rbf, sigmoid"):
        Machine.fit(np.eye(2), [True, False], "gaussian")


boxes = st.builds(
    lambda x, y, w, h: np.array([[x, y, x + w, y + h]], float),
    *[st.integers(0, 300)] * 2,
    *[st.integers(5, 200)] * 2,
)


@given(boxes, boxes)
def test_a_corrected_box_is_the_true_box(box, true):
    assert corrected(box, corrections(box, true)) == pytest.approx(true, abs=1e-6)


@given(boxes)
def test_two_mirrors_change_nothing(box):
    assert (regions.mirrored(regions.mirrored(box, 600), 600) == box).all()


def test_examples_are_clear_cases(photo):
    x, y = regions.examples([photo])
    overlap = iou(candidates(photo), list(photo.boxes.values())).max(1)
    assert x.shape == (len(y), 768)
    assert y.sum() == (overlap >= 0.8).sum() > 0
    assert (~y).sum() == (overlap <= 0.5).sum() > 50


def test_a_mirror_doubles_the_examples(photo):
    plain, twice = (
        regions.examples([photo], replace(regions.PUBLISHED, mirror=mirror))[1]
        for mirror in (False, True)
    )
    assert twice.tolist() == [*plain, *plain]


def test_candidates_that_ship_are_those_of_the_search(photo):
    """Most of them: another processor may round a pixel differently."""
    shipped, found = (
        {tuple(b) for b in boxes} for boxes in (candidates(photo), propose(photo.image))
    )
    assert len(shipped & found) > 0.9 * len(shipped | found)
    assert regions.stored("candidates")[f"{photo.name}/single"].dtype == np.int16
    unknown = replace(photo, name="mine")
    assert (candidates(unknown) == propose(photo.image)).all()


def test_training_again_gives_the_finder_that_ships():
    few = photos.load("rig", "train")
    trained, shipped = RegionFinder.fit(few), RegionFinder.load("rig", "published")
    assert trained.machine.support == pytest.approx(shipped.machine.support, abs=1e-3)
    assert trained.machine.bias == pytest.approx(shipped.machine.bias, abs=1e-3)


def test_a_finder_narrows_down_step_by_step(photo):
    finder = RegionFinder.load("rig", "published")
    found = finder.find(photo.image)
    counts = list(found.counts.values())
    assert counts[0] > counts[1] >= counts[2] > 0
    assert (found.passed_scores > 0).all() and (np.diff(found.scores) <= 0).all()
    between = iou(found.boxes, found.boxes)
    assert between[np.triu_indices(len(found.boxes), 1)].max(initial=0) <= 0.3
    assert finder.score(photo.image, found.boxes) == pytest.approx(found.scores)


def test_looking_again_brings_a_box_nearer(photo):
    """On photos it never saw, from boxes off by a fifth of a side."""
    finder, gains = RegionFinder.load("rig"), []
    for other in photos.load("rig", "validation")[:5]:
        truth = np.array(list(other.boxes.values()))
        off = corrected(truth, np.tile([0.2, -0.2, 0.1, 0.1], (len(truth), 1)))
        for before, after in ((0, 1), (1, 3)):
            looks = [finder.look_again(other.image, off, n) for n in (before, after)]
            gains.append([np.diag(iou(b, truth)).mean() for b in looks])
    before, after = np.mean(gains, 0)
    assert after > before + 0.05


def test_votes_pull_towards_the_crowd():
    crowd = np.array([[0, 0, 10, 10], [0, 0, 12, 10], [50, 50, 60, 60]], float)
    voted = regions.vote(crowd[:1], crowd, np.array([2.0, 1.0, 3.0]))
    assert voted == pytest.approx(np.array([[0, 0, 10 + 2 / 3, 10]]), abs=1e-3)


@pytest.mark.parametrize("name", regions.RECIPES)
def test_nothing_there_nothing_found(name):
    finder = RegionFinder.load("rig", name)
    blank = np.full((400, 600, 3), 128, np.uint8)
    for boxes in (None, np.empty((0, 4))):
        found = finder.find(blank, boxes)
        assert found.boxes.shape == (0, 4) and found.scores.shape == (0,)


@pytest.mark.parametrize("image", [np.zeros((40, 60)), np.zeros((40, 60, 3)), np.uint8([[1, 2]])])
def test_an_image_of_another_kind(image):
    with pytest.raises(ValueError, match="read_image"):
        RegionFinder.load("rig").score(image, [(0, 0, 30, 30)])


def test_unknown_finders():
    for level, name in (("rig", "best"), ("attic", "published")):
        with pytest.raises(ValueError, match="published, gradients, looks, improved"):
            RegionFinder.load(level, name)
