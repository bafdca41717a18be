"""The ledger's rows on what the network learns: Figs. 2, 7 and 8, and the text on them."""

from dataclasses import replace
from functools import cache

import numpy as np

from reproduce import paper
from reproduce.experiments import cdbn_sensitivity, other_filters, second_layers
from reproduce.ledger.entry import (
    ABOVE,
    BELOW,
    Quantity,
    Row,
    mean,
    trivial_quantity,
    wider_of,
)
from reproduce.measures import edges, gabor, texture_tuning
from reproduce.measures.texture_tuning import shuffle
from vmc_lib import photos
from vmc_lib.statistics import t_interval
from vmc_lib.what import cdbn
from vmc_lib.what.crops import whiten

# Of macaque cells, full widths at half height: the median (De Valois, Yund & Hepler 1982,
# abstract), and means of two samples (Foster et al. 1985)
MACAQUE, OCTAVES = 40, (1.4, 1.8)  # degrees; octaves
EMPTY = np.zeros((1, 1, paper.CROP_WIDTH, paper.CROP_WIDTH), np.float32)  # whitened
NETWORKS = [variation for variation in cdbn_sensitivity.VARIATIONS if variation[0] == cdbn.N_W]


def _figure_2():
    layers = layer_maps()
    width = {name: maps.shape[-1] for name, maps in layers.items()}
    return [
        trivial_quantity("maps K of each CRBM", paper.MAPS, layers["P1"].shape[1]),
        trivial_quantity("width of H1 over P1", paper.POOL, width["H1"] / width["P1"]),
        trivial_quantity("width of H2 over P2", paper.POOL, width["H2"] / width["P2"]),
        trivial_quantity("maps of MP2 (Eq. 2)", 1, layers["MP2"].shape[1]),
    ]


def first_layers():
    """The first layer's filters of every training with the paper's width, (trainings, K, 8, 8)."""
    found = cdbn_sensitivity.load_results()
    return np.array([found[k][0] for k in NETWORKS], float)


def _figure_7():
    layers, network = first_layers(), cdbn.CDBN.load()
    *by_filter, longest = edges.edge_numbers(layers)
    names = (
        "fit of a Gabor, less that of the best round blob",
        "selectivity for direction, less that of its pixels shuffled",
        "share of strength in the middle quarter",
    )
    return [
        *(
            _by_filter(name, limit, values, len(layers), first_layer_nulls(k))
            for k, (name, limit, values) in enumerate(
                zip(names, (0, 0, 0.25), by_filter, strict=True)
            )
        ),
        Quantity(
            "mean vector of ten preferred directions, the longest of any training",
            edges.RAYLEIGH,
            longest,
            fitted=True,
            nulls=first_layer_nulls(3),
            sample=f"{len(layers)} trainings",
            **BELOW,
        ),
        trivial_quantity(
            "width of a first-layer filter", paper.FILTER_WIDTH, network.first.W.shape[-1]
        ),
        trivial_quantity(
            "the same in the second layer, in the image",
            paper.PROJECTED_WIDTH,
            network.projected_filters().shape[-1],
        ),
    ]


def _by_filter(name, limit, values, trainings, nulls):
    """A mean over filters (n,), whose interval is the wider of two: over them, over trainings."""
    unit, middle = f"filters of {trainings} trainings", values.reshape(trainings, -1).mean(axis=1)
    q = mean(name, limit, values, unit, nulls=nulls, fitted=True, **ABOVE)
    if trainings < 2:
        return q
    centre, half = t_interval(middle)
    return wider_of(q, (centre - half, centre + half))


def first_layer_nulls(k):
    """The k-th number of filters that no CRBM learnt, by their name."""
    return {name: numbers[k] for name, numbers in other_filters.load_results()["first"].items()}


def _v1():
    layers, (least, most) = first_layers(), OCTAVES
    octaves, direction, ends = _bandwidths(cdbn.CDBN.load().first.W[:, 0])
    all_octaves, all_directions, all_ends = _bandwidths(layers.reshape(-1, *layers.shape[-2:]))
    trainings = f"filters of {len(layers)} trainings"
    return [
        Quantity(
            "median bandwidth of direction (°), the paper's claim being the macaque's",
            MACAQUE,
            direction,
            **ends,
            rounding=5,
            sample=f"{len(octaves)} filters",
            nulls=first_layer_nulls(7),
        ),
        mean(
            f"mean bandwidth in octaves, the macaque's being {least} to {most}",
            (least + most) / 2,
            octaves,
            "filters",
            rounding=(most - least) / 2,
            nulls=first_layer_nulls(6),
        ),
        Quantity(
            "median bandwidth of direction (°), all trainings",
            None,
            all_directions,
            **all_ends,
            sample=f"{len(all_octaves)} {trainings}",
        ),
        mean("mean bandwidth in octaves, all trainings", None, all_octaves, trainings),
    ]


