"""What each idea of training buys: one stream, taught to name photographs without one of them.

It has fewer maps than what ships, so that it can be trained many times, and learns for a shorter
time. No mistakes are mined.
"""

from dataclasses import replace

import numpy as np

from reproduce.experiments.domain_shift import named_right
from reproduce.results import arrays
from reproduce.training.augmentation import Looks
from reproduce.training.samples import PASTED, SHARES, pool, seen_in, show
from vmc_lib import photos

PLAIN = Looks(stray=0, quarters=False, colour=0, light=0, blur=0, noise=0, compress=0, hide=0)
MAPS = 8, 16, 32, 32  # of the four stages
WITHOUT = {  # how a `Pool` changes when an idea is left out, and how many maps the stages have
    "all of them": (lambda pool: pool, MAPS),
    "two stages, not four": (lambda pool: pool, MAPS[:2]),
    "without new looks": (lambda pool: replace(pool, looks=PLAIN), MAPS),
    "without shuttlecocks laid on photographs": (lambda pool: less(pool, "pasted"), MAPS),
    "without windows of photographs": (
        lambda pool: less(pool, "real", "pasted", kinds=["scene"]),
        MAPS,
    ),
    "without photographs": (lambda pool: less(pool, "real", "pasted"), MAPS),
}
DRAWS, STEPS, BATCH, RATE = 6, 300, 32, 0.003
WINDOWS = 12  # about how many of a photograph are asked


def less(pool, *sources, kinds=SHARES):
    """A `Pool` without some kinds of what some sources have."""
    gone = {name: pool.sources[name] | dict.fromkeys(kinds, ()) for name in sources}
    return replace(pool, sources=pool.sources | gone)


def make(folder=photos.FOLDER, draws=DRAWS, steps=STEPS, everyday=None, pasted=PASTED):
    """What `results/ablation.npz` holds: what is left out -> what is named right, (draws,).

    Of the validation photographs: their shuttlecocks' true boxes, other things, and windows; as
    `domain_shift.named_right`. Only the training photos teach. `everyday` and `pasted` as for
    `samples.show`.
    """
    rng = np.random.default_rng(0)
    teach = pool(show(rng, folder, everyday, pasted))
    exam = asked(seen_in(photos.load(photos.REAL_LEVEL, "validation", folder), rng))
    return {
        name: np.array([right(change(teach), maps, exam, draw, steps) for draw in range(draws)])
        for name, (change, maps) in WITHOUT.items()
    }


def load():
    """What `make` found: arrays by what is left out."""
    return arrays("ablation")


def asked(shown):
    """Some boxes of photographs, as `samples.seen_in` gives them: (image, boxes (n, 4), label)."""
    return [
        (image, boxes[:: max(1, len(boxes) // WINDOWS)], kind == "shuttlecock")
        for photo in shown
        for kind, (image, boxes) in photo.items()
    ]


def right(teach, maps, exam, seed, steps):
    """What a stream of so many `maps`, taught by the pool `teach`, names right of an exam."""
    from reproduce.training import (
        ventral_stream as training,  # here, for torch weighs on who only reads
    )

    network = training.blank(seed, maps)
    training.teach(network, training.Batches(teach, seed, steps, BATCH), RATE)
    stream = training.folded(network)
    called = [stream.chance(image, boxes) > 0.5 for image, boxes, _ in exam]
    labels = [np.full(len(boxes), label) for _, boxes, label in exam]
    return named_right(np.concatenate(called), np.concatenate(labels))
