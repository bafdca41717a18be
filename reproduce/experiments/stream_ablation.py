"""Ablation of the ventral stream's training: named right without one of its parts.

It has fewer maps than what ships, so that it can be trained many times, and learns for a shorter
time. No mistakes are mined.
"""

from dataclasses import replace
from functools import partial

import numpy as np

from reproduce.experiments.domain_shift import balanced_accuracy
from reproduce.results import arrays
from reproduce.training.augmentation import Augmentation
from reproduce.training.samples import (
    PASTED,
    SHARES,
    collect_samples,
    photo_samples,
    training_samples,
)
from vmc_lib import photos

PLAIN = Augmentation(
    stray=0, quarters=False, colour=0, light=0, blur=0, noise=0, compress=0, hide=0, strings=0
)
MAPS = 8, 16, 32, 32  # of the four stages
WITHOUT = {  # how samples change when an idea is left out, and how many maps the stages have
    "all of them": (lambda pool: pool, MAPS),
    "two stages, not four": (lambda pool: pool, MAPS[:2]),
    "without new looks": (lambda pool: replace(pool, augmentation=PLAIN), MAPS),
    "without pasted scenes": (lambda pool: without(pool, "pasted"), MAPS),
    "without windows of photographs": (
        lambda pool: without(pool, "real", "pasted", kinds=["scene"]),
        MAPS,
    ),
    "without photographs": (lambda pool: without(pool, "real", "pasted"), MAPS),
}
DRAWS, STEPS, BATCH, RATE = 6, 300, 32, 0.003
WINDOWS = 12  # about how many of a photograph are asked


def without(pool, *sources, kinds=SHARES):
    """Training samples with some kinds of some sources removed."""
    gone = {name: pool.sources[name] | dict.fromkeys(kinds, ()) for name in sources}
    return replace(pool, sources=pool.sources | gone)


def make(folder=photos.FOLDER, draws=DRAWS, steps=STEPS, everyday=None, pasted=PASTED):
    """What `results/ablation.npz` holds: what is left out -> what is named right, (draws,).

    Of the validation photographs: their shuttlecocks' true boxes, other things, and windows; as
    `domain_shift.balanced_accuracy`. Only the training photos teach. `everyday` and `pasted` as for
    `samples.collect_samples`.
    """
    rng = np.random.default_rng(0)
    teach = training_samples(collect_samples(rng, folder, everyday, pasted))
    exam = evaluation_set(photo_samples(photos.load(photos.REAL_LEVEL, "validation", folder), rng))
    return {
        name: np.array(
            [
                accuracy_after_training(change(teach), maps, exam, draw, steps)
                for draw in range(draws)
            ]
        )
        for name, (change, maps) in WITHOUT.items()
    }


load_results = partial(arrays, "ablation")


def evaluation_set(shown):
    """Labelled boxes of `photo_samples`: (image, boxes (n, 4), label) for each photo and kind."""
    return [
        (image, boxes[:: max(1, len(boxes) // WINDOWS)], kind == "shuttlecock")
        for photo in shown
        for kind, (image, boxes) in photo.items()
    ]


def accuracy_after_training(teach, maps, exam, seed, steps):
    """Balanced accuracy on an exam of a stream with these `maps`, trained on `teach`."""
    from reproduce.training import ventral_stream as training  # with torch, slow to load

    network = training.build_network(seed, maps)
    training.train(network, training.Batches(teach, seed, steps, BATCH), RATE)
    stream = training.fold_batch_norm(network)
    called = [stream.box_probability(image, boxes) > 0.5 for image, boxes, _ in exam]
    labels = [np.full(len(boxes), label) for _, boxes, label in exam]
    return balanced_accuracy(np.concatenate(called), np.concatenate(labels))
