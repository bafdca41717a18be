import numpy as np
import pytest
import torch

from vmc_lib.what.crops import crop, whiten
from vmc_lib.what.learning import Patches


def test_crop_is_the_inside_of_the_box():
    image = np.zeros((400, 600, 3), np.uint8)
    image[100:150, 200:300] = 255
    assert crop(image, np.array([200, 100, 300, 150])).shape == (200, 200)
    assert crop(image, np.array([200, 100, 300, 150])).min() == 1
    half = crop(image, np.array([150, 100, 250, 150]))
    assert half[:, :90].max() == 0
    assert half[:, 110:].min() == 1


def test_crop_stops_at_the_edge_of_the_image(rng):
    image = rng.integers(0, 255, (400, 600, 3), dtype=np.uint8)
    assert (crop(image, [-50, -50, 80, 90]) == crop(image, [0, 0, 80, 90])).all()
    for box in ([700, 10, 800, 50], [10, 10, 11, 90]):
        with pytest.raises(ValueError, match="box"):
            crop(image, box)


def test_whitening_makes_1_over_f_noise_white(rng):
    f = np.hypot(np.fft.fftfreq(200)[:, None], np.fft.rfftfreq(200))
    f[0, 0] = np.inf
    spectrum = np.fft.rfft2(rng.normal(size=(20, 200, 200))) / f
    v = whiten(np.fft.irfft2(spectrum))
    assert v.shape == (20, 1, 200, 200)
    assert abs(v.mean((2, 3))).max() < 1e-5
    assert abs(v.std((2, 3), ddof=1) - 1).max() < 1e-5
    power = np.abs(np.fft.rfft2(v[:, 0])) ** 2
    bands = [power[:, (f > low) & (f < low + 0.05)].mean() for low in (0.02, 0.07, 0.12)]
    assert max(bands) < 1.25 * min(bands)
    assert power[:, (f > 0.6) & (f < 1)].mean() < 0.01 * min(bands)


@pytest.mark.parametrize(
    "bad",
    [
        np.ones((1, 200, 200)),
        np.full((1, 200, 200), np.nan),
        np.zeros((200, 200)),
        np.zeros((0, 9, 9)),
    ],
    ids=["constant", "nan", "one picture only", "none"],
)
def test_whitening_refuses(bad):
    with pytest.raises(ValueError, match="picture"):
        whiten(bad)


def test_patches_are_windows_of_the_maps():
    maps = torch.arange(2 * 3 * 30 * 40.0).reshape(2, 3, 30, 40)
    patches = Patches(maps, 7, 500, torch.Generator().manual_seed(0))
    assert len(patches) == 500
    some = patches[torch.arange(500)]
    assert some.shape == (500, 3, 7, 7)
    corner = some[:, 0, 0, 0].long()
    picture, y, x = corner // 3600, corner % 3600 // 40, corner % 40
    assert torch.equal(some[3], maps[picture[3], :, y[3] : y[3] + 7, x[3] : x[3] + 7])
    assert {0, 1} == set(picture.tolist())
    assert y.max() == 23
    assert x.max() == 33
    assert torch.equal(patches[torch.arange(500)], some)
