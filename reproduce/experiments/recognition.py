"""Table III, recognition: CDBN read-outs and rival features under one classifier.

The classifiers, and what they say of every photo, are stored, as `make` finds them.
"""

from itertools import product

import numpy as np

from reproduce import paper
from reproduce.peers.baseline_features import (
    bag_of_sift,
    grey_pixels,
    histograms_of_gradients,
    sift,
)
from reproduce.results import arrays
from reproduce.training.name_classifier import fit_name_classifier, labelled_crops
from vmc_lib import photos
from vmc_lib.statistics import holm, mcnemar, wilson
from vmc_lib.what.cdbn import CDBN, crops_of
from vmc_lib.what.crops import crop
from vmc_lib.what.recogniser import POOLED_LEVEL, READ_OUTS, NameClassifier, Recogniser, read_outs

WORDS = 100
IDLE = 0.001  # standard deviation below which an answer hardly varies
MEASURES = ("named right", "precision", "recall")

METHODS = (
    "CDBN, MP2",
    "CDBN, P2",
    "CDBN, P1 + P2",
    "HMAX, 10 prototypes",
    "HMAX, 250 prototypes",
    "HOG",
    "SIFT, bag of words",
    "raw pixels",
)

# What the paper printed of two of them: measure -> method -> share
PUBLISHED = {
    measure: {
        ours: paper.TABLE_3[theirs][column]
        for ours, theirs in {"CDBN, MP2": "CDBN", "HMAX, 10 prototypes": "HMAX"}.items()
    }
    for column, measure in enumerate(MEASURES[1:])
}


def features(crops, learnt):
    """Every method's features (n, d) of crops (n, 200, 200), given what was learnt before."""
    from reproduce.peers.hmax import hmax  # here, for torch weighs on who only reads the results

    readouts, matches = read_outs(learnt["cdbn"], crops), hmax(crops, learnt["prototypes"])
    by_hand = [histograms_of_gradients(crops), bag_of_sift(crops, learnt["words"])]
    found = [*readouts.values(), matches[:, :10], matches, *by_hand, grey_pixels(crops)]
    return dict(zip(METHODS, found, strict=True))


def confusion_counts(probability, shuttlecock, threshold=0.5):
    """Counts (true positives, false positives, false negatives, true negatives)."""
    called = np.asarray(probability) > threshold
    pairs = [(True, True), (True, False), (False, True), (False, False)]
    return tuple(int(((called == c) & (shuttlecock == s)).sum()) for c, s in pairs)


def rates_of_counts(counts):
    """Precision and recall of `confusion_counts`; NaN where a denominator is 0."""
    right, wrong, missed, *_ = counts
    return tuple(right / n if n else np.nan for n in (right + wrong, right + missed))


def rates_of_answers(probability, shuttlecock):
    """Precision and recall of probabilities (n,), or of what is called a shuttlecock, (n,)."""
    return rates_of_counts(confusion_counts(probability, shuttlecock))


def share_interval(count, of):
    """A share and its 95 % interval (Wilson): (share, low, high), NaN of none."""
    return (count / of, *wilson(count, of)) if of else 3 * (np.nan,)


def table_3(level):
    """Table III on a level: measure -> split -> method -> (share, low, high), Wilson's 95 %.

    NaN where nothing is called a shuttlecock, and a precision has no denominator.
    """
    rows = {measure: {"held-out": {}, "in-sample": {}} for measure in MEASURES}
    for label, split in (("held-out", "test"), ("in-sample", "train")):
        probability, truth = load_probabilities(level, split)
        for method in METHODS:
            right, wrong, missed, rest = confusion_counts(probability[method], truth)
            counts = (right + rest, len(truth)), (right, right + wrong), (right, right + missed)
            for measure, (k, n) in zip(MEASURES, counts, strict=True):
                rows[measure][label][method] = share_interval(k, n)
    return rows


def load_classifiers():
    """What was learnt: what `features` needs, and a NameClassifier for each (level, method)."""
    kept = arrays("recognition")
    learnt = {"cdbn": CDBN.load()} | {name: kept[name] for name in ("words", "prototypes")}
    keys = product(photos.LEVELS, METHODS)
    return learnt, {key: NameClassifier.from_arrays(kept, "/".join(key)) for key in keys}


def probabilities(level, shots, learnt, linear):
    """Each method's probabilities (n,) for the true boxes in photos of a level, and the labels."""
    crops, shuttlecock = crops_of(shots)
    found = features(crops, learnt)
    return {m: linear[level, m].probability(found[m]) for m in METHODS}, shuttlecock


def load_probabilities(level, split):
    """What `probabilities` found when the file was made: finding it takes a while.

    The split "fresh" is of the test photos that were rendered when all was settled.
    """
    kept = arrays("fresh_names" if split == "fresh" else "recognition")
    return {m: kept[f"{level}/{m}/{split}"] for m in METHODS}, kept[f"{level}/{split}"]


