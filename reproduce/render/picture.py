"""Path tracing: a scene's photo, and the exact pixels of each visible thing."""

import cv2
import mitsuba as mi
import numpy as np

mi.set_variant("llvm_ad_rgb")

from reproduce.render.materials import SPAN  # noqa: E402
from reproduce.render.scene import MIDDLE  # noqa: E402
from vmc_lib.camera import TABLE  # noqa: E402
from vmc_lib.photos import CLASSES, HEIGHT, WIDTH  # noqa: E402

DAYLIGHT = 2.8  # irradiance of the table by the window


def surface(colour, roughness):
    """A plastic-like material, the same from both sides."""
    coat = {"type": "principled", "base_color": colour, "roughness": roughness, "specular": 0.5}
    return {"type": "twosided", "material": coat}


def solid(mesh):
    """The mesh as Mitsuba knows it."""
    colour = {"type": "mesh_attribute", "name": "vertex_color"}
    properties = mi.Properties()
    properties["material"] = mi.load_dict(surface(colour, mesh.roughness))
    shape = mi.Mesh("mesh", len(mesh.vertices), len(mesh.faces), properties, True)
    shape.add_attribute("vertex_color", 3, mesh.colours.astype(np.float32).ravel())
    parameters = mi.traverse(shape)
    parameters["vertex_positions"] = mesh.vertices.astype(np.float32).ravel()
    parameters["vertex_normals"] = mesh.normals().astype(np.float32).ravel()
    parameters["faces"] = mesh.faces.astype(np.uint32).ravel()
    parameters.update()
    return shape


def stage(scene):
    """The Mitsuba scene: things, table, window and room."""
    frame = mi.ScalarTransform4f
    ground = np.array([MIDDLE[0], TABLE, MIDDLE[2]])
    light = scene.light
    window = ground + 1.4 * light.direction
    radiance = DAYLIGHT * 1.4**2 / light.size**2 / light.direction[1] * light.colour
    texture = mi.Bitmap(scene.table.astype(np.float32))
    grain = {"type": "bitmap", "bitmap": texture, "raw": True}
    camera = scene.camera
    ahead = camera.position + camera.rotation[2]
    return mi.load_dict({
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 6, "hide_emitters": True},
        "room": {"type": "constant", "radiance": {"type": "rgb", "value": light.fill.tolist()}},
        "window": {
            "type": "rectangle",
            "to_world": frame().look_at(window.tolist(), ground.tolist(), [0.1, 0.2, 1])
            @ frame().scale(light.size / 2),
            "emitter": {"type": "area", "radiance": {"type": "rgb", "value": radiance.tolist()}},
        },
        "table": {
            "type": "rectangle",
            "to_world": frame().translate(ground.tolist())
            @ frame().rotate([1, 0, 0], -90)
            @ frame().scale(SPAN / 2),
            "material": surface(grain, scene.gloss),
        },
        "eye": {
            "type": "perspective",
            "fov": float(np.degrees(2 * np.arctan(WIDTH / 2 / camera.focal))),
            "fov_axis": "x",
            "to_world": frame().look_at(
                camera.position.tolist(), ahead.tolist(), (-camera.rotation[1]).tolist()
            ),
            "film": {"type": "hdrfilm", "width": WIDTH, "height": HEIGHT, "pixel_format": "rgb"},
            "sampler": {"type": "multijitter"},
        },
        **{name: solid(mesh) for name, mesh in scene.things.items()},
    })  # fmt: skip


def develop(light):
    """Linear light as sRGB bytes; above .7 highlights roll off softly, as on film."""
    soft = np.where(light < 0.7, light, 0.7 + 0.3 * np.tanh((light - 0.7) / 0.3))
    srgb = np.where(soft < 0.0031308, 12.92 * soft, 1.055 * soft ** (1 / 2.4) - 0.055)
    return np.round(255 * np.clip(srgb, 0, 1)).astype(np.uint8)


def visible_masks(solids, camera):
    """Masks (400, 600) by name: where the ray through a pixel's middle meets each thing first."""
    j, i = np.mgrid[0:HEIGHT, 0:WIDTH].reshape(2, -1) + 0.5
    rays = camera.rays(np.column_stack([i, j])).astype(np.float32).T
    origin = mi.Point3f(camera.position.astype(np.float32))
    hit = mi.load_dict({"type": "scene", **solids}).ray_intersect_preliminary(
        mi.Ray3f(origin, mi.Vector3f(rays))
    )
    return {
        name: np.array(hit.is_valid() & (hit.shape == mi.ShapePtr(shape))).reshape(HEIGHT, WIDTH)
        for name, shape in solids.items()
    }


def masks(scene):
    """For shuttlecock and cup, (whole, visible): its mask alone, and with all things there."""
    solids = {name: solid(mesh) for name, mesh in scene.things.items()}
    visible = visible_masks(solids, scene.camera)
    return {
        name: (visible_masks({name: solids[name]}, scene.camera)[name], visible[name])
        for name in CLASSES
    }


def take(scene, samples, seed):
    """The photo (400, 600, 3) uint8 of a scene, from so many light paths a pixel."""
    world = stage(scene)
    light = np.array(mi.render(world, spp=samples, seed=seed))
    guides = mi.load_dict({"type": "aov", "aovs": "albedo:albedo,normal:sh_normal"})
    guides = np.array(mi.render(world, integrator=guides, spp=16, seed=seed))
    albedo, normals = guides[..., :3] + 0.02, guides[..., 3:]
    return develop(albedo * smooth(light / albedo, normals))


def smooth(shade, normals):
    """Remove the noise of few light paths from the shading (h, w, 3): a joint bilateral filter.

    A neighbour counts the less, the more its normal and its (median) shade differ. Without the
    colour of things there is no fine texture to lose. Paths far brighter than around are clipped.
    """
    radius, median = 3, cv2.medianBlur(shade, 5)
    guide = np.dstack([3 * normals, 2 * np.log(median.mean(axis=2) + 0.02)])
    counted = np.dstack([np.minimum(shade, 2 * median + 0.05), np.ones_like(shade[..., :1])])
    pad = ((radius, radius), (radius, radius), (0, 0))
    guides, shades = np.pad(guide, pad, "edge"), np.pad(counted, pad, "edge")
    total = np.zeros_like(counted)
    for i, j in np.ndindex(2 * radius + 1, 2 * radius + 1):
        window = np.s_[i : i + HEIGHT, j : j + WIDTH]
        unlike = guides[window] - guide
        far = ((i - radius) ** 2 + (j - radius) ** 2) / 8
        weight = np.exp(-np.einsum("ijk,ijk->ij", unlike, unlike) - far)
        total += weight[..., None] * shades[window]
    return total[..., :3] / total[..., 3:]
