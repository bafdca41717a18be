"""Scenes by another renderer: `python -m reproduce.render.elsewhere FOLDER` (needs vtk).

The shuttlecock's shape is that of the other photos; cups, tables and lights are of `furniture`. VTK
paints triangle by triangle, without bounced light; nine lamps in turn soften the shadows.
"""

import argparse
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

from reproduce.render import furniture, meshes, scene
from reproduce.render.materials import SPAN
from reproduce.render.sidecar import store
from vmc_lib.camera import TABLE
from vmc_lib.photos import CLASSES, HEIGHT, SPLITS, WIDTH

COUNT, LAMPS = 160, 9  # photos; pictures that one is the mean of


def solid(mesh):
    """A thing as VTK knows it; the rougher, the weaker its highlight."""
    cells, points, surface = vtk.vtkCellArray(), vtk.vtkPoints(), vtk.vtkPolyData()
    corners = np.insert(mesh.faces, 0, 3, axis=1).astype(np.int64).ravel()
    cells.ImportLegacyFormat(numpy_to_vtkIdTypeArray(corners, deep=True))
    points.SetData(numpy_to_vtk(mesh.vertices, deep=True))
    surface.SetPoints(points)
    surface.SetPolys(cells)
    srgb = np.uint8(255 * np.clip(mesh.colours, 0, 1) ** (1 / 2.2) + 0.5)
    surface.GetPointData().SetNormals(numpy_to_vtk(mesh.normals(), deep=True))
    surface.GetPointData().SetScalars(numpy_to_vtk(srgb, deep=True))
    mapper, one = vtk.vtkPolyDataMapper(), vtk.vtkActor()
    mapper.SetInputData(surface)
    one.SetMapper(mapper)
    one.GetProperty().SetSpecular(0.5 * (1 - mesh.roughness))
    one.GetProperty().SetSpecularPower(30)
    return one


def table_top(texture):
    """The table: a surface whose vertices, one every 3 mm, have the texture's colours."""
    colours = texture[::3, ::3]
    x, z = (scene.MIDDLE[k] + np.linspace(-SPAN / 2, SPAN / 2, len(colours)) for k in (0, 2))
    return meshes.grid_mesh(np.dstack(np.broadcast_arrays(x, TABLE, z[:, None])), colours, 0.8)


def stage(actors, camera):
    """A window onto what is painted, and the painter in it."""
    painter, window = vtk.vtkRenderer(), vtk.vtkRenderWindow()
    for one in actors:
        painter.AddActor(one)
    eye = painter.GetActiveCamera()
    eye.SetPosition(*camera.position)
    eye.SetFocalPoint(*(camera.position + camera.rotation[2]))
    eye.SetViewUp(*-camera.rotation[1])
    eye.SetViewAngle(np.degrees(2 * np.arctan(HEIGHT / 2 / camera.focal)))
    painter.ResetCameraClippingRange()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(WIDTH, HEIGHT)
    window.AddRenderer(painter)
    return window, painter


def shot(window):
    """What a window shows: (400, 600, 3) uint8."""
    window.Render()
    taken = vtk.vtkWindowToImageFilter()
    taken.SetInput(window)
    taken.ReadFrontBufferOff()
    taken.Update()
    pixels = vtk_to_numpy(taken.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(HEIGHT, WIDTH, 3)[::-1]


def take(drawn, rng):
    """The photo (400, 600, 3) uint8 of a scene: the mean of a picture for each lamp."""
    things = [*map(solid, (table_top(drawn.table), *drawn.things.values()))]
    window, painter = stage(things, drawn.camera)
    painter.UseShadowsOn()
    light, ground = drawn.light, scene.MIDDLE * [1, 0, 1] + [0, TABLE, 0]
    for one in things:
        one.GetProperty().SetAmbient(1.6 * light.fill.mean())
        one.GetProperty().SetDiffuse(0.75)
    lamp = vtk.vtkLight()
    lamp.SetPositional(True)
    lamp.SetConeAngle(40)
    lamp.SetColor(*np.minimum(light.colour, 1))
    lamp.SetFocalPoint(*ground)
    painter.AddLight(lamp)
    pictures = []
    for aside in light.size * rng.uniform(-0.5, 0.5, (LAMPS, 3)):
        lamp.SetPosition(*(ground + 1.4 * light.direction + aside))
        within = rng.uniform(-1, 1, 2) / [WIDTH, HEIGHT]  # half a pixel: smooth edges
        painter.GetActiveCamera().SetWindowCenter(*within)
        pictures.append(shot(window))
    return np.uint8(np.mean(pictures, axis=0) + 0.5)


def masks(drawn):
    """For shuttlecock and cup, (whole, visible): its mask alone, and with all things there."""

    def mask(name, group):
        flat = [
            solid(replace(mesh, colours=np.full_like(mesh.vertices, other == name)))
            for other, mesh in group.items()
        ]
        for one in flat:
            one.GetProperty().LightingOff()
        return shot(stage(flat, drawn.camera)[0])[..., 0] > 127

    things = drawn.things
    return {name: (mask(name, {name: things[name]}), mask(name, things)) for name in CLASSES}


def main():
    """Paint the photos into a folder, as photos of `varied`."""
    parser = argparse.ArgumentParser(
        prog="python -m reproduce.render.elsewhere", description=__doc__
    )
    parser.add_argument("folder", type=Path)
    parser.add_argument("--split", choices=SPLITS, default="test")
    parser.add_argument("--first", type=int, default=0, help="the number of the first photo")
    parser.add_argument("--count", type=int, default=COUNT)
    arguments = parser.parse_args()
    for number in range(arguments.first, arguments.first + arguments.count):
        seed = (4, SPLITS.index(arguments.split), number)  # a level of its own
        rng = np.random.default_rng(seed)
        draw = partial(scene.draw, "varied", rng, furniture.setting)
        drawn, boxes = scene.draw_in_full_view(draw, masks)
        path = arguments.folder / f"varied/{arguments.split}/{number:03d}.jpg"
        store(path, take(drawn, rng), drawn, boxes, seed)


if __name__ == "__main__":
    main()
