import numpy as np
import pytest
from sklearn.svm import SVC

from vmc_lib.where.svm import KERNELS, KernelSVM


@pytest.mark.parametrize("kernel", KERNELS)
def test_scores_match_libsvm(kernel, rng):
    x = rng.normal(size=(60, 5))
    y = x[:, 0] + x[:, 1] ** 2 > 0.5
    ours = KernelSVM.fit(x, y, kernel, 1.0)
    theirs = SVC(kernel=kernel, C=1.0).fit(x, y)
    assert ours.score(x) == pytest.approx(theirs.decision_function(x))
    assert len(ours.support) == (1 if kernel == "linear" else len(theirs.support_))
    assert ours.score(x[:0]).shape == (0,)


def test_fit_needs_both_labels_and_a_known_kernel():
    with pytest.raises(ValueError, match="counter-examples"):
        KernelSVM.fit(np.eye(3), [True] * 3)
    with pytest.raises(ValueError, match="linear, poly, rbf, sigmoid"):
        KernelSVM.fit(np.eye(2), [True, False], "gaussian")
