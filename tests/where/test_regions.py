from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sklearn.svm import SVC

from vmc_lib import photos
from vmc_lib.where import regions
from vmc_lib.where.boxes import as_boxes, iou
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


def test_what_is_learnt_from(photo):
    """Every example, so many shaken boxes an object, and no more counter-examples than asked."""
    recipe = replace(regions.PUBLISHED, shaken=5, mirror=True)
    seen = regions.scenes([photo] * 30, recipe)
    x, y = regions.training_examples(seen, recipe, np.random.default_rng(0))
    good = (seen[0].overlap >= 0.8).sum()
    assert x.shape == (len(y), 768) and y.sum() == 60 * (good + 10)
    assert (~y).sum() == 60 * min(79, (seen[0].overlap <= 0.5).sum())


def test_a_mirrored_scene_is_as_hard(photo):
    seen = regions.scenes([photo], replace(regions.PUBLISHED, mirror=True))
    assert len(seen) == 2 and (seen[0].overlap == seen[1].overlap).all()
    assert (seen[1].image[:, 0] == photo.image[:, -1]).all()


def test_candidates_that_ship_are_those_of_the_search(photo):
    """Most of them: another processor may round a pixel differently."""
    shipped, found = (
        {tuple(b) for b in boxes} for boxes in (candidates(photo), propose(photo.image))
    )
    assert len(shipped & found) > 0.9 * len(shipped | found)
    assert regions.stored("candidates")[f"{photo.name}/single"].dtype == np.int16
    finer = regions.stored("candidates")[f"{photo.name}/finer"]
    assert (candidates(photo, regions.LOOKS.strategy) == finer).all()
    unknown = replace(photo, name="mine")
    assert (candidates(unknown) == propose(photo.image)).all()


@pytest.mark.parametrize("name", ["published", "context"])
def test_training_again_gives_the_finder_that_ships(name):
    few = photos.load("rig", "train")
    trained, shipped = (
        RegionFinder.fit(few, regions.RECIPES[name]),
        RegionFinder.load("rig", name),
    )
    assert trained.machine.support == pytest.approx(shipped.machine.support, abs=1e-3)
    assert trained.machine.bias == pytest.approx(shipped.machine.bias, abs=1e-3)


def test_the_same_seed_learns_the_same(monkeypatch):
    monkeypatch.setattr(regions, "SCATTERED", 200)
    few, small = photos.load("rig", "train")[:4], replace(regions.IMPROVED, strategy="single")
    once, again, other = (
        RegionFinder.fit(few, small, np.random.default_rng(seed)).parts() for seed in (1, 1, 2)
    )
    for part, value in once.items():
        np.testing.assert_array_equal(value, again[part])
    assert not np.array_equal(once["maps"], other["maps"])


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
        for before, after in ((0, 1), (1, 4)):
            looks = [finder.look_again(other.image, off, n) for n in (before, after)]
            gains.append([np.diag(iou(b, truth)).mean() for b in looks])
    before, after = np.mean(gains, 0)
    assert after > before + 0.05


def test_votes_pull_towards_the_crowd():
    crowd = np.array([[0, 0, 10, 10], [0, 0, 12, 10], [50, 50, 60, 60]], float)
    voted = regions.vote(np.array([0]), crowd, np.array([2.0, 2.0, 3.0]))
    assert voted == pytest.approx(np.array([[0, 0, 11, 10]]))
    lagging = regions.vote(np.array([0]), crowd, np.array([2.0, 0.0, 3.0]))
    assert lagging == pytest.approx(crowd[:1], abs=1e-3)


def test_the_best_threshold_by_hand():
    scores, right = np.array([0.0, 3, 1, 2]), np.array([True, True, False, True])
    assert regions.best_threshold(scores, right, 2) == 1.5  # 2 of 2, none wrong
    assert regions.best_threshold(scores, right, 9) == -np.inf  # the more the better
    with pytest.raises(ValueError, match="found"):
        regions.best_threshold(np.empty(0), np.empty(0, bool), 2)


@given(st.lists(st.tuples(st.integers(-9, 9), st.booleans()), min_size=1, unique_by=lambda p: p[0]))
def test_no_threshold_is_better_than_the_best(pairs):
    scores, right = map(np.array, zip(*pairs, strict=True))

    def f1(threshold):
        taken = scores > threshold
        return 2 * (right & taken).sum() / (taken.sum() + right.sum() + 1)

    best = regions.best_threshold(scores.astype(float), right, right.sum() + 1)
    assert f1(best) >= max(f1(s - 0.5) for s in scores) - 1e-9


def test_tuning_moves_the_threshold_alone(photo):
    finder = RegionFinder.load("rig", "gradients")
    tuned = finder.tuned([photo])
    assert replace(tuned, threshold=finder.threshold) == finder
    published = RegionFinder.load("rig", "published")
    assert published.tuned([photo]) is published and published.threshold == 0


def test_a_judge_tells_a_fit_from_a_near_miss():
    """On photos it never saw: boxes off by a sixth score below the true ones, mostly."""
    finder, better = RegionFinder.load("rig"), []
    for other in photos.load("rig", "validation")[:10]:
        truth = np.array(list(other.boxes.values()))
        off = corrected(truth, np.tile([0.15, 0.1, 0, 0], (len(truth), 1)))
        fits, misses = (
            finder.judge.score(finder.recipe.describe(other.image, b)) for b in (truth, off)
        )
        better += list(fits > misses)
    assert np.mean(better) > 0.9


@pytest.mark.parametrize("name", regions.RECIPES)
def test_nothing_there_nothing_found(name):
    finder = RegionFinder.load("rig", name)
    blank = np.full((400, 600, 3), 128, np.uint8)
    for boxes in (None, np.empty((0, 4))):
        found = finder.find(blank, boxes)
        assert found.boxes.shape == (0, 4) and found.scores.shape == (0,)


anywhere = st.builds(
    lambda x, y, w, h: (x, y, x + w, y + h),
    *[st.integers(-300, 900)] * 2,
    *[st.sampled_from([0, 1, 60, 700])] * 2,
)


@settings(max_examples=15, deadline=None)
@given(st.lists(anywhere, max_size=8).map(as_boxes), st.sampled_from(["published", "improved"]))
def test_candidates_of_no_area_or_beyond_the_image(photo, boxes, name):
    """Whatever the candidates, what is kept are boxes: finite, none inside out."""
    found = RegionFinder.load("rig", name).find(photo.image, boxes)
    assert len(found.candidate_scores) == len(boxes)
    assert as_boxes(found.boxes).shape == (len(found.scores), 4)
    assert np.isfinite(found.scores).all()


@pytest.mark.parametrize("image", [np.zeros((40, 60)), np.zeros((40, 60, 3)), np.uint8([[1, 2]])])
def test_an_image_of_another_kind(image):
    with pytest.raises(ValueError, match="read_image"):
        RegionFinder.load("rig").score(image, [(0, 0, 30, 30)])


def test_unknown_finders():
    for level, name in (("rig", "best"), ("attic", "published")):
        with pytest.raises(
            ValueError, match="published, context, gradients, looks, judged, improved"
        ):
            RegionFinder.load(level, name)
