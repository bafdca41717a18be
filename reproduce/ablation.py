"""What each idea of training buys: one network, taught to name photographs without one of them.

It is small, with the paper's numbers of maps, so that it can be trained many times. What ships is
larger and was trained longer.
"""

from dataclasses import replace
from functools import partial

import numpy as np

from reproduce.domains import fixed, looked_at
from reproduce.looks import Looks
from reproduce.pools import SHARES, pools, show
from reproduce.results import arrays
from vmc_lib import photos
from vmc_lib.what.cdbn import K
from vmc_lib.what.crops import crop

PLAIN = Looks(
    stray=0, quarters=False, turn=0, colour=0, light=0, blur=0, noise=0, compress=0, hide=0
)
WITHOUT = {  # how a `Pool` changes when an idea is left out
    "all of them": lambda pool: pool,
    "without new looks": lambda pool: replace(pool, looks=PLAIN),
    "without windows of photographs": lambda pool: replace(pool, real=pool.real | {"scene": ()}),
    "without photographs": lambda pool: replace(pool, real=dict.fromkeys(SHARES, ())),
}
DRAWS, STEPS, BATCH = 6, 300, 16
EXAMPLES, WINDOWS = 1000, 12  # a read-out learns from; about how many of a photograph are asked


def make(folder=photos.FOLDER, draws=DRAWS, steps=STEPS, examples=EXAMPLES, everyday=None):
    """What `results/ablation.npz` holds: what is left out -> what is named right, (draws,).

    Of the validation photographs: their shuttlecocks' true boxes, other things, and windows; as
    `domains.named_right`. Only the training renders and photographs teach, and the penalty of the
    read-out is chosen on validation renders. `everyday` as for `pools.show`.
    """
    rng = np.random.default_rng(0)
    teach, ask = pools(show(("train", "validation"), rng, folder, everyday))
    renders, exam = WITHOUT["without photographs"](ask), asked(ask.real)
    return {
        name: np.array(
            [
                right(without(teach), renders, exam, np.random.default_rng(draw), steps, examples)
                for draw in range(draws)
            ]
        )
        for name, without in WITHOUT.items()
    }


def load():
    """What `make` found: arrays by what is left out."""
    return arrays("ablation")


def asked(real):
    """Crops (n, 200, 200) of photographs, of the kinds that a `Pool` has, and their labels."""
    found = [
        (crop(image, box), kind == "shuttlecock")
        for kind, shown in real.items()
        for image, boxes in shown
        for box in boxes[:: max(1, len(boxes) // WINDOWS)]
    ]
    return tuple(map(np.array, zip(*found, strict=True)))


def right(teach, renders, exam, rng, steps, examples):
    """What a network taught by the pool `teach` names right of an exam (crops, labels)."""
    from reproduce.wide_training import end_to_end  # here, for torch weighs on who only reads

    network = end_to_end(partial(teach.examples, rng=rng), rng, (K, K), steps, BATCH)
    sets = teach.examples(examples, rng), renders.examples(examples // 4, rng), exam
    taught, held_out, told = ((looked_at(network, crops), labels) for crops, labels in sets)
    return max(fixed(taught, held_out, [told], rng), key=lambda shares: shares[1])[2]
