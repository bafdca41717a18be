"""Learning under motor noise: shipped results are reproducible."""

import numpy as np
import pytest

from reproduce.experiments.learning_under_noise import (
    LEARNERS,
    LEVELS,
    compare_learners,
    load_results,
)


@pytest.mark.audit
def test_shipped_results_are_reproducible():
    """One seed, fewer movements: the same numbers again."""
    stored = load_results()
    assert list(stored) == [f"{mm} mm" for mm in LEVELS]
    name = "granule cells"
    again = compare_learners(5, 0, {name: LEARNERS[name]}, sizes=(25, 50))
    for key, values in again.items():
        shipped = stored["5 mm"][key][0]
        np.testing.assert_allclose(values, shipped[:2] if shipped.ndim else shipped, atol=2e-4)


def test_slower_learning_ends_nearer_where_noise_is_strong():
    strong = {k: v.mean(axis=0) for k, v in load_results()["10 mm"].items()}
    last = [strong[f"delta rule, rate {rate}, held-out"][-1] for rate in (0.02, 0.1, 0.4)]
    assert last == sorted(last)
    assert strong["a larger ridge, held-out"][-1] < strong["granule cells, held-out"][-1]