def correct_by_method(split):
    """Which true boxes of all levels each method names right: (n,) by method."""
    found = [load_probabilities(level, split) for level in photos.LEVELS]
    return {
        m: np.hstack([(probability[m] > 0.5) == truth for probability, truth in found])
        for m in METHODS
    }


def mcnemar_tests(right, methods):
    """McNemar's tests of some methods against every other, of `correct_by_method`.

    Rows (one, other, only one right, only other right, p, p corrected by Holm).
    """
    pairs = [(a, b) for i, a in enumerate(methods) for b in right if b not in methods[: i + 1]]
    duels = [mcnemar(right[one], right[other]) for one, other in pairs]
    corrected = holm([p for *_, p in duels]).tolist()
    return [(*pair, *duel, p) for pair, duel, p in zip(pairs, duels, corrected, strict=True)]


def fresh_duels():
    """`mcnemar_tests` of the paper's read-out and the best one on the fresh crops of all levels.

    One family of tests: a difference has one p, wherever it is shown.
    """
    return mcnemar_tests(correct_by_method("fresh"), ("CDBN, MP2", "CDBN, P1 + P2"))


def accuracy_across_levels(learnt, classifiers):
    """Named right on one level by CDBN read-outs taught on another, of `load_classifiers`.

    Level taught -> read-out -> level tested -> (share, low, high), Wilson's 95 %.
    """
    rows = {level: {name: {} for name in READ_OUTS} for level in photos.LEVELS}
    for tested in photos.LEVELS:
        crops, truth = crops_of(photos.load(tested, "test"))
        x = read_outs(learnt["cdbn"], crops)
        for taught, name in product(photos.LEVELS, READ_OUTS):
            chances = classifiers[taught, f"CDBN, {name}"].probability(x[name])
            right = int(((chances > 0.5) == truth).sum())
            rows[taught][name][tested] = share_interval(right, len(truth))
    return rows


def everyday_probabilities(shots):
    """Probabilities of all objects: (level taught, read-out) -> a photo's name -> (n,)."""
    boxes = {name: (shot.image, shot.boxes.values()) for name, shot in shots.items()}
    crops = {name: [crop(image, box) for box in some] for name, (image, some) in boxes.items()}
    cdbn, pairs = CDBN.load(), product((*photos.LEVELS, POOLED_LEVEL), READ_OUTS)
    features = {name: read_outs(cdbn, inside) for name, inside in crops.items()}
    classifiers = {pair: Recogniser.load(*pair).classifier for pair in pairs}
    return {
        (level, read_out): {name: one.probability(x[read_out]) for name, x in features.items()}
        for (level, read_out), one in classifiers.items()
    }


def prototypes_that_vary(learnt, n=10):
    """Which of the first `n` HMAX prototypes answer to crops of the rig differently (n,).

    And the strength (n,) of each: the sum of its squares.
    """
    from reproduce.peers.hmax import hmax  # as `features` does

    crops, _ = crops_of(photos.load("rig", "train")[:10])
    some = learnt["prototypes"][:n]
    return hmax(crops, some).std(0) >= IDLE, (some**2).sum((1, 2, 3))


def make(folder=photos.FOLDER, prototypes=250):
    """What `results/recognition.npz` holds: all that is learnt from the photos in `folder`.

    And what it says of each: a probability for every true box of every split.
    """
    rng = np.random.default_rng(0)
    learnt = learn_unsupervised(folder, prototypes, rng)
    kept = {name: np.asarray(x) for name, x in learnt.items()}
    learnt["cdbn"] = CDBN.load()
    for level in photos.LEVELS:
        crops, y = labelled_crops(photos.load(level, "train", folder), rng)
        x = features(crops, learnt)
        exams = {split: crops_of(photos.load(level, split, folder)) for split in photos.SPLITS}
        by_split = {split: features(crops, learnt) for split, (crops, _) in exams.items()}
        kept |= {f"{level}/{split}": truth for split, (_, truth) in exams.items()}
        for method in METHODS:
            linear = fit_name_classifier(
                x[method], y, by_split["validation"][method], exams["validation"][1]
            )
            kept |= linear.arrays(f"{level}/{method}")
            for split in photos.SPLITS:
                kept[f"{level}/{method}/{split}"] = linear.probability(by_split[split][method])
    return kept


def learn_unsupervised(folder, prototypes, rng):
    """HMAX's prototypes and SIFT's words, from training crops of all levels, labels unused."""
    from sklearn.cluster import KMeans

    from reproduce.peers.hmax import draw_prototypes

    crops, _ = crops_of(photos.load_levels("train", folder))
    some = crops[rng.permutation(len(crops))[:60]]
    descriptors = np.concatenate([sift(crop) for crop in some])
    words = KMeans(WORDS, n_init=1, random_state=0).fit(descriptors).cluster_centers_
    return {"prototypes": draw_prototypes(some, prototypes, rng), "words": np.float32(words)}
