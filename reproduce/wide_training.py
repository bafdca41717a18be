"""Names for photographs, which differ from each other in every way: learnt from many looks.

The network has the form of the paper's, with more maps, and sees smaller crops. All its weights are
learnt at once, by back-propagation, from boxes of renders and of photographs, and from windows of
their scenes, among them those that the object detector takes for objects.
"""

from functools import partial

import numpy as np
import torch
from sklearn.linear_model import LogisticRegression
from torch.nn import functional as F

from reproduce.name_training import fit_name_classifier
from reproduce.pools import NARROW, pools, show
from vmc_lib import loop, photos
from vmc_lib.boxes import iou
from vmc_lib.what.cdbn import CDBN, N_W, C
from vmc_lib.what.crops import whiten
from vmc_lib.what.learning import Learner
from vmc_lib.what.recogniser import NameClassifier, Recogniser, read_outs, seen

MAPS = 32, 64  # of the two layers
STEPS, BATCH, RATE = 1200, 64, 0.005  # of learning end to end
EXAMPLES = 4000  # that a read-out learns from; a quarter as many validate it
READ_OUT, TURNS = "P1 + P2", 4  # of what ships; the turns were chosen on validation photographs


def end_to_end(draw, rng, maps=MAPS, steps=STEPS, batch=BATCH, rate=RATE):
    """A CDBN whose every weight learns at once, from random ones, what tells the labels apart.

    draw: gives so many crops (n, NARROW, NARROW) and labels (n,). A linear read-out learns along,
    of features that are brought to one scale, and is dropped. By torch's AdamW, whose rate rises
    and falls once (OneCycleLR).
    """
    torch_rng = torch.Generator().manual_seed(int(rng.integers(2**31)))
    cdbn = blank(maps, torch_rng)
    weights = [getattr(crbm, part) for crbm in (cdbn.first, cdbn.second) for part in "Wb"]
    size = seen(cdbn, torch.randn(1, 1, NARROW, NARROW, generator=torch_rng))[READ_OUT].shape[1]
    scale = torch.nn.BatchNorm1d(size, affine=False)
    readout, bias = torch.zeros(size, requires_grad=True), torch.zeros(1, requires_grad=True)
    learner = torch.optim.AdamW([*weights, readout, bias], lr=rate, weight_decay=0.01)
    rise_and_fall = torch.optim.lr_scheduler.OneCycleLR(learner, rate, steps, pct_start=0.15)
    for _ in range(steps):
        crops, labels = draw(batch)
        logit = scale(seen(cdbn, torch.from_numpy(whiten(crops)))[READ_OUT]) @ readout + bias
        loss = F.binary_cross_entropy_with_logits(logit, torch.tensor(labels, dtype=torch.float))
        learner.zero_grad()
        loss.backward()
        learner.step()
        rise_and_fall.step()
    return CDBN.from_arrays(cdbn.arrays())


def blank(maps, rng):
    """A CDBN of Learners that know nothing: random filters, hidden units on half the time."""
    layers, channels = [], 1
    for count in maps:
        W = torch.randn(count, channels, N_W, N_W, generator=rng) / (N_W * channels**0.5)
        b = torch.full((count,), -float(np.log(C**2)))
        layers.append(Learner(W.requires_grad_(), b.requires_grad_(), torch.zeros(channels), C))
        channels = count
    return CDBN(*layers, mean=0.5, spread=0.2)


def named(cdbn, pools, rng, count=EXAMPLES):
    """The `Recogniser` of a CDBN: a linear read-out learnt from examples of the pools.

    Trained on the first of the `pools`, its penalty and its probabilities set on the second.
    """
    sets = []
    for one, n in zip(pools, (count, count // 4), strict=True):
        crops, labels = one.examples(n, rng)
        sets += [read_outs(cdbn, crops)[READ_OUT], labels]
    return Recogniser(cdbn, READ_OUT, fit_name_classifier(*sets), NARROW, TURNS)


# ---------------------------------------------------------------- what ships


def photographs(folder=photos.FOLDER, steps=STEPS, count=EXAMPLES, everyday=None):
    """What `data/photographs.npz` holds: who names things in photographs, and who judges.

    A network learnt end to end, its read-out, and the judge of what both pathways say. `everyday`
    as for `pools.show`.
    """
    rng = np.random.default_rng(0)
    both = pools(show(("train", "validation"), rng, folder, everyday))
    cdbn = end_to_end(partial(both[0].examples, rng=rng), rng, steps=steps)
    recogniser = named(cdbn, both, rng, count)
    levels = (photos.load(level, "validation", folder) for level in photos.EVERY_LEVEL)
    held_out = [shot for shots in levels for shot in shots]
    learnt = cdbn.arrays() | {"looks": np.array([recogniser.width, recogniser.turns])}
    linear = {READ_OUT: recogniser.classifier, "judge": judge(recogniser, held_out)}
    for name, one in linear.items():
        learnt |= {f"{name}/w": np.float32(one.weights), f"{name}/b": one.bias}
    return learnt


def judge(recogniser, shots):
    """Of boxes that the object detector finds in photos: the chance that one is a shuttlecock's.

    Logistic regression on what `loop.weighed` gives, as a `NameClassifier`; right is an IoU above
    0.5. Renders teach with the photographs, for these alone are too few: a fit that says much in
    some photos says little in others.
    """
    detector, x, y = loop.lenient_detector(photos.REAL_LEVEL), [], []
    for shot in shots:
        found = detector.detect(shot.image)
        x.append(loop.weighed(found, recogniser, shot.image))
        truth, boxes = photos.all_of(shot, "shuttlecock"), found.boxes[: loop.WEIGHED]
        y.append(iou(boxes, truth).max(1, initial=0) > 0.5)
    logistic = LogisticRegression(C=np.inf).fit(np.vstack(x), np.hstack(y))  # three numbers
    return NameClassifier(logistic.coef_[0], float(logistic.intercept_[0]))
