"""A row that is reproduced or beaten can fail: break what it rests on, and its verdict changes."""

from dataclasses import replace
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

from reproduce import ledger
from reproduce.experiments import localisation, second_plant
from reproduce.ledger import calibration, loop, naming, planning, regions
from reproduce.ledger.entry import BEATEN, DIFFERS, REPRODUCED, measure
from vmc_lib import photos
from vmc_lib.what import cdbn
from vmc_lib.where.svm import KernelSVM

ROWS = {row.where: row for row in ledger.ROWS}
HOLDS = [e["where"] for e in ledger.load()["rows"] if e["verdict"] in (REPRODUCED, BEATEN)]
FEW = range(3)  # draws, to be quick


@pytest.fixture(autouse=True)
def afresh():
    """What a row has measured is kept for the next: not across a break."""
    caches = (
        planning.planned_error_ratios,
        planning.errors_3d,
        calibration.nearer_shares,
        naming.gabor_correlations,
    )
    for function in caches:
        function.cache_clear()
    yield
    for function in caches:
        function.cache_clear()


def the_cup_is_named(patch):
    scores = loop.level_scores("rig")
    patch.setattr(loop, "level_scores", lambda level: scores | {"named": scores["cup"]})


def labels_are_permuted(patch):
    results = naming.cdbn_sensitivity.load_results()
    permuted = {k: (filters, counts[..., [1, 0, 3, 2]]) for k, (filters, counts) in results.items()}
    wrong = {k: permuted[k] if k in naming.NETWORKS else results[k] for k in results}
    patch.setattr(naming.cdbn_sensitivity, "load_results", lambda: wrong)


def pixels_are_shuffled(patch):
    W = cdbn.CDBN.load().first.W
    mixed = np.random.default_rng(1).permuted(W.reshape(10, -1), axis=1).reshape(W.shape)
    network = SimpleNamespace(first=SimpleNamespace(W=mixed), projected_filters=lambda: mixed[:, 0])
    patch.setattr(naming.cdbn.CDBN, "load", lambda: network)


def cups_are_called_shuttlecocks(patch):
    real = cdbn.crops_of
    patch.setattr(naming.cdbn, "crops_of", lambda shots: (lambda c, s: (c, ~s))(*real(shots)))


def the_eye_looks_at_the_cup(patch):
    real = photos.load
    wrong = {"shuttlecock": "cup", "cup": "shuttlecock"}

    def swapped(level, split):
        return [
            replace(shot, boxes={wrong[k]: box for k, box in shot.boxes.items()})
            for shot in real(level, split)
        ]

    patch.setattr(planning.photos, "load", swapped)


def a_muscle_is_silent(patch):
    awake = np.ones(6)
    awake[1] = 0

    def load(spacing=0.06, real=planning.templates.load):
        whole_arm = real(spacing)
        return replace(whole_arm, reach=lambda u, p: whole_arm.reach(u * awake, p))

    patch.setattr(planning.templates, "load", load)
    patch.setattr(planning, "SEEDS", FEW)


def more_templates_are_not_remembered(patch):
    real = planning.templates.load
    patch.setattr(planning.templates, "load", lambda spacing=0.08: real(0.08))
    patch.setattr(planning, "SEEDS", FEW)


def a_plan_is_slow(patch):
    row = {"task": "habitual plan", "× faster than optimal control": 0.5}
    patch.setattr(planning.results, "records", lambda name: {"rows": [row]})


def weights_are_shuffled(patch):
    def shuffled(target, points):
        weights = planning.habitual_weights(target, points)
        return np.random.default_rng(0).permuted(weights, axis=-1)

    patch.setattr(planning, "exact_weights", shuffled)
    patch.setattr(planning, "errors_3d", lambda: {"exact / reach": np.full(6, 0.01)})
    patch.setattr(planning, "SEEDS", FEW)


def nothing_is_learned(patch):
    """Such a learner leaves the whole error."""
    results = calibration.load_results()
    ones = {k: {name: np.ones_like(x) for name, x in rows.items()} for k, rows in results.items()}
    patch.setattr(calibration, "load_results", lambda: ones)


def nothing_is_learned_online(patch):
    """Off-line calibration still does its share; what is learned for the next time is nothing."""
    results = calibration.load_results()
    ones = {
        k: {name: np.ones_like(x) if name.startswith("online") else x for name, x in rows.items()}
        for k, rows in results.items()
    }
    patch.setattr(calibration, "load_results", lambda: ones)


def the_error_points_away(patch):
    patch.setattr(calibration, "algorithm_1", partial(calibration.algorithm_1, sign=-1))
    patch.setattr(
        calibration, "repeat_over_seeds", partial(calibration.repeat_over_seeds, seeds=FEW)
    )


def torques_are_mixed_up(patch):
    past = second_plant.torque_templates()
    points = np.random.default_rng(0).permutation(past.points)
    patch.setattr(second_plant, "torque_templates", lambda: replace(past, points=points))
    patch.setattr(
        calibration, "repeat_over_seeds", partial(calibration.repeat_over_seeds, seeds=FEW)
    )


def classes_are_permuted(patch):
    real = KernelSVM.fit

    def permuted(x, y, *rest):
        return real(x, np.random.default_rng(0).permutation(y), *rest)

    patch.setattr(localisation.KernelSVM, "fit", permuted)
    rows = [localisation.measure_table_1("rig", "context", seed, ["linear"]) for seed in FEW]
    trainings = {split: np.array(rows)[:, k, 0] for k, split in enumerate(photos.SPLITS)}
    patch.setattr(localisation, "table_1", lambda level, split, name: {"linear": trainings[split]})


def boxes_are_random(patch):
    some, rng = photos.load("rig", "test"), np.random.default_rng(0)
    rows = []
    for _ in FEW:
        corners = rng.uniform(0, (400, 200), (len(some), 2, 2))
        boxes = np.concatenate([corners, corners + rng.uniform(40, 200, corners.shape)], axis=-1)
        rows.append(localisation.precision_recall(some, list(boxes)))
    patch.setattr(regions, "arrays", lambda name: {"rig/improved/seeds": np.array(rows)})


BREAKS = {
    "Fig. 1": the_cup_is_named,
    "Table III": labels_are_permuted,
    "III, width": labels_are_permuted,
    "Fig. 7": pixels_are_shuffled,
    "IV B, W²": cups_are_called_shuttlecocks,
    "Fig. 3": the_eye_looks_at_the_cup,
    "Fig. 9": a_muscle_is_silent,
    "III, Block 2": a_muscle_is_silent,
    "IV C, templates": more_templates_are_not_remembered,
    "IV C, computation": a_plan_is_slow,
    "Ours, Eq. 5": weights_are_shuffled,
    "Table V": nothing_is_learned,
    "Table VI": nothing_is_learned,
    "IV D, online": nothing_is_learned_online,
    "Fig. 4": the_error_points_away,
    "Fig. 10": the_error_points_away,
    "Fig. 11": the_error_points_away,
    "Fig. 12": nothing_is_learned,
    "V, robots": torques_are_mixed_up,
    "Ours, Table I": classes_are_permuted,
    "Ours, Table II": boxes_are_random,
    "Ours, Table V": nothing_is_learned,
    "Ours, Table VI": nothing_is_learned,
}


@pytest.mark.parametrize("where", HOLDS)
def test_verdict_changes_when_its_basis_is_broken(where, monkeypatch):
    BREAKS[where](monkeypatch)
    assert measure(ROWS[where])["verdict"] == DIFFERS