def _bandwidths(filters):
    """Bandwidths of filters (n, n_w, n_w): octaves (n,); the median of direction, its interval."""
    from scipy.stats import quantile_test

    octaves, directions = np.transpose([gabor.bandwidths(W) for W in filters])
    found = quantile_test(directions).confidence_interval()
    return octaves, np.median(directions), {"low": found.low, "high": found.high}


def _figure_8():
    less, layers = paper.FILTER_WIDTH - 1, layer_maps()
    p1 = (paper.CROP_WIDTH - less) // paper.POOL
    p2 = (p1 - less) // paper.POOL
    return [
        *_tuned_more(),
        *(
            trivial_quantity(f"width of {name}", claimed, layers[name].shape[-1])
            for name, claimed in (("P1", p1), ("P2", p2), ("MP2", p2))
        ),
    ]


def _tuned_more():
    """How much better ours are tuned than shuffled filters; the interval is for one more order."""
    crops, shuttlecock = cdbn.crops_of(photos.load("rig", "validation"))
    gained = texture_tuning.over_shuffled(cdbn.CDBN.load().first, whiten(crops[shuttlecock]))
    name, quantities = "{}: cosine with the direction under it, less others', less shuffled", []
    for k, (layer, gaps) in enumerate(zip(("H1", "P1"), gained, strict=True), start=4):
        q = mean(name.format(layer), 0, gaps, "orders", of=1, nulls=first_layer_nulls(k), **ABOVE)
        quantities.append(replace(q, low=q.least, high=q.most, least=None, most=None))
    return quantities


@cache
def layer_maps():
    """The maps of one crop, by layer."""
    crops, _ = cdbn.crops_of(photos.load("rig", "validation")[:1])
    return cdbn.CDBN.load().layers(whiten(crops[:1]))


def _deeper():
    return _gabor_fits() + _preferences()


def _gabor_fits():
    """How well Gabors fit the second layer's filters, less the first's, and less shuffled ones."""
    from scipy.stats import ttest_ind

    fits = {kind: gabor_correlations(kind) for kind in ("W1", "W2", "W2 shuffled")}
    simpler = ttest_ind(fits["W2"], fits["W1"], equal_var=False).confidence_interval()
    others = other_filters.load_results()["second"]
    return [
        Quantity(
            "fit of a Gabor, second layer less first",
            0,
            fits["W2"].mean() - fits["W1"].mean(),
            low=simpler.low,
            high=simpler.high,
            sample=f"{len(fits['W2'])} filters each",
            nulls={name: fit - fits["W1"].mean() for name, fit in others.items()},
            **BELOW,
        ),
        mean(
            "fit of a Gabor, second layer less its weights shuffled",
            0,
            fits["W2"] - fits["W2 shuffled"],
            "filters",
            nulls={name: fit - fits["W2 shuffled"].mean() for name, fit in others.items()},
            **ABOVE,
        ),
    ]


def _preferences():
    """How much more layers answer to shuttlecocks than to cups, by lesson and by layer."""
    preferences = second_layers.load_results()["preferences"].T
    taught = dict(zip(second_layers.KINDS, preferences, strict=True))
    own, cups, *_ = preferences
    means = {kind: values.mean() for kind, values in taught.items()}
    crops, shuttlecock = cdbn.crops_of(photos.load("rig", "validation"))
    rest, maps = (cdbn.CDBN.load().layers(v) for v in (EMPTY, whiten(crops)))
    p1, p2 = (second_layers.preference(maps[k], rest[k], shuttlecock) for k in ("P1", "P2"))
    response = "evoked response to shuttlecocks over cups: of P²"
    return [
        mean(
            f"{response} taught by shuttlecocks, less of P² taught by cups",
            0,
            own - cups,
            "pairs of trainings",
            nulls={kind: means[kind] - cups.mean() for kind in ("mirrored", "noise")},
            **ABOVE,
        ),
        mean(
            f"{response}, less of P¹",
            0,
            p2 - p1,
            "photos",
            nulls={kind: means[kind] - p1.mean() for kind in second_layers.KINDS[1:]},
            **ABOVE,
        ),
        mean("the same of P¹", None, p1, "photos"),
        mean("the same of P²", None, p2, "photos"),
        *(
            mean(f"the same of P², {kind}", None, values, "trainings")
            for kind, values in taught.items()
        ),
        Quantity(
            "probability that a unit of P² is on in an empty picture", None, rest["P2"].mean()
        ),
    ]


