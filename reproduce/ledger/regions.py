"""The ledger's rows on choosing regions: Tables I and II, and what we do better."""

from reproduce import paper
from reproduce.experiments import fresh_test_set, localisation, recognition, region_clusters
from reproduce.ledger.entry import Row, mean, mean_of_trainings, share
from reproduce.results import arrays
from vmc_lib import photos

KERNELS = {"linear": "linear", "RBF": "rbf", "polynomial": "poly", "Gaussian": "sigmoid"}
GUESSED = "Gaussian"  # which is another name for RBF: we do not know what the paper trained
MEASURES = ("precision", "recall")
SECOND_HUNDRED = "On a hundred fresh photos that had no part in any choice."
CLUSTERED = (
    " Several regions lie on one object, and are often right or wrong together: intervals take "
    "them for fewer, by their design effect on the photos that ship."
)
EXACT = {"better": 1, "rounding": paper.SHARE}


def _table_1():
    """Precision and recall of each kernel's classifier, over its trainings."""
    held_out, in_sample = (
        fresh_test_set.table_1(),
        localisation.table_1("rig", "train", "published"),
    )
    right, _, missed = fresh_test_set.load_results()["linear", 0]["rig"]
    wanted, of = right + missed, paper.TEST_ROIS["positive"]
    clusters, quantities = region_clusters.load_results()["rig"], []
    for name, kernel in KERNELS.items():
        rows, learnt = held_out[kernel], in_sample[kernel].mean(axis=0)
        how = {"unit": "regions", "effects": clusters["published"][kernel]}
        claimed = None if name == GUESSED else paper.TABLE_1[name]
        quantities += _trained(name, claimed, rows, learnt, wanted, of, **how)
    return quantities


def _trained(name, claimed, rows, in_sample, wanted, of, unit="objects", effects=(1, 1)):
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
            unit=unit,
            effect=effects[k],
            in_sample=in_sample[k],
            **EXACT,
        )
        for k, measure in enumerate(MEASURES)
    ]


def _fresh(name, question, claimed, in_sample, of, nulls, unit="objects", effects=(1, 1)):
    """What a question put to the fresh photos of the rig says, beside `nulls`: name -> (2,)."""
    right, wrong, missed = fresh_test_set.load_results()[question]["rig"]
    return [
        share(
            f"{name}: {measure}",
            claimed[k],
            right,
            n,
            of,
            unit,
            effects[k],
            in_sample=in_sample[k],
            nulls={null: rates[k] for null, rates in nulls.items()},
            **EXACT,
        )
        for k, (measure, n) in enumerate(
            zip(MEASURES, (right + wrong, right + missed), strict=True)
        )
    ]


def _kernels():
    rows = fresh_test_set.table_1()
    gaps = rows["rbf"] - rows["linear"]
    return [
        mean(f"{measure}, RBF less linear", 0, gaps[:, k], "trainings", of=1, better=-1)
        for k, measure in enumerate(MEASURES)
    ]


def _own_table_1():
    in_sample = localisation.table_1("rig", "train", "context")["linear"].mean(axis=0)
    how = {"unit": "regions", "effects": region_clusters.load_results()["rig"]["context"]["linear"]}
    return _fresh(
        "linear, fresh photos",
        "linear",
        paper.TABLE_1["linear"],
        in_sample,
        paper.TEST_ROIS["positive"],
        {"without context": fresh_test_set.table_1()["linear"].mean(axis=0)},
        **how,
    )


def _own_table_2():
    in_sample = localisation.table_2("rig", "train")["improved"]
    name, rows = "improved, IoU", arrays("localisation")["rig/improved/seeds"]
    objects = sum(len(photo.boxes) for photo in photos.load("rig", "test"))
    uncorrected = fresh_test_set.load_results()[fresh_test_set.UNCORRECTED]["rig"]
    nulls = {"boxes not corrected": recognition.rates_of_counts(uncorrected)}
    exam = paper.TABLE_2, in_sample, paper.OBJECTS, nulls
    return [
        *_fresh(f"{name}, fresh photos", "improved", *exam),
        *_trained(name, None, rows, in_sample, objects, paper.OBJECTS),
    ]


