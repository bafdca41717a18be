"""Cut-outs of shuttlecocks and decoys: `python -m reproduce.render.cutouts` (needs mitsuba).

Feathered and nylon ones, new and worn, of several colours, and things that resemble them, turned
any way, near and far, in any light, on nothing. `reproduce.training.pasting` lays them on
photographs.
"""

import argparse
from dataclasses import replace

import mitsuba as mi
import numpy as np

mi.set_variant("llvm_ad_rgb")

from reproduce.render import cutout_atlas, decoys, scene, shuttlecocks  # noqa: E402
from reproduce.render.materials import rgb  # noqa: E402
from reproduce.render.picture import develop, solid  # noqa: E402
from reproduce.render.scene import GLAZES  # noqa: E402

SAMPLES = 64
COUNTS = {"shuttlecocks": 480, "decoys": 320}
DYES = "#d3f000 #d3f000 #e8f53a #f4f4ee #f4f4ee #a8e04a #ff8a2a #f28fb0".split()


def random_shuttlecock(rng, _number):
    """A shuttlecock (a Mesh) whose middle is the origin, as it may lie, stand, fly or be held."""
    feathered = rng.random() < 0.5
    one = (
        shuttlecocks.worn_shuttlecock(rng)
        if feathered
        else shuttlecocks.nylon(rng, rgb(rng.choice(DYES)))
    )
    return one.move(shift=(0, -shuttlecocks.LENGTH / 2, 0)).move(random_rotation(rng))


def random_decoy(rng, number):
    """A decoy (a Mesh) as large as a shuttlecock, its middle the origin; the last are held out."""
    untrained = number >= COUNTS["decoys"] - cutout_atlas.UNTRAINED_COUNT
    kinds = decoys.HELD_OUT_KINDS if untrained else decoys.TRAINING_KINDS
    colour = rgb(rng.choice(2 * DYES + GLAZES))
    one = kinds[rng.integers(len(kinds))](rng, colour)
    low, high = one.vertices.min(0), one.vertices.max(0)
    centred = one.move(shift=-(low + high) / 2)
    scale = shuttlecocks.LENGTH / (high - low).max()
    return replace(centred, vertices=scale * centred.vertices).move(random_rotation(rng))


def random_rotation(rng):
    """A uniformly random rotation (3, 3)."""
    turn, _ = np.linalg.qr(rng.standard_normal((3, 3)))
    turn *= np.linalg.det(turn)  # no mirror
    return turn


def take(mesh, rng):
    """A Mesh as a cut-out (WIDTH, WIDTH, 4) uint8: colour and opacity."""
    frame, size = mi.ScalarTransform4f, cutout_atlas.WIDTH
    eye = np.array([0, 0, rng.uniform(0.15, 0.9)])
    wide = 1.05 * 2 * np.abs(mesh.vertices[:, :2] / (eye[2] - mesh.vertices[:, 2:])).max()
    lamp = scene.light_from(
        rng.uniform(-0.5, 1.5), rng.uniform(0, 2 * np.pi), rng.uniform(0.1, 1.5),
        rng.uniform(-1, 1), rng.uniform(0.1, 0.9),
    )  # fmt: skip
    radiance = rng.uniform(0.5, 4) / lamp.size**2 * lamp.colour
    world = mi.load_dict({
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 6, "hide_emitters": True},
        "room": {"type": "constant", "radiance": {"type": "rgb", "value": lamp.fill.tolist()}},
        "window": {
            "type": "rectangle",
            "to_world": frame().look_at(lamp.direction.tolist(), [0, 0, 0], [0.1, 0.2, 1])
            @ frame().scale(lamp.size / 2),
            "emitter": {"type": "area", "radiance": {"type": "rgb", "value": radiance.tolist()}},
        },
        "eye": {
            "type": "perspective",
            "fov": float(np.degrees(2 * np.arctan(wide / 2))),
            "to_world": frame().look_at(eye.tolist(), [0, 0, 0], [0, 1, 0]),
            "film": {"type": "hdrfilm", "width": size, "height": size, "pixel_format": "rgba"},
            "sampler": {"type": "multijitter"},
        },
        "it": solid(mesh),
    })  # fmt: skip
    light = np.array(mi.render(world, spp=SAMPLES, seed=int(rng.integers(2**31))))
    alpha = light[..., 3:].clip(0, 1)
    colour = light[..., :3] / np.maximum(alpha, 1e-3)
    return np.dstack(
        [
            develop(colour / max(1, np.quantile(colour[alpha[..., 0] > 0.5], 0.95))),
            np.uint8(255 * alpha + 0.5),
        ]
    )


MAKERS = {"shuttlecocks": random_shuttlecock, "decoys": random_decoy}


def main():
    """Render the cut-outs that ship."""
    parser = argparse.ArgumentParser(prog="python -m reproduce.render.cutouts", description=__doc__)
    parser.add_argument("kind", choices=MAKERS)
    kind, images = parser.parse_args().kind, []
    for number in range(COUNTS[kind]):
        rng = np.random.default_rng((5 + list(MAKERS).index(kind), number))
        images.append(take(MAKERS[kind](rng, number), rng))
    cutout_atlas.store(images, kind)


if __name__ == "__main__":
    main()
