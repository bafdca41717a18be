"""Training the ventral stream by back-propagation, with augmentation and hard-negative mining.

One network learns two things at once: whether a box shows a shuttlecock, and how far its edges are
from the true ones. A box that strays far is a lesson in both.
"""

from contextlib import contextmanager
from dataclasses import replace
from functools import partial

import numpy as np
import torch
from joblib import Parallel, delayed
from scipy.optimize import minimize
from torch import nn
from torch.nn import functional as F
from torch.utils.data import DataLoader, Dataset

from reproduce.training.augmentation import augment
from reproduce.training.samples import (
    APART,
    PASTED,
    VALIDATION,
    collect_samples,
    training_samples,
    validation_photos,
)
from vmc_lib import loop, photos
from vmc_lib.boxes import HIT_IOU, iou
from vmc_lib.what.stream import WIDTH, VentralStream, standardise

torch.set_num_threads(1)

MAPS = 32, 64, 128, 128  # of the four STAGES
STEPS, BATCH, RATE = (17_000, 13_000), 64, (0.003, 0.0015)  # before and after mining
HARD = 24  # windows of a photo that teach after mining: those most like a shuttlecock
NEAR, YES, NO = 0.3, 0.55, 0.4  # IoU from which edges are taught; of boxes called one, and not
DROPPED = 0.1  # share of the last stage's activations hidden from the read-out while it learns
SCALE, EDGES = 0.2, 5  # of the corrections that are read out; how much they count


def augmented_batch(pool, count, rng):
    """A batch of augmented crops (n, 3, WIDTH, WIDTH), IoUs (n,), box deltas (n, 4), float32."""
    parts = zip(
        *(augment(*pool.draw(rng), rng, pool.augmentation) for _ in range(count)), strict=True
    )
    x, fit, lack = (np.array(part, np.float32) for part in parts)
    return standardise(np.moveaxis(x, 3, 1)), fit, lack