@cache
def gabor_correlations(kind):
    """How well Gabors fit filters in the picture, "W1", "W2" or "W2 shuffled": (K,)."""
    network = cdbn.CDBN.load()
    if kind == "W2 shuffled":
        machine = network.second
        W = shuffle(machine.W, np.random.default_rng(0))
        network = replace(network, second=machine.with_filters(W))
    some = network.first.W[:, 0] if kind == "W1" else network.projected_filters()
    return np.array([gabor.best_gabor(W)[1] for W in some])


ROWS = (
    Row(
        "Fig. 2",
        "Two CRBMs with probabilistic max pooling, and a mean-out layer.",
        "05_hierarchy",
        _figure_2,
    ),
    Row(
        "Fig. 7",
        "First-layer filters are edges of different directions, like Gabor functions.",
        "05_hierarchy",
        _figure_7,
        note="The recipe was fitted: whitening, sparsity and clamping were chosen so that filters "
        "look like this. With any of the three left out (chapter 4), and for round blobs, this "
        "row differs. But no CRBM is needed: independent components and k-means of the same "
        "whitened patches are edges of different directions, too. Only the share in the middle "
        "tells ours from theirs, and that was fitted. The paper's captions name eight filters, its "
        "text K = 10.",
    ),
    Row(
        "IV B, V1",
        "First-layer filters are like those of the primate's V1.",
        "05_hierarchy",
        _v1,
        differs="Half of our filters answer to more than half the directions that a stripe can "
        "have: eight pixels hold hardly more than one stripe.",
        note="The macaque's median is from the abstract of De Valois, Yund & Hepler (1982), "
        "the octaves from Foster et al. (1985): 1.4 where sight is sharpest, 1.8 beside it.",
    ),
    Row(
        "Fig. 8",
        "The feature maps shrink layer by layer, and are tuned to textures.",
        "05_hierarchy",
        _figure_8,
        note="A unit is tuned if it is on where stripes run as it prefers: twice the angle between "
        "them has a higher cosine than under the other units, by more than with each filter's "
        "numbers in another order. Shuttlecocks of the rig's validation photos. Any filter with a "
        "direction is tuned so: independent components and k-means of the same patches more than "
        "ours. The number says that there are edges in both, and nothing of how they were learnt. "
        "Its interval is where one more order falls, in the network that ships: other photos and "
        "other trainings are not in it.",
    ),
    Row(
        "IV B, W²",
        "The second layer's features are more complex, and the badminton's own.",
        "05_hierarchy",
        _deeper,
        note="An evoked response is what is above the answer to an empty picture: there units of "
        "P² are on in {q[probability that a unit of P² is on in an empty picture].obtained:.2f} of "
        "all places, those of P¹ hardly anywhere. The lesson leaves a mark: a second "
        "layer that shuttlecocks taught prefers them more than one that cups taught, in "
        f"{len(second_layers.SEEDS)} pairs, each taught by {second_layers.PATCHES} patches. But so "
        "do its filters in the mirror, which fit no shuttlecock's parts, and noise as strong: the "
        "mark is not in the texture. Nor do the fits of a Gabor show that anything more complex "
        "was learnt: a second layer of smoothed noise fits as badly as ours, and so does ours with "
        "its maps in another order, or in the mirror.",
    ),
    Row(
        "III, Block 1-2",
        "The two layers are edge detectors and key components, as in Qiao et al. (2015).",
        "05_hierarchy",
        list,
        note="Not seen: the paper refers to Qiao et al. (2015) for details of its network and its "
        "training, and to Qiao et al. (in Assembly Automation) for those of its movements. We "
        "could open neither. What we chose in their place is told in each chapter.",
    ),
)
