"""HMAX (Serre et al. 2007): edges, their maxima, patches of those, and the best match of each.

S1 looks for edges of four directions at several scales, C1 keeps the strongest nearby, S2 compares
what is left with stored prototypes, C2 keeps each prototype's best match anywhere.
"""

import numpy as np
import torch
from torch.nn import functional as F

torch.set_num_threads(1)  # why: see `vmc_lib.what.learning`

# Serre et al. 2007, Table 1: filter widths of a band, its C1 neighbourhood; wavelength and breadth
BANDS = {(7, 9): 8, (11, 13): 10, (15, 17): 12, (19, 21): 14}
WAVELENGTH = {7: 3.5, 9: 4.6, 11: 5.6, 13: 6.8, 15: 7.9, 17: 9.1, 19: 10.3, 21: 11.5}
BREADTH = {7: 2.8, 9: 3.6, 11: 4.5, 13: 5.4, 15: 6.3, 17: 7.3, 19: 8.2, 21: 9.2}
SCALE = 4  # width of a prototype on C1, as in the paper


def s1_filters(width):
    """Gabor filters (4, 1, width, width) of four directions, mean 0 and length 1."""
    y, x = torch.meshgrid(*[torch.arange(width) - width // 2] * 2, indexing="ij")
    angle = torch.arange(4)[:, None, None] * np.pi / 4
    u, w = x * angle.cos() + y * angle.sin(), y * angle.cos() - x * angle.sin()
    envelope = torch.exp(-(u**2 + 0.09 * w**2) / (2 * BREADTH[width] ** 2))
    gabor = envelope * torch.cos(2 * np.pi * u / WAVELENGTH[width]) * (u**2 + w**2 <= width**2 / 4)
    gabor = gabor - gabor.mean((1, 2), keepdim=True)
    return (gabor / gabor.square().sum((1, 2), keepdim=True).sqrt())[:, None]


def s1(crops, width):
    """How well an edge of each direction fits at each pixel, whatever the contrast: 0 to 1."""
    side = width // 2
    here = F.conv2d(crops, s1_filters(width), padding=side).abs()
    rows = F.avg_pool2d(crops**2, (width, 1), 1, (side, 0))  # row by row: much faster than at once
    power = F.avg_pool2d(rows, (1, width), 1, (0, side)) * width**2
    return here / (power.sqrt() + 0.1)


def c1(crops):
    """For each band, the maps (n, 4, height, width) of the strongest edges nearby."""
    crops = torch.as_tensor(crops)[:, None]
    for widths, near in BANDS.items():
        best = torch.stack([s1(crops, width) for width in widths]).amax(0)
        yield F.max_pool2d(best, near, near // 2)


def draw_prototypes(crops, count, rng):
    """Patches (count, 4, SCALE, SCALE) of C1 maps, from random crops, bands and places."""
    bands = list(c1(crops))
    drawn = []
    for _ in range(count):
        maps = bands[rng.integers(len(bands))]
        y, x = rng.integers(0, np.array(maps.shape[2:]) - SCALE + 1)
        drawn.append(maps[rng.integers(len(maps)), :, y : y + SCALE, x : x + SCALE])
    return torch.stack(drawn).numpy()


def hmax(crops, prototypes):
    """C2 features (n, prototypes): 1 where a crop holds a prototype exactly, towards 0 if not."""
    prototypes = torch.tensor(prototypes)
    return torch.cat([c2(few, prototypes) for few in torch.as_tensor(crops).split(2)]).numpy()


def c2(crops, prototypes):
    """`hmax` of a few crops, few enough for their maps to stay in the processor's cache."""
    best = []
    for maps in c1(crops):
        power = F.avg_pool2d((maps**2).sum(1, keepdim=True), SCALE, 1) * SCALE**2
        match = F.conv2d(maps, prototypes)
        far = power - 2 * match + prototypes.square().sum((1, 2, 3))[:, None, None]
        best.append(far.amin((2, 3)))
    return torch.exp(-torch.stack(best).amin(0).clamp(min=0) / 2)
