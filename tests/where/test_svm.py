import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sklearn.svm import SVC

from reproduce.localisation import steady_threshold
from vmc_lib.where.svm import KERNELS, KernelSVM, best_threshold

RNG = np.random.default_rng(0)


@pytest.mark.parametrize("kernel", KERNELS)
def test_a_machine_scores_as_libsvm_does(kernel):
    x = RNG.normal(size=(60, 5))
    y = x[:, 0] + x[:, 1] ** 2 > 0.5
    ours = KernelSVM.fit(x, y, kernel, 1.0)
    theirs = SVC(kernel=kernel, C=1.0).fit(x, y)
    assert ours.score(x) == pytest.approx(theirs.decision_function(x))
    assert len(ours.support) == (1 if kernel == "linear" else len(theirs.support_))
    assert ours.score(x[:0]).shape == (0,)


def test_a_machine_needs_both_labels_and_a_known_kernel():
    with pytest.raises(ValueError, match="counter-examples"):
        KernelSVM.fit(np.eye(3), [True] * 3)
    with pytest.raises(ValueError, match="linear, poly, rbf, sigmoid"):
        KernelSVM.fit(np.eye(2), [True, False], "gaussian")


def test_the_best_threshold_by_hand():
    scores, right = np.array([0.0, 3, 1, 2]), np.array([True, True, False, True])
    assert best_threshold(scores, right, 2) == 1.5  # 2 of 2, none wrong
    assert best_threshold(scores, right, 9) == -np.inf  # the more the better
    with pytest.raises(ValueError, match="found"):
        best_threshold(np.empty(0), np.empty(0, bool), 2)


def test_equal_scores_are_taken_together():
    scores, right = np.array([2.0, 2, 1]), np.array([True, True, False])
    assert best_threshold(scores, right, 2) == 1.5
    assert best_threshold(scores, right[::-1], 2) == -np.inf


@given(st.lists(st.tuples(st.integers(-9, 9), st.booleans()), min_size=1))
def test_no_threshold_is_better_than_the_best(pairs):
    scores, right = map(np.array, zip(*pairs, strict=True))

    def f1(threshold):
        taken = scores > threshold
        return 2 * (right & taken).sum() / (taken.sum() + right.sum() + 1)

    best = best_threshold(scores.astype(float), right, right.sum() + 1)
    assert f1(best) >= max(f1(s - 0.5) for s in scores) - 1e-9


def noisy(n, rng):
    """Scores (n,), and whether each is right: the more likely, the higher it is."""
    scores = rng.normal(size=n)
    return scores, rng.random(n) < 1 / (1 + np.exp(-4 * scores))


def test_with_many_examples_a_steady_threshold_is_the_best():
    scores, right = noisy(5000, np.random.default_rng(0))
    best = best_threshold(scores, right, right.sum())
    assert steady_threshold(scores, right) == pytest.approx(best, abs=0.15)


def test_with_few_examples_a_steady_threshold_strays_less():
    rng = np.random.default_rng(0)
    draws = [noisy(100, rng) for _ in range(50)]
    best = np.std([best_threshold(scores, right, right.sum()) for scores, right in draws])
    assert np.std([steady_threshold(*draw) for draw in draws]) < 0.8 * best
