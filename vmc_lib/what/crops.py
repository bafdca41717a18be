"""Grey crops of boxes, whitened as the retina does: the input of the ventral pathway."""

from collections.abc import Sequence
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from vmc_lib.boxes import pixels_inside
from vmc_lib.checks import as_numbers, is_positive
from vmc_lib.short_repr import short

WIDTH = 200  # pixels of a crop, as in the paper


def crop(image: np.ndarray, box: Sequence[float] | np.ndarray) -> np.ndarray:
    """Crop a box (x0, y0, x1, y1) of an image, in grey, resized to (200, 200), in 0..1.

    The crop is stretched to a square, whatever the shape of the box, as in the paper. ValueError
    for a box that is not at least 2 × 2 pixels inside the image.
    """
    import cv2

    from vmc_lib.photos import as_rgb

    x0, y0, x1, y1 = pixels_inside(box, image)
    grey = cv2.cvtColor(as_rgb(image[y0:y1, x0:x1]), cv2.COLOR_RGB2GRAY)
    how = cv2.INTER_AREA if min(x1 - x0, y1 - y0) > WIDTH else cv2.INTER_CUBIC
    return cv2.resize(grey, (WIDTH, WIDTH), interpolation=how).astype(np.float32) / 255


def has_contrast(pictures: np.ndarray) -> np.ndarray:
    """Whether each of the grey pictures (n, height, width) has enough contrast to be whitened."""
    return pictures.std((1, 2)) > 1e-4


def whiten(pictures: np.ndarray, cutoff: float = 0.4, dtype: DTypeLike = np.float32) -> np.ndarray:
    """Whiten grey pictures (n, height, width) for a CRBM: `dtype` (n, 1, height, width).

    In photos, neighbouring pixels are alike and coarse contrast outweighs fine contrast: amplitude
    falls as 1/f. Multiplying it by f evens it out, and exp(-(f / cutoff)⁴), with f in cycles a
    pixel, drops the finest, which is mostly noise (Olshausen & Field 1997). The retina does much
    the same. Each picture then gets mean 0 and standard deviation 1. ValueError for pictures of
    other shapes, with NaN, or without any contrast.
    """
    from scipy import fft  # NumPy's in the page

    x = np.asarray(as_numbers("pictures", pictures), dtype)
    if not is_positive(cutoff):
        raise ValueError(f"cutoff = {short(cutoff)}: give cycles a pixel, above 0")
    if x.ndim != 3 or 0 in x.shape:
        raise ValueError(f"pictures are (n, height, width), not {x.shape}")
    if not (np.isfinite(x).all() and has_contrast(x).all()):
        raise ValueError("a picture needs finite values and some contrast: one has not")
    # A mirrored border, so that opposite edges do not meet in the transform
    border = max(1, min(x.shape[1:]) // 10)
    x = np.pad(x, [(0, 0), (border, border), (border, border)], mode="reflect")
    x = fft.irfft2(fft.rfft2(x) * _whitening_filter(*x.shape[1:], cutoff), x.shape[1:])
    x = x[:, None, border:-border, border:-border]
    return (x - x.mean((2, 3), keepdims=True)) / x.std((2, 3), keepdims=True, ddof=1)


def whitening_gain(f: ArrayLike, cutoff: float = 0.4) -> np.ndarray:
    """The whitening filter's gain at spatial frequencies f, in cycles a pixel."""
    f = np.asarray(f)
    return f * np.exp(-((f / cutoff) ** 4))


@cache
def _whitening_filter(height, width, cutoff):
    """Gain of the whitening filter at each frequency of pictures of a size."""
    f = np.hypot(np.fft.fftfreq(height)[:, None], np.fft.rfftfreq(width))
    return np.float32(whitening_gain(f, cutoff))
