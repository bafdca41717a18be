"""How fast the CDBN learns and names, beside scikit-learn's RBM doing as many multiply-adds."""

from functools import partial

import numpy as np
import torch
from sklearn.neural_network import BernoulliRBM

from reproduce.training.cdbn import FIRST, SECOND
from tools.bench.report import publish, seconds, sgemm
from vmc_lib import photos
from vmc_lib.what.cdbn import N_W, PATCHES, K, crops_of
from vmc_lib.what.learning import Learner
from vmc_lib.what.recogniser import Recogniser

SAMPLE = 200  # patches timed, again and again; an epoch has PATCHES
PASSES = 5  # over a hidden unit's window: up, down, up again, and two counts of statistics


def layer(channels, width, rng):
    """A call that learns from SAMPLE patches for one epoch, and its multiply-adds a patch."""
    machine = Learner.random(K, channels, N_W, rng)
    patches = machine.trim(torch.randn(SAMPLE, channels, width, width, generator=rng))
    hidden = (patches.shape[-1] - N_W + 1) ** 2
    learning = partial(machine.fit, patches, range(1), 0, sparsity=0.1)
    return learning, PASSES * hidden * N_W**2 * channels * K


def peer(channels, width, work):
    """scikit-learn's RBM, whose every hidden unit sees a whole patch: as many as cost the same."""
    units = round(work / PASSES / (channels * width**2))
    rbm = BernoulliRBM(units, batch_size=100, n_iter=1, random_state=0)
    patches = np.random.default_rng(0).random((SAMPLE, channels * width**2), dtype=np.float32)
    return lambda: rbm.fit(patches)


if __name__ == "__main__":
    yardstick, rows, whole = sgemm(), [], 0.0
    for name, channels, how in (("first layer", 1, FIRST), ("second layer", K, SECOND)):
        learning, work = layer(channels, how["width"], torch.Generator().manual_seed(0))
        ours, theirs = seconds(learning, 40), seconds(peer(channels, how["width"], work), 40)
        speed = 2e-9 * work * SAMPLE / ours
        whole += how["epochs"] * PATCHES / SAMPLE * ours
        rows.append(
            {
                "what": f"{name}, an epoch",
                "seconds": round(PATCHES / SAMPLE * ours, 1),
                "patches/s": round(SAMPLE / ours),
                "GFLOP/s": round(speed, 1),
                "share of sgemm": round(speed / yardstick, 2),
                "times as fast as scikit-learn": round(theirs / ours, 2),
            }
        )
    crops, _ = crops_of(photos.load("rig", "validation")[:1])
    recogniser = Recogniser.load("rig")
    label = seconds(lambda: recogniser.probability(crops[:1]))
    blank = dict.fromkeys(list(rows[0])[2:], "")
    rows.append({"what": "both layers, as shipped", "seconds": round(whole, 1), **blank})
    rows.append({"what": "one crop's name", "seconds": round(label, 3), **blank})
    publish("crbm", rows)
