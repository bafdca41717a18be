"""What is made wrong under the ledger's rows of seeing: the code, the truth or a stored reading.

And rivals, mechanisms that one might take for the paper's: what a row says of them is held, too.
"""

from dataclasses import replace
from functools import partial

import numpy as np

from reproduce.experiments import crbm_ablation, other_filters, random_filters, second_layers
from reproduce.ledger import filters, loop, naming, regions
from reproduce.ledger.entry import DIFFERS, NULL_PASSES
from reproduce.measures import slow_features
from reproduce.training import cdbn as training
from reproduce.training import shipped_models
from reproduce.training.name_classifier import fit_name_classifier
from vmc_lib import photos
from vmc_lib.what import cdbn
from vmc_lib.what.crbm import CRBM
from vmc_lib.where import detector
from vmc_lib.where.svm import KernelSVM

FEW = range(3)  # draws, to be quick


def sees_sixteen_photos(patch):
    """Sixteen photos meet the chain; of all is known which random filters name."""
    load, right = photos.load, loop.random_filters.right_by_network("rig")
    patch.setattr(loop.random_filters, "right_by_network", lambda level: right)
    patch.setattr(photos, "load", lambda *kind: load(*kind)[:16])


def names_the_cup(patch):
    """The recogniser's probability is that of the other thing."""
    real = loop.trials.see
    sees_sixteen_photos(patch)
    patch.setattr(
        loop.trials,
        "see",
        lambda *seen: (lambda s: replace(s, probability=1 - s.probability))(real(*seen)),
    )


def finds_half_the_photos(patch):
    load = photos.load
    patch.setattr(photos, "load", lambda *kind: load(*kind)[::2])


def lets_every_candidate_pass(patch):
    patch.setattr(KernelSVM, "score", lambda self, x: np.ones(len(x)))
    patch.setattr(detector, "nms", lambda boxes, *rest: np.arange(len(boxes)))


def calls_the_wrong_class(patch):
    real = naming.recognition.confusion_counts
    patch.setattr(
        naming.recognition, "confusion_counts", lambda p, truth: real(1 - np.asarray(p), truth)
    )


def answers_the_other_way(patch):
    """MP2's probability is that of the other thing."""
    real, ours = naming.recognition.load_probabilities, "CDBN, MP2"

    def load(*kind):
        probability, truth = real(*kind)
        return probability | {ours: 1 - probability[ours]}, truth

    patch.setattr(naming.recognition, "load_probabilities", load)


def pools_nothing(patch):
    def posterior(self, v, real=CRBM.posterior):
        h, _ = real(self, v)
        return h, h

    patch.setattr(CRBM, "posterior", posterior)


def learns_by_a_broken_recipe(patch, name):
    patch.setattr(
        filters, "first_layers", lambda: crbm_ablation.load_results()[name][-1:].astype(float)
    )


def learns_round_blobs(patch):
    rng, (y, x) = np.random.default_rng(0), np.mgrid[:8, :8]
    shapes = rng.uniform((2.5, 2.5, 1), (4.5, 4.5, 2), (10, 3))
    blobs = [np.exp(-((x - a) ** 2 + (y - b) ** 2) / 2 / c**2) for a, b, c in shapes]
    noisy = blobs + rng.normal(scale=0.03, size=(10, 8, 8))
    patch.setattr(filters, "first_layers", lambda: noisy[None])


def learns_one_direction(patch):
    one = filters.first_layers()[:, :1]
    patch.setattr(filters, "first_layers", lambda: np.repeat(one, 10, axis=1))


def has_a_layer(patch, layer, made):
    network = cdbn.CDBN.load()
    real = getattr(network, layer)
    W = made(real.W, np.random.default_rng(1)).astype(np.float32)
    wrong = replace(network, **{layer: CRBM(W, real.b, real.a, real.c)})
    patch.setattr(filters.cdbn.CDBN, "load", lambda: wrong)


def at_random(W, rng):
    return rng.normal(scale=W.std(), size=W.shape)


def mixes_the_lessons(patch):
    """Both second layers learn from the same crops, of the first who teaches."""
    real, maps = training.train_crbm, {}

    def train(p1, *rest, **how):
        return real(maps.setdefault("first", p1), *rest, **how)

    patch.setattr(training, "train_crbm", train)
    again = [second_layers.preferences(seed, patches=200, every=20) for seed in FEW]
    patch.setattr(second_layers, "load_results", lambda: {"preferences": np.array(again)})


def mixes_up_the_films(patch):
    """A film's views are of any things: nothing is contiguous."""
    few_films(patch)
    real = slow_features.films

    def mixed(split, rng, cdbn=None):
        features, kind = real(split, rng, cdbn)
        flat = features.reshape(-1, features.shape[-1])
        new = features if split == "test" else rng.permutation(flat).reshape(features.shape)
        return new, kind

    patch.setattr(slow_features, "films", mixed)


def heeds_what_changes_most(patch):
    few_films(patch)
    real = slow_features.slowest
    patch.setattr(slow_features, "slowest", lambda films: real(films)[:, ::-1])


def few_films(patch):
    patch.setattr(slow_features, "SHOTS", 20)


