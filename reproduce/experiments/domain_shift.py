"""Domain shift and label efficiency: how well crops are named in another world, by few labels.

Every number is a share named right: the mean of the share of shuttlecocks called so and the share
of other things, cups and windows of the scene, not called so. Chance is one half.
"""

from functools import partial

import numpy as np
from joblib import Parallel, delayed

from reproduce.peers.baseline_features import histograms_of_gradients
from reproduce.results import arrays
from reproduce.training.samples import boxes_by_kind
from vmc_lib import photos
from vmc_lib.what.cdbn import CDBN, K
from vmc_lib.what.crops import WIDTH, crop, whiten
from vmc_lib.what.recogniser import READ_OUTS, read_outs

NARROW = 48  # pixels of a crop: wider ones would take hours to learn from end to end
LEVELS, LABELS, EQUAL, DRAWS = photos.EVERY_LEVEL, (10, 40, 160, 640), 80, 6
EXAMS = "in-sample", *LEVELS
WAYS = "HOG", "without labels", "end to end"  # the last two of the CDBN
PATCHES, STEPS, BATCH = 20_000, 600, 16
INVERSE_PENALTIES, RATES = 10.0 ** np.arange(-4, 1), (0.002, 0.01)  # chosen on validation crops
ON_NARROW = {"width": 19, "rate": 0.03}  # of the second layer, whose maps are 20 wide


def make(
    folder=photos.FOLDER, labels=LABELS, equal=EQUAL, draws=DRAWS, patches=PATCHES, steps=STEPS
):
    """What `results/domains.npz` holds: draws of labelled crops, and who names how much right.

    "shift" (levels taught, the first two WAYS, draws, 1 + levels asked): `equal` labels of one
    level; "few" (labels, WAYS, draws, 1 + levels asked): so many of all levels together. Asked
    in-sample, then on the test crops of each level.
    """
    labelled = {
        split: [level_crops(level, split, folder) for level in LEVELS] for split in photos.SPLITS
    }
    network = train_narrow_cdbn(concatenate(labelled["train"])[0], patches)
    eyes = [hog_features, partial(cdbn_features, network)]
    looked = [
        {split: [(eye(x), y) for x, y in sets] for split, sets in labelled.items()} for eye in eyes
    ]
    fixed = [(evaluate_linear_readout, sets) for sets in looked]
    ways = [*fixed, (partial(evaluate_end_to_end, steps=steps), labelled)]

    def accuracies(learn_by, sets, count, taught=slice(None)):
        pairs = (concatenate(sets[split][taught]) for split in ("train", "validation"))
        return evaluate_over_draws(learn_by, *pairs, sets["test"], count, draws)

    each = [slice(i, i + 1) for i in range(len(LEVELS))]
    shift = [[accuracies(*way, equal, level) for way in fixed] for level in each]
    few = [[accuracies(*way, count) for way in ways] for count in labels]
    return {"shift": np.float32(shift), "few": np.float32(few)}


load_results = partial(arrays, "domains")


def concatenate(sets):
    """Concatenate pairs of arrays."""
    return tuple(np.concatenate(part) for part in zip(*sets, strict=True))


def level_crops(level, split, folder=photos.FOLDER):
    """Crops (n, 200, 200) and labels (n,) of all shuttlecocks and cups, and a window a photo."""
    rng, found = np.random.default_rng((LEVELS.index(level), photos.SPLITS.index(split))), []
    for photo in photos.load(level, split, folder):
        for kind, (image, boxes) in boxes_by_kind(photo, np.empty((0, 4)), rng).items():
            some = boxes[:1] if kind == "scene" else boxes
            found += [(crop(image, box), kind == "shuttlecock") for box in some]
    return tuple(map(np.array, zip(*found, strict=True)))


