"""The ledger's rows on choosing regions: Tables I and II, and what we do better."""

import numpy as np

from reproduce import paper
from reproduce.experiments import fresh_test_set, localisation
from reproduce.ledger.entry import Row, mean_of_draws, mean_of_trainings, share
from reproduce.ledger.search import rois
from reproduce.results import arrays
from reproduce.training.detectors import candidates
from vmc_lib import photos
from vmc_lib.boxes import MIN_IOU, area, iou

KERNELS = {"linear": "linear", "RBF": "rbf", "polynomial": "poly", "Gaussian": "sigmoid"}
MEASURES = ("precision", "recall")
EXACT = {"better": 1, "rounding": paper.SHARE}


def _table_1():
    """Precision and recall of each kernel's classifier, over its trainings."""
    held_out, in_sample = (
        localisation.table_1("rig", split, "published") for split in ("test", "train")
    )
    wanted, of = rois("test")[0].sum(), paper.TEST_ROIS["positive"]
    quantities = []
    for name, kernel in KERNELS.items():
        rows, learnt = held_out[kernel], in_sample[kernel].mean(axis=0)
        quantities += _trained(name, paper.TABLE_1[name], rows, learnt, wanted, of)
    return quantities


def _trained(name, claimed, rows, in_sample, wanted, of):
    """Of rows (trainings, 2) measured where so many regions or objects were wanted."""
    precision, recall = rows.mean(axis=0)
    called = recall * wanted / precision if precision else 0
    return [
        mean_of_trainings(
            f"{name}: {measure}",
            claimed and claimed[k],
            rows[:, k],
            (called, wanted)[k],
            of=of,
            in_sample=in_sample[k],
            **EXACT,
        )
        for k, measure in enumerate(MEASURES)
    ]


def _fresh(name, question, claimed, in_sample, of):
    """What a question put to the fresh photos of the rig says."""
    right, wrong, missed = fresh_test_set.load_counts()[question]["rig"]
    return [
        share(f"{name}: {measure}", claimed[k], right, n, of, in_sample=in_sample[k], **EXACT)
        for k, (measure, n) in enumerate(
            zip(MEASURES, (right + wrong, right + missed), strict=True)
        )
    ]


def _kernels():
    rows = localisation.table_1("rig", "test", "published")
    gaps = rows["rbf"] - rows["linear"]
    return [
        mean_of_draws(f"{measure}, RBF less linear", 0, gaps[:, k], (-1, 1), better=-1)
        for k, measure in enumerate(MEASURES)
    ]


def _finder(name, claimed):
    """A detector on the test photos that ship, over its trainings."""
    rows = arrays("localisation")[f"rig/{name}/seeds"]
    in_sample = localisation.table_2("rig", "train")[name]
    objects = sum(len(photo.boxes) for photo in photos.load("rig", "test"))
    return _trained(f"{name}, IoU", claimed, rows, in_sample, objects, paper.OBJECTS)


def _own_table_1():
    in_sample = localisation.table_1("rig", "train", "context")["linear"].mean(axis=0)
    of = paper.TEST_ROIS["positive"]
    return _fresh("linear, fresh photos", "linear", paper.TABLE_1["linear"], in_sample, of)


def _own_table_2():
    in_sample = localisation.table_2("rig", "train")["improved"]
    name = "improved, IoU, fresh photos"
    return [
        *_fresh(name, "improved", paper.TABLE_2, in_sample, paper.OBJECTS),
        *_finder("improved", None),
    ]


def coverage(boxes, truth):
    """The share of each true box (m, 4) that each box (n, 4) covers, (n, m)."""
    sides = np.minimum(boxes[:, None, 2:], truth[:, 2:]) - np.maximum(
        boxes[:, None, :2], truth[:, :2]
    )
    return sides.clip(0).prod(axis=-1) / area(truth)


def _table_2():
    some = photos.load("rig", "test")
    kept = [arrays("localisation")[f"{photo.name}/published"].astype(float) for photo in some]
    truth = [np.array(list(photo.boxes.values())) for photo in some]
    ceiling = [iou(candidates(p), t).max(axis=0) for p, t in zip(some, truth, strict=True)]
    properest = [
        candidates(p)[iou(candidates(p), t).argmax(axis=0)]
        for p, t in zip(some, truth, strict=True)
    ]
    readings = {
        "coverage of the truth": [coverage(*pair) for pair in zip(kept, truth, strict=True)],
        "the best candidate as truth": [iou(*pair) for pair in zip(kept, properest, strict=True)],
    }
    quantities = _finder("published", paper.TABLE_2)
    for reading, overlaps in readings.items():
        for k, measure in enumerate(MEASURES):
            right = np.concatenate([(o >= MIN_IOU).any(axis=1 - k) for o in overlaps])
            quantities.append(
                share(
                    f"published, {reading}: {measure}",
                    paper.TABLE_2[k],
                    right.sum(),
                    len(right),
                    paper.OBJECTS,
                    **EXACT,
                )
            )
    found = np.concatenate(ceiling) >= MIN_IOU
    limit = "recall that the candidates allow"
    return [
        *quantities,
        share(limit, paper.TABLE_2[1], found.sum(), len(found), paper.OBJECTS, **EXACT),
    ]


ROWS = (
    Row(
        "Table I",
        "The RoI classifier tells regions well.",
        "03_regions",
        _table_1,
        differs="In-sample the linear kernel finds {q[linear: recall].in_sample:.2f}; but our rig "
        "turns cup and shuttlecock to every pose, and those of forty photos do not cover the "
        "others'. A margin, the box's size, and shaken and mirrored examples (context) help: see "
        "*Ours, Table I*.",
        note="C and γ of each kernel were chosen on the rig's validation photos, from one grid; "
        "that crops have 16 × 16 pixels, from -1 to 1, is ours. “Gaussian” beside “RBF” is "
        "unclear; we read it as the fourth kernel of LibSVM, the sigmoid. On the forty test photos "
        "that ship.",
    ),
    Row(
        "IV A, kernels",
        "The linear kernel does as well as RBF.",
        "03_regions",
        _kernels,
        differs="With settings chosen alike, the linear kernel is behind RBF by "
        "{q[precision, RBF less linear].obtained:.2f} in precision and "
        "{q[recall, RBF less linear].obtained:.2f} in recall.",
    ),
    Row(
        "Table II",
        "Search, classifier and suppression localise both objects.",
        "03_regions",
        _table_2,
        differs="“Overlapped region” may be the intersection over the union, or the share of the "
        "truth that is covered; the “properest box” may be the true one, or the best candidate. No "
        "reading reaches the claim. Our candidates, made by the paper's words, allow a recall of "
        "{q[recall that the candidates allow].obtained:.2f} at most. And the classifier never "
        "learns from boxes that overlap an object by 0.5 to 0.8: diverse grouping gives many of "
        "those, and suppression often keeps one. See *Ours, Table II*.",
    ),
    Row(
        "Ours, Table I",
        "With context, the linear kernel does as well as the paper's.",
        "03_regions",
        _own_table_1,
        differs="Its recall does; its precision is "
        "{q[linear, fresh photos: precision].obtained:.3f}, not 1.",
        note="On a hundred fresh photos that had no part in any choice.",
    ),
    Row(
        "Ours, Table II",
        "Corrected boxes and a judge of near misses localise both objects.",
        "03_regions",
        _own_table_2,
        differs="Its recall does, and better; of all boxes that it keeps, "
        "{q[improved, IoU, fresh photos: precision].obtained:.4f} are right, not all.",
        note="Two hundred fresh photos decide; beside them stands the mean of six trainings on the "
        "forty that ship.",
    ),
)
