"""Pinhole camera: projection, and back-projection of pixels onto a horizontal plane.

A pixel (column i, row j) covers the square [i, i + 1) × [j, j + 1): boxes and projections share
these coordinates, so a whole photo is the box (0, 0, 600, 400).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib import NoReach
from vmc_lib.boxes import as_boxes
from vmc_lib.checks import as_numbers
from vmc_lib.short_repr import short, short_repr

TABLE = -0.43  # height of the table top in the shoulder frame (m)


@dataclass(frozen=True, eq=False)
class Camera:
    """A pinhole camera without distortion, in OpenCV's axes (x right, y down, z forward).

    focal: focal length (pixels); centre: principal point (2,) (pixels); rotation: (3, 3), whose
    rows are the camera's axes in the shoulder frame; position: (3,) in the shoulder frame (m).
    """

    focal: float
    centre: np.ndarray
    rotation: np.ndarray
    position: np.ndarray

    __repr__ = short_repr

    def __post_init__(self) -> None:
        shapes = {"focal": (), "centre": (2,), "rotation": (3, 3), "position": (3,)}
        for name, shape in shapes.items():
            given = getattr(self, name)
            if as_numbers(name, given).shape != shape:
                raise ValueError(f"a camera's {name} {short(given)}: give numbers, {shape}")
            if shape:
                object.__setattr__(self, name, np.asarray(given))

    def project(self, points: ArrayLike) -> np.ndarray:
        """Project points (n, 3) of the shoulder frame to pixels (n, 2).

        Raises ValueError for a point that is not in front of the camera, and for other shapes.
        """
        x = (_rows("points", points, 3) - self.position) @ self.rotation.T
        if not np.all(x[:, 2] > 0):  # or it is no number
            raise ValueError("a point behind the camera has no picture: give points it faces")
        return self.focal * x[:, :2] / x[:, 2:] + self.centre

    def rays(self, pixels: ArrayLike) -> np.ndarray:
        """Ray directions (n, 3), in the shoulder frame, through pixels (n, 2); their depth is 1.

        Raises ValueError for other shapes.
        """
        x = (_rows("pixels", pixels, 2) - self.centre) / self.focal
        return np.column_stack([x, np.ones(len(x))]) @ self.rotation

    def back_project(self, pixels: ArrayLike, height: float = TABLE) -> np.ndarray:
        """Back-project pixels (n, 2) to the points (n, 3) on their rays with y = height.

        Raises `NoReach` where a ray runs level with the plane or away from it.
        """
        rays, depth = self._intersect(pixels, as_numbers("height", height))
        if not np.all(np.isfinite(depth) & (depth > 0)):
            raise NoReach(
                f"a ray from the camera at {np.round(self.position, 3)} never meets the plane "
                f"y = {height}: give pixels below the horizon"
            )
        return self.position + depth[:, None] * rays

    def _intersect(self, pixels, height):
        """Rays (n, 3) through pixels (n, 2), and the depths (n,) at which they have y = height."""
        rays = self.rays(pixels)
        with np.errstate(divide="ignore", invalid="ignore"):
            return rays, (height - self.position[1]) / rays[:, 1]

    def sizes(self, boxes: ArrayLike) -> np.ndarray:
        """Physical size of the objects in boxes (n, 4), if they stand on the table: (n,), m.

        The root of the area that each covers in a plane that faces the camera; inf for what stands
        beyond the horizon.
        """
        x0, y0, x1, y1 = as_boxes(boxes).T
        _, depth = self._intersect(np.column_stack([(x0 + x1) / 2, y1]), TABLE)  # of its foot
        pixels = np.sqrt((x1 - x0) * (y1 - y0))
        return np.where(depth > 0, pixels * depth / self.focal, np.inf)


def _rows(name, values, size):
    """Values as an array (n, size)."""
    rows = np.atleast_2d(as_numbers(name, values))
    if rows.ndim != 2 or rows.shape[1] != size:
        raise ValueError(f"{name} of shape {np.shape(values)}: give (n, {size})")
    return rows