def build_network(seed, maps=MAPS):
    """An untrained network: the stages of a `VentralStream`, and its read-out."""
    layers, channels, places = [], 3, (WIDTH // 2 ** len(maps)) ** 2
    with torch_seed(seed):
        for count in maps:
            layers.append(nn.Conv2d(channels, count, 3, padding=1, bias=False))
            layers += nn.BatchNorm2d(count), nn.MaxPool2d(2), nn.ReLU()
            channels = count
        readout = nn.Flatten(), nn.Dropout(DROPPED), nn.Linear(places * channels, 5)
    return nn.Sequential(*layers, *readout)


@contextmanager
def torch_seed(seed):
    """Seed torch's global generator in this block; restore it after."""
    with torch.random.fork_rng():
        torch.random.default_generator.manual_seed(seed)
        yield


def loss(outputs, fit, lack):
    """Training loss: cross-entropy of the name, smooth L1 of the deltas of boxes near one."""
    clear, near = (fit > YES) | (fit < NO), fit > NEAR
    name = F.binary_cross_entropy_with_logits(outputs[clear, 0], (fit[clear] > YES).float())
    off = F.smooth_l1_loss(SCALE * outputs[near, 1:], lack[near], beta=0.05)
    return name + EDGES * off if near.any() else name


class Batches(Dataset):
    """Batches of `augmented_batch`, each with its own random numbers, drawn when indexed."""

    def __init__(self, pool, seed, steps, batch=BATCH):
        self.pool, self.seed, self.steps, self.batch = pool, seed, steps, batch

    def __len__(self):
        return self.steps

    def __getitem__(self, i):
        return augmented_batch(self.pool, self.batch, np.random.default_rng((self.seed, i)))


def train(network, batches, rate):
    """Train a network in place, on `Batches`.

    By torch's AdamW, whose rate rises and falls once (OneCycleLR). While it learns, each map is
    brought to one scale (batch normalisation), and products are of 16 bits: twice as quick
    where the processor has them.
    """
    network.to(memory_format=torch.channels_last)  # as the crops lie: twice as quick
    learner = torch.optim.AdamW(network.parameters(), lr=rate, weight_decay=0.02)
    rise_and_fall = torch.optim.lr_scheduler.OneCycleLR(learner, rate, len(batches), pct_start=0.15)
    with torch_seed(batches.seed):
        for x, fit, lack in DataLoader(batches, batch_size=None, num_workers=1):  # drawn beside
            with torch.autocast("cpu", torch.bfloat16):
                outputs = network(x)
            error = loss(outputs.float(), fit, lack)
            learner.zero_grad()
            error.backward()
            learner.step()
            rise_and_fall.step()


def fold_batch_norm(network):
    """Fold batch normalisation into the filters: a network as a `VentralStream`."""
    filters, biases = [], []
    for conv, norm in zip(network[:-3:4], network[1:-3:4], strict=True):
        gain = norm.weight / torch.sqrt(norm.running_var + norm.eps)
        filters.append((conv.weight * gain[:, None, None, None]).detach().numpy())
        biases.append((norm.bias - norm.running_mean * gain).detach().numpy())
    linear, size = network[-1], torch.tensor([[1.0]] + 4 * [[SCALE]])
    readout, offsets = (linear.weight * size).detach(), (linear.bias * size[:, 0]).detach()
    return VentralStream(tuple(filters), tuple(biases), readout.numpy(), offsets.numpy())


def hard_negatives(stream, photo):
    """Hard negatives: a photo's boxes by kind, with the windows of highest false log-odds.

    As `samples.boxes_by_kind` gives it. They are sought among its likeliest windows as they are,
    and as the stream tightens these.
    """
    image, windows = photo["scene"]
    likeliest = windows[np.argsort(-stream.predict(image, windows)[0])[: 2 * HARD]]
    some = np.vstack([likeliest, stream.refine_boxes(image, likeliest)])
    if "shuttlecock" in photo:
        some = some[iou(some, photo["shuttlecock"][1]).max(1) < APART]
    hardest = np.argsort(-stream.predict(image, some)[0])[:HARD]
    return photo | {"scene": (image, some[hardest])}


def fit_sigmoid(stream, shots):
    """Platt scaling: the stream whose choices come true as often as it says, on these photos.

    It has learnt from boxes of which four in ten show a shuttlecock; of hundreds in a photo it
    chooses the likeliest. So a sigmoid of the chosen box's log-odds is fitted to whether that box
    is right (Platt 1999, with his smoothed targets).
    """
    asked = delayed(partial(likeliest_box, stream, loop.high_recall_detector(photos.REAL_LEVEL)))
    log_odds, right = np.transpose(Parallel()(map(asked, shots)))
    hits, misses = right.sum(), (1 - right).sum()
    target = np.where(right, (hits + 1) / (hits + 2), 1 / (misses + 2))

    def cross_entropy(sigmoid):
        z = np.polyval(sigmoid, log_odds)
        return (np.logaddexp(0, z) - target * z).sum()

    return replace(stream, sigmoid=minimize(cross_entropy, (1, 0)).x)


def likeliest_box(stream, detector, shot):
    """The log-odds of the box that a stream chooses in a photo, and whether it is a shuttlecock."""
    chosen, _ = stream.select(shot.image, detector.detect(shot.image))
    fits = iou(chosen.boxes[:1], photos.boxes_of(shot, "shuttlecock"))
    return chosen.scores[0], fits.max(initial=0) > HIT_IOU


def photographs(folder=photos.FOLDER, steps=STEPS, maps=MAPS, everyday=None, pasted=PASTED):
    """The arrays of `data/photographs.npz`: a `VentralStream`.

    It learns, its mistakes are mined, and it learns on; at last its sigmoid is fitted. `everyday`
    and `pasted` as for `samples.collect_samples`.
    """
    lessons, network = (
        collect_samples(np.random.default_rng(0), folder, everyday, pasted),
        build_network(0, maps),
    )
    for part, (some, rate) in enumerate(zip(steps, RATE, strict=True)):
        if part:
            mine = delayed(partial(hard_negatives, fold_batch_norm(network)))
            lessons = {level: Parallel()(map(mine, seen)) for level, seen in lessons.items()}
        train(network, Batches(training_samples(lessons), part, some), rate)
    scenes = min(pasted, VALIDATION)
    asked = validation_photos(np.random.default_rng(0), folder, everyday, scenes)
    stream = fit_sigmoid(fold_batch_norm(network), asked)
    return {name: np.float16(part) for name, part in stream.arrays().items()}
