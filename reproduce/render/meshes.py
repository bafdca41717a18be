"""Triangle meshes: grids of points, lathed profiles, tubes and blocks; metres, y up."""

from dataclasses import dataclass, replace

import numpy as np


@dataclass(frozen=True)
class Mesh:
    """Triangles: vertices (n, 3), faces (m, 3), and linear RGB colours (n, 3)."""

    vertices: np.ndarray
    faces: np.ndarray
    colours: np.ndarray
    roughness: float = 0.5

    def move(self, rotation=None, shift=(0, 0, 0)):
        """The same mesh, turned by `rotation` (3, 3) and then shifted."""
        turned = self.vertices if rotation is None else self.vertices @ rotation.T
        return replace(self, vertices=turned + shift)

    def on_table(self):
        """The same mesh, lowered or raised until it rests on y = 0."""
        return self.move(shift=(0, -self.vertices[:, 1].min(), 0))

    def normals(self):
        """Unit normals (n, 3): the mean over a vertex's faces, weighted by their areas."""
        a, b, c = self.vertices[self.faces].transpose(1, 0, 2)
        normals = np.zeros_like(self.vertices)
        for corner in self.faces.T:
            np.add.at(normals, corner, np.cross(b - a, c - a))
        return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)


def join(*meshes):
    """One mesh out of many; it keeps the first one's roughness."""
    triangles = join_triangles([(mesh.vertices, mesh.faces) for mesh in meshes])
    colours = np.concatenate([mesh.colours for mesh in meshes])
    return Mesh(*triangles, colours, meshes[0].roughness)


def join_triangles(pairs):
    """Vertices (n, 3) and faces (m, 3) of one mesh out of those of many."""
    vertices, faces = zip(*pairs, strict=True)
    starts = np.cumsum([0, *map(len, vertices[:-1])])
    shifted = [each + start for each, start in zip(faces, starts, strict=True)]
    return np.concatenate(vertices), np.concatenate(shifted)


def rotation(axis, angle):
    """The rotation (3, 3) by `angle` about coordinate axis 0, 1 or 2."""
    c, s = np.cos(angle), np.sin(angle)
    turn = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    turn[[i, i, j, j], [i, j, i, j]] = c, -s, s, c
    return turn


def grid_mesh(points, colour, roughness=0.5):
    """A grid of points (rows, columns, 3) as a surface; `colour` is one, one a row or a point."""
    rows, columns, _ = points.shape
    corner = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]
    faces = np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)
    colour = np.asarray(colour, float)
    colours = np.broadcast_to(colour[:, None] if colour.ndim == 2 else colour, points.shape)
    return Mesh(points.reshape(-1, 3), faces, colours.reshape(-1, 3), roughness)


def lathe(profile, colour, roughness=0.3, sides=64):
    """The profile (n, 2) of (radius, height) turned about the vertical, from the bottom up.

    A corner is sharp when its point stands twice in the profile.
    """
    radius, height = np.array(profile, float).T[:, :, None]
    angle = np.linspace(0, 2 * np.pi, sides + 1)
    points = np.broadcast_arrays(radius * np.cos(angle), height, radius * np.sin(angle))
    return grid_mesh(np.stack(points, axis=-1), colour, roughness)


def tube(path, radius, colour, roughness=0.5, sides=12):
    """A tube about the path (n, 3); its radius is one number or one per point of the path."""
    path = np.asarray(path, float)
    along = np.gradient(path, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    reference = np.eye(3)[np.argmin(np.abs(along).max(axis=0))]
    side = np.cross(along, reference)
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    up = np.cross(side, along)
    angle = np.linspace(0, 2 * np.pi, sides + 1)[None, :, None]
    ring = np.cos(angle) * side[:, None] + np.sin(angle) * up[:, None]
    radius = np.broadcast_to(radius, len(path))[:, None, None]
    return grid_mesh(path[:, None] + radius * ring, colour, roughness)


def slab(size, colour, roughness=0.5, low=0.0):
    """A block of `size` (x, y, z) with sharp edges, centred on the vertical, from y = low up."""
    faces = []
    for axis in range(3):
        for sign in (-1, 1):
            quad = np.full((2, 2, 3), sign, float)
            quad[..., (axis + 1) % 3] = [[-1, -1], [1, 1]]
            quad[..., (axis + 2) % 3] = [[-1, 1], [-1, 1]]
            faces.append(grid_mesh(quad * np.array(size) / 2, colour, roughness))
    return join(*faces).move(shift=(0, low + size[1] / 2, 0))
