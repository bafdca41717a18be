"""F1/F0 of drifting gratings: are a CRBM's units simple or complex cells?

F0 is the mean of an answer over time, F1 how far it swings in the rhythm of the stripes: above 1
for a simple cell, below 1 for a complex one (Skottun et al. 1991).
"""

from itertools import product

import numpy as np
import torch

WIDTH, PHASES = 21, 16  # pixels, steps of a period
FREQUENCIES = 2.0 ** np.arange(-4, -1.2, 0.25)  # cycles a pixel
ANGLES = np.radians(np.arange(0, 180, 10))


def answers(crbm, contrast, frequency, angle):
    """F0 and F1 (2, 2 K) of the hidden units and the pooled units in the middle of a grating."""
    phases = 2 * torch.pi * torch.arange(PHASES)[:, None, None] / PHASES
    y, x = torch.meshgrid(*[torch.arange(float(WIDTH))] * 2, indexing="ij")
    along = x * np.cos(angle) + y * np.sin(angle)
    stripes = torch.cos(2 * torch.pi * frequency * along - phases)[:, None]
    maps = crbm.posterior(contrast * 2**0.5 * stripes)
    middle = [m[:, :, m.shape[2] // 2, m.shape[3] // 2] for m in maps]
    waves = abs(torch.fft.rfft(torch.cat(middle, 1), dim=0)[:2])
    return waves * torch.tensor([1, 2])[:, None]


def modulation(crbm, contrast):
    """Median F1/F0 of the hidden and of the pooled units, each at its best grating.

    `contrast` is the standard deviation of a grating.
    """
    gratings = product(FREQUENCIES, ANGLES)
    found = torch.stack([answers(crbm, contrast, *grating) for grating in gratings], 1)
    best = found.amax(0).argmax(0)[None]
    f0, f1 = (part.gather(0, best)[0] for part in found)
    return np.median((f1 / f0).reshape(2, -1), 1).tolist()
