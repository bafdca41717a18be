import numpy as np

from reproduce.measures.crop_augmentation import augmented_crop
from vmc_lib import photos
from vmc_lib.what.crops import crop


def test_at_strength_0_a_crop_stays_as_it_is(rng):
    photo = photos.load("rig", "validation")[0]
    box = photo.boxes["cup"]
    plain = crop(photo.image, box)
    np.testing.assert_allclose(augmented_crop(photo, box, rng), plain)
    lit = augmented_crop(photo, box, rng, light=0.3) / plain.clip(1e-3)
    assert np.median(lit) != 1
    assert np.ptp(lit[plain > 0.1]) < 1e-5
    mirrored = [augmented_crop(photo, box, rng, mirror=True)[:, ::-1] for _ in range(20)]
    assert any(np.allclose(picture, plain) for picture in mirrored)