def downsample(pictures, width):
    """Downsample grey pictures (n, height, height) to (n, width, width) by area means."""
    size = pictures.shape[1]
    edges = np.arange(width) * size // width, -(-np.arange(1, width + 1) * size // width)
    areas = [slice(*ends) for ends in zip(*edges, strict=True)]
    rows = np.stack([pictures[:, area].mean(1) for area in areas], 1)
    return np.stack([rows[:, :, area].mean(2) for area in areas], 2)


def train_narrow_cdbn(crops, patches):
    """Train a CDBN of the paper's size without labels, on all crops."""
    from reproduce.training.cdbn import SECOND, train_cdbn  # with torch, slow to load

    pictures, every = whiten(downsample(crops, NARROW)), np.ones(len(crops), bool)
    network = train_cdbn(pictures, every, patches=patches, second=SECOND | ON_NARROW)
    return CDBN.from_arrays(network.arrays())


def hog_features(crops):
    """HOG features (n, d) of crops that have no more pixels than those for the networks."""
    import cv2

    small = downsample(crops, NARROW)
    enlarged = [cv2.resize(x, (WIDTH, WIDTH), interpolation=cv2.INTER_CUBIC) for x in small]
    return histograms_of_gradients(np.array(enlarged))


def cdbn_features(network, crops):
    """CDBN features of crops, (n, d)."""
    return read_outs(network, downsample(crops, NARROW))[READ_OUTS[-1]]


def evaluate_over_draws(learn_by, train, validation, exams, count, draws):
    """Balanced accuracies learnt from `count` labels, draw by draw: (draws, 1 + exams).

    learn_by: gives the choices that there are, (choices, 2 + exams), asked in-sample, on validation
    crops and on the `exams`; the choice that does best on validation over all draws is kept. Every
    set is a pair: what is seen of crops, and labels.
    """
    x, y = train

    def one(draw):
        rng = np.random.default_rng((count, draw))
        rows = draw_rows(y, count, rng)
        return learn_by((x[rows], y[rows]), validation, exams, rng)

    found = np.array(Parallel()(delayed(one)(draw) for draw in range(draws)))
    best = found[:, :, 1].mean(0).argmax()
    return np.delete(found[:, best], 1, axis=1)


def draw_rows(labels, count, rng):
    """`count` rows of labels (n,), or all of fewer, drawn until both kinds are among them."""
    while True:
        rows = rng.permutation(len(labels))[:count]
        if 0 < labels[rows].mean() < 1:
            return rows


def evaluate_linear_readout(taught, validation, exams, rng):
    """A linear read-out of fixed features: scores for each of the INVERSE_PENALTIES."""
    from sklearn.linear_model import LogisticRegression

    centre, size = taught[0].mean(0), taught[0].std(0) + 1e-3
    sets = [((x - centre) / size, y) for x, y in (taught, validation, *exams)]
    found = []
    for C in INVERSE_PENALTIES:
        linear = LogisticRegression(C=C, class_weight="balanced", max_iter=300).fit(*sets[0])
        found.append([balanced_accuracy(linear.predict(x), y) for x, y in sets])
    return found


def evaluate_end_to_end(taught, validation, exams, rng, steps=STEPS):
    """Features learned from the labels too: a choice for each rate and penalty."""
    from reproduce.training.end_to_end import train_end_to_end  # likewise

    crops, labels = downsample(taught[0], NARROW), taught[1]

    def draw(count):
        rows = rng.integers(len(crops), size=count)
        return crops[rows], labels[rows]

    found = []
    for rate in RATES:
        network = train_end_to_end(draw, rng, NARROW, (K, K), steps, BATCH, rate)
        sets = [(cdbn_features(network, x), y) for x, y in (taught, validation, *exams)]
        found += evaluate_linear_readout(sets[0], sets[1], sets[2:], rng)
    return found


def balanced_accuracy(called, labels):
    """Balanced accuracy: the mean of the recalls of shuttlecocks and of other things."""
    return (called[labels].mean() + (~called[~labels]).mean()) / 2
