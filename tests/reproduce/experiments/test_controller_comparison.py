"""Comparison of adaptive controllers: memory sizes, and reproducible results."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from reproduce import ledger
from reproduce.experiments.controller_comparison import (
    MOVEMENTS,
    compare,
    load_results,
    memory_size,
)
from reproduce.peers.adaptive_controllers import BY_HINDSIGHT, LEARNERS, DeltaRuleCells
from vmc_lib.cerebellum.online import GranuleCells, mossy_fibres
from vmc_lib.motor.planning import draw_targets, plan
from vmc_lib.motor.templates import load


def test_memory_size_of_learners():
    some = plan(draw_targets(load(), 20, np.random.default_rng(7)), load())
    x, y = mossy_fibres(some), some.target
    linear, ours = BY_HINDSIGHT["linear rule"]().fit(x, y), GranuleCells(cells=30).fit(x, y)
    assert memory_size(SimpleNamespace(cells=linear)) == x.size + y.size
    assert memory_size(SimpleNamespace(cells=ours)) == 30 * (4 + 30 + 2 + 2)
    both = SimpleNamespace(cells=DeltaRuleCells(cells=30).fit(x, y), model=ours)  # a distal teacher
    assert memory_size(both) == 30 * (4 + 2) + 30 * (4 + 30 + 2 + 2)


@pytest.mark.parametrize("name", ["linear rule", "feedback error"])
def test_shipped_results_are_reproducible(name):
    """One seed, fewer movements: the same numbers again, on the calm arm and on the noisy one."""
    stored = load_results()
    assert list(stored) == list(LEARNERS)
    assert all(rows["held-out"].shape == (6, len(MOVEMENTS)) for rows in stored.values())
    again = compare(*LEARNERS[name], seed=0, movements=MOVEMENTS[:2])
    for key in ("in-sample", "held-out", "held-out, noisy arm"):
        np.testing.assert_allclose(again[key], stored[name][key][0, :2], atol=2e-4)


def test_what_learns_matters_little_after_25_movements():
    """As the ledger says: most peers would hold in the place of the granule cells."""
    number = f"error over planned, own online, {MOVEMENTS[0]} movements, held-out"
    left = {name: rows["held-out"][:, 0].mean() for name, rows in load_results().items()}
    del left["granule cells (ours)"]
    rivals = replace(ledger.value("Ours, Table VI", number), nulls=left).passing_nulls()
    assert len(rivals) > len(left) / 2