def lets_through_what_is_not_there(patch):
    """Every other box that the improved detector keeps holds nothing."""
    counts = regions.fresh_test_set.load_results()
    right, _, missed = counts["improved"]["rig"]
    counts["improved"]["rig"] = right, right, missed
    patch.setattr(regions.fresh_test_set, "load_results", lambda: counts)


# Rivals: not the paper's mechanism made wrong, but another that one might take for it


def has_first_filters(name):
    """The first layer's filters are of another origin, one of `other_filters.FIRST`."""

    def mutate(patch):
        patches = other_filters.whitened_patches(np.random.default_rng(0), count=4000)
        layer = np.reshape(other_filters.FIRST[name](patches, 0), (10, 8, 8))
        patch.setattr(filters, "first_layers", lambda: np.repeat(layer[None], 3, axis=0))
        network = cdbn.CDBN.load()
        other = replace(network, first=other_filters.with_scaled_filters(network.first, layer))
        patch.setattr(filters.cdbn.CDBN, "load", lambda: other)

    mutate.__name__ = f"has_first_filters_of_{name}"
    return mutate


def has_second_filters(name):
    """The second layer's are, one of `other_filters.SECOND`."""

    def mutate(patch):
        has_a_layer(patch, "second", other_filters.SECOND[name])

    mutate.__name__ = f"has_second_filters_{name}"
    return mutate


def names_by(method):
    """Other features under the same classifier are read in the place of the CDBN's MP2."""

    def mutate(patch):
        def counts(seed):
            probability, truth = naming.recognition.load_probabilities("rig", "fresh")
            return naming.recognition.confusion_counts(probability[method], truth)[:3]

        fresh = {("MP2", seed): {"rig": counts(seed)} for seed in range(3)}
        patch.setattr(naming.fresh_test_set, "load_results", lambda: fresh)

    mutate.__name__ = f"names_by_{method}"
    return mutate


def names_by_random_filters(patch):
    """The whole chain names by networks that nothing taught."""
    load, real = photos.load, loop.trials.VisuomotorModel.load
    crops, positive = cdbn.crops_of(load("rig", "train")[: random_filters.LESSONS])
    pictures, rng = filters.whiten(crops[positive]), np.random.default_rng(0)
    network = random_filters.random_network(cdbn.CDBN.load(), pictures, rng)
    (x, y), (checked, truth) = (
        shipped_models.readout_training_set(load("rig", split), rng, network)
        for split in ("train", "validation")
    )

    def taught(*level):
        model = real(*level)
        name = model.recogniser.name
        linear = fit_name_classifier(x[name], y, checked[name], truth)
        other = replace(model.recogniser, cdbn=network, classifier=linear)
        return replace(model, recogniser=other)

    sees_sixteen_photos(patch)
    patch.setattr(loop.trials.VisuomotorModel, "load", taught)


def corrects_no_box(patch):
    """A detector that searches and judges alike and corrects no box."""
    counts = regions.fresh_test_set.load_results()
    counts["improved"] = counts[regions.fresh_test_set.UNCORRECTED]
    patch.setattr(regions.fresh_test_set, "load_results", lambda: counts)


def heeds_what_varies_most(patch):
    """Principal components in the place of slow features."""
    patch.setattr(slow_features, "slowest", slow_features.most_varying)


SEEING_RIVALS = {  # what a row says of each
    "Ours, Fig. 1": {names_by_random_filters: NULL_PASSES},
    "Ours, Table II": {corrects_no_box: NULL_PASSES},
    "Table III": {names_by("raw pixels"): NULL_PASSES, names_by("HOG"): NULL_PASSES},
    "Fig. 7": {has_first_filters(name): DIFFERS for name in other_filters.FIRST},
    "Fig. 8": {
        has_first_filters("independent components"): NULL_PASSES,
        has_first_filters("k-means"): NULL_PASSES,
    },
    "IV B, W²": {
        has_second_filters("smoothed noise"): DIFFERS,
        has_second_filters("maps permuted"): NULL_PASSES,
        has_second_filters("mirrored"): NULL_PASSES,
    },
    "Ours, time": {heeds_what_varies_most: DIFFERS},
}
SEEING = {
    "Ours, Fig. 1": [names_the_cup],
    "Ours, Table II": [lets_through_what_is_not_there],
    "Fig. 5": [finds_half_the_photos],
    "Fig. 6": [lets_every_candidate_pass],
    "III, Block 1-1": [lets_every_candidate_pass],
    "Table III": [calls_the_wrong_class],
    "IV B, features": [answers_the_other_way],
    "Fig. 2": [pools_nothing],
    "Fig. 7": [
        *(
            partial(learns_by_a_broken_recipe, name=name)
            for name in crbm_ablation.CHANGES
            if name != "all three"
        ),
        learns_round_blobs,
        learns_one_direction,
    ],
    "Fig. 8": [
        partial(has_a_layer, layer="first", made=made) for made in (filters.shuffle, at_random)
    ],
    "IV B, W²": [mixes_the_lessons],
    "Ours, time": [mixes_up_the_films, heeds_what_changes_most],
}
