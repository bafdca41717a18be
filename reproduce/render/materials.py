"""Table tops, painted from noise: linear RGB textures, one texel a millimetre."""

import cv2
import numpy as np

SIZE = 2048
SPAN = SIZE / 1000  # m: side of the table


def rgb(code):
    """Linear RGB (3,) of an sRGB colour written as "#rrggbb"."""
    value = np.array([int(code[k : k + 2], 16) for k in (1, 3, 5)]) / 255
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)


def noise(rng, along, across):
    """Smooth noise (SIZE, SIZE) of unit variance, with `along` × `across` bumps."""
    coarse = rng.standard_normal((across, along)).astype(np.float32)
    smooth = cv2.resize(coarse, (SIZE, SIZE), interpolation=cv2.INTER_CUBIC)
    return smooth / smooth.std()


def cloud(rng, bumps, octaves=5):
    """Noise at `bumps` and finer scales, each half as strong as the one before."""
    return sum(0.5**k * noise(rng, bumps << k, bumps << k) for k in range(octaves))


def blend(low, high, weight):
    """Between the colours `low` and `high`, by weight (h, w) in 0..1."""
    weight = np.clip(weight, 0, 1)[..., None]
    return low + weight * (high - low)


def wood(rng, light, dark):
    """Planks sawn from a trunk: year rings, cut aslant, with fibres and pores along the grain."""
    planks = 12
    v, u = np.mgrid[0:SIZE, 0:SIZE].astype(np.float32) / SIZE
    plank = np.minimum((v * planks).astype(int), planks - 1)
    heart, depth = rng.uniform(-0.1, 0.1, planks), rng.uniform(0.05, 0.4, planks)
    lift = rng.uniform(-0.25, 0.25, planks)
    shift = rng.integers(0, SIZE, planks)[plank[:, 0]]
    sway = noise(rng, 10, 60) * 0.006 + noise(rng, 40, 250) * 0.0012
    sway = np.take_along_axis(sway, (np.arange(SIZE)[None] + shift[:, None]) % SIZE, axis=1)
    side = (v * planks) % 1 / planks - 0.5 / planks + heart[plank] / 2
    radius = np.hypot(side + sway, depth[plank] * 0.3 + lift[plank] * (u - 0.5) * 0.25)
    ring = radius * 210 % 1
    late = np.clip(ring, 0, 1) ** 3 * (ring < 0.96)  # dark late wood ends each year sharply
    fibre = noise(rng, 60, SIZE) * 0.09 + noise(rng, 12, 700) * 0.08
    pores = (noise(rng, 140, SIZE) > 2.1) * 0.35
    tone = rng.normal(0, 0.1, planks)[plank]
    seam = np.abs((v * planks + 0.5) % 1 - 0.5) * SIZE / planks < 0.8
    grain = blend(light, dark, 0.15 + 0.6 * late + fibre + pores + tone)
    return grain * np.where(seam & (plank > 0), 0.35, 1)[..., None]


def cloth(rng, light, dark):
    """A woven cloth, plain, striped or chequered, with threads of uneven weight."""
    v, u = np.mgrid[0:SIZE, 0:SIZE]
    warp, weft = np.stack([u, v]) // rng.integers(24, 90) % 2
    pattern = [0 * u, warp, (warp + weft) / 2][rng.integers(3)]
    weave = np.where((u // 2 + v // 2) % 2, noise(rng, SIZE, 40), noise(rng, 40, SIZE))
    uneven = 1 + 0.09 * weave + 0.03 * cloud(rng, 6)
    return blend(light, dark, 0.02 + 0.96 * pattern) * uneven[..., None]


def stone(rng, light, dark):
    """Polished stone: clouds, speckles and a few veins."""
    veins = np.exp(-((cloud(rng, 4, 6) * 9) ** 2)) * rng.uniform(0, 0.9)
    speckle = 0.22 * noise(rng, 600, 600) + 0.12 * noise(rng, SIZE, SIZE)
    return blend(light, dark, 0.3 + 0.14 * cloud(rng, 8) + speckle * rng.uniform(0.1, 1) + veins)


def plain(rng, light, dark):
    """A painted or laminated board, hardly uneven."""
    return blend(light, dark, 0.12 + 0.03 * cloud(rng, 5))