def _table_2():
    """What the published recipe localises, by each reading, over its trainings."""
    right, _, missed = fresh_test_set.load_results()[fresh_test_set.CEILING]["rig"]
    objects, quantities = right + missed, []
    learnt = {"IoU": localisation.table_2("rig", "train")["published"]}
    for reading in fresh_test_set.READINGS:
        rows, in_sample = fresh_test_set.rates_by_seed(reading), learnt.get(reading, (None, None))
        how = paper.TABLE_2, rows, in_sample, objects, paper.OBJECTS
        quantities += _trained(f"published, {reading}", *how)
    limit = "recall that the candidates allow"
    return [*quantities, share(limit, None, right, objects, unit="objects")]


ROWS = (
    Row(
        "Table I",
        "The RoI classifier tells regions well.",
        "03_regions",
        _table_1,
        differs="In-sample the linear kernel finds {q[linear: recall].in_sample:.2f}; but our rig "
        "turns cup and shuttlecock to every pose, and most likely those of forty photos do not "
        "cover the others'. A margin, the box's size, and shaken and mirrored examples (context) "
        "help: see *Ours, Table I*.",
        note="C and γ of each kernel were chosen on the rig's validation photos, from one grid; "
        "that crops have 16 × 16 pixels, from -1 to 1, is ours. “Gaussian” and “RBF” name one "
        "kernel: for “Gaussian” we trained the fourth of LibSVM, the sigmoid, and compare nothing. "
        + SECOND_HUNDRED
        + CLUSTERED,
    ),
    Row(
        "IV A, kernels",
        "The linear kernel does as well as RBF.",
        "03_regions",
        _kernels,
        differs="With settings chosen alike, the linear kernel is behind RBF by "
        "{q[precision, RBF less linear].obtained:.2f} in precision and "
        "{q[recall, RBF less linear].obtained:.2f} in recall.",
        note=SECOND_HUNDRED + " The intervals are those of other trainings on the same photos; "
        "for other photos see *Table I*, where the intervals of the two kernels lie apart.",
    ),
    Row(
        "Table II",
        "Search, classifier and suppression localise both objects.",
        "03_regions",
        _table_2,
        differs="“Overlapped region” may be the intersection over the union, or the share of the "
        "truth that is covered; the “properest box” may be the true one, or the best candidate. "
        "None of our three readings reaches the claim. Our candidates would allow a recall of "
        "{q[recall that the candidates allow].obtained:.2f}, about the paper's. But the classifier "
        "never learns from boxes that overlap an object by 0.5 to 0.8: diverse grouping gives many "
        "of those, and suppression often keeps one. See *Ours, Table II*.",
        note="Two hundred fresh photos; means over six trainings.",
    ),
    Row(
        "Ours, Table I",
        "With context, the linear kernel does as well as the paper's.",
        "03_regions",
        _own_table_1,
        differs="Its recall does; its precision is "
        "{q[linear, fresh photos: precision].obtained:.3f}, not 1.",
        note=SECOND_HUNDRED
        + " The counts are means over trainings, whose scatter is not in the intervals."
        + CLUSTERED,
    ),
    Row(
        "Ours, Table II",
        "Corrected boxes and a judge of near misses localise both objects.",
        "03_regions",
        _own_table_2,
        note="Two hundred fresh photos decide; beside them stands the mean of six trainings on the "
        "forty that ship. Of all boxes that it keeps, "
        "{q[improved, IoU, fresh photos: precision].obtained:.4f} are right; the paper, which "
        "counted no error among about 79, would often see none with ours either. Precision says "
        "little: the same candidates, judged alike and not corrected, have nearly as much. It is "
        "recall that correction brings.",
    ),
)
