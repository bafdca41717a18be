"""Training of the ventral stream: batches, loss, batch-norm folding, hard negatives."""

from types import SimpleNamespace

import numpy as np
import torch

from reproduce.training import samples
from reproduce.training import ventral_stream as training
from vmc_lib import loop, photos
from vmc_lib.boxes import iou
from vmc_lib.what.recogniser import logistic
from vmc_lib.what.stream import WIDTH, VentralStream

MAPS = 4, 4, 4, 4
SHOT = photos.load("rig", "train")[0]


def pool():
    rng = np.random.default_rng(0)
    return samples.training_samples(
        {"rig": [samples.boxes_by_kind(SHOT, samples.random_windows(rng), rng)]}
    )


def test_batches_are_reproducible():
    one, other = (training.Batches(pool(), 3, steps=2, batch=4) for _ in range(2))
    assert len(one) == 2
    for x, y in zip(one[1], other[1], strict=True):
        np.testing.assert_array_equal(x, y)
        assert x.dtype == np.float32
    assert one[0][0].shape == (4, 3, WIDTH, WIDTH)
    assert not np.array_equal(one[0][0], one[1][0])


def test_folded_batch_norm_gives_equal_outputs():
    network = training.build_network(0, MAPS)
    x = torch.randn(8, 3, WIDTH, WIDTH, generator=torch.Generator().manual_seed(0))
    for _ in range(3):
        network(x)  # its normalisation has met something
    stream, expected = training.fold_batch_norm(network), network.eval()(x).detach().numpy()
    last = list(stream.stages(x.numpy()).values())[-1].reshape(8, -1)
    output = last @ stream.readout.T + stream.offsets
    np.testing.assert_allclose(output[:, 0], expected[:, 0], atol=1e-4)
    np.testing.assert_allclose(output[:, 1:], training.SCALE * expected[:, 1:], atol=1e-4)


def test_loss_ignores_unclear_names_and_boxes_of_no_shuttlecock():
    output = torch.zeros(3, 5)
    fit, lack = torch.tensor([0.9, 0.5, 0.0]), torch.zeros(3, 4)
    plain = training.loss(output, fit, lack)
    output[1, 0], output[2, 1:] = 9, 9  # an unclear name, and the edges of no shuttlecock
    assert training.loss(output, fit, lack) == plain
    output[0, 0] = 5
    named = training.loss(output, fit, lack)
    assert named < plain
    output[0, 1] = 3
    assert training.loss(output, fit, lack) > named


def test_training_reduces_the_loss():
    batches = training.Batches(pool(), 0, steps=25, batch=16)
    network = training.build_network(0, MAPS)

    def wrong():
        x, fit, lack = map(
            torch.from_numpy, training.augmented_batch(pool(), 64, np.random.default_rng(9))
        )
        with torch.no_grad():
            return training.loss(network(x), fit, lack)

    before = wrong()
    training.train(network, batches, 0.01)
    assert wrong() < 0.8 * before


def test_hard_negatives_hold_no_shuttlecock():
    class Fond:
        """Takes for a shuttlecock what lies to the left, and tightens nothing."""

        def predict(self, image, boxes):
            return -boxes[:, 0], np.zeros((len(boxes), 4))

        def refine_boxes(self, image, boxes):
            return boxes + 1

    rng = np.random.default_rng(0)
    photo = samples.boxes_by_kind(SHOT, samples.random_windows(rng), rng)
    negatives = training.hard_negatives(Fond(), photo)
    image, boxes = negatives["scene"]
    assert image is photo["scene"][0]
    assert len(boxes) == training.HARD
    assert iou(boxes, photo["shuttlecock"][1]).max() < samples.APART
    assert boxes[:, 0].max() <= np.median(photo["scene"][1][:, 0])
    assert negatives["shuttlecock"] is photo["shuttlecock"]


def test_the_sigmoid_is_that_by_which_choices_come_true(monkeypatch, rng):
    log_odds = rng.normal(0, 4, 3000)
    answers = [*zip(log_odds, rng.random(3000) < logistic(0.5 * log_odds - 1.5), strict=True)]
    monkeypatch.setattr(training, "likeliest_box", lambda stream, detector, shot: shot)
    calibrated = training.fit_sigmoid(VentralStream.load(), answers)
    np.testing.assert_allclose(calibrated.sigmoid, (0.5, -1.5), atol=0.15)


def test_the_box_that_is_asked_for_is_the_likeliest():
    stream, detector = VentralStream.load(), loop.high_recall_detector("real")
    shot = photos.load("real", "validation")[0]
    log_odds, right = training.likeliest_box(stream, detector, shot)
    assert log_odds > 3
    assert right
    plain = SimpleNamespace(image=np.full_like(shot.image, 128), boxes={}, more=shot.more)
    log_odds, right = training.likeliest_box(stream, detector, plain)
    assert log_odds < 0
    assert not right
