"""Figures of aiming: a target that the reader drags, in a photo or seen from above."""

from functools import cache

import numpy as np

from book.figures.loop import AHEAD, above
from page.arm.live import KINEMATICS
from vmc_lib import NoReach
from vmc_lib.arm.kinematics import ON_AXIS, TRUNK, TRUNK_RANGE, to_world, turn_towards
from vmc_lib.show import Pad
from vmc_lib.show.figures import photo_view
from vmc_lib.show.markup import minus
from vmc_lib.show.palette import COLOURS, EDGE, ON_PHOTO

AWAY = np.linspace(0.2, 0.45, 201)  # m from the trunk's axis: no hand reaches the table beyond


def aim_view(photo, pixel=None):
    """A photo with a target at `pixel` (2,), and from above the place that it means; or neither.

    The place lies as high as the photo's own shuttlecock. Where the hand can be there is shaded.
    """
    corners = [(x, y) for x in (0, 600) for y in (0, 400)]
    eye = photo.camera.position
    parts = [([eye], "^", "blue", "eye"), ([ON_AXIS], "s", "purple", "trunk's axis")]
    if pixel is not None:
        place = target_place(photo, pixel)
        turn = trunk_turn(place)
        colour = "green" if turn is not None else "red"
        parts += [([eye, place], "-", "blue", ""), ([place], "o", colour, "")]
        if turn is not None:
            parts += [([ON_AXIS, to_world([0, 0, 0], turn)], "-", "purple", "")]
            parts += [(to_world(AHEAD, turn), "-", "grey", "")]
    view = photo_view(photo.image, points=[] if pixel is None else [(pixel, "", colour)])
    x, _, z = np.transpose([*photo.camera.back_project(corners, photo.target[1]), eye, ON_AXIS])
    limits = [(low - 0.05, high + 0.05) for low, high in ((z.min(), z.max()), (x.min(), x.max()))]
    fig = above(parts, " " if pixel is None else distance_and_turn(photo, pixel), *limits)
    fig.axes[0].fill(*shore(photo.target[1]), color=COLOURS["green"], alpha=0.12, lw=0)
    return view, fig


def shore(height):
    """Round all that the hand can reach at a height, seen from above (2, n): right, ahead."""
    away, turns = np.transpose(within_reach(height))
    right, left = (turns - end for end in TRUNK_RANGE)  # bearings, at either end of the range
    far = np.linspace(left[-1], right[-1], len(away))
    near = np.linspace(right[0], left[0], len(away))
    bearing = np.concatenate([left, far, right[::-1], near])
    radius = np.concatenate([away, 0 * far + away[-1], away[::-1], 0 * near + away[0]])
    return radius * [np.sin(bearing), np.cos(bearing)] + TRUNK[::-1, None]


@cache
def within_reach(height):
    """Distances from the trunk's axis (m) at which the hand can be, and its turn (rad) for each.

    The turn is for a place straight ahead of the axis.
    """
    turns = [(away, trunk_turn((TRUNK[0] + away, height, TRUNK[1]))) for away in AWAY]
    return [(away, round(turn, 5)) for away, turn in turns if turn is not None]


def target_place(photo, pixel):
    """Where the line of sight through a pixel meets the height of the photo's shuttlecock (3,)."""
    return photo.camera.back_project(pixel, photo.target[1])[0]


def trunk_turn(place):
    """The trunk's turn (rad) that brings the hand's plane to a place (3,); None out of reach."""
    try:
        return turn_towards(place)[0]
    except NoReach:
        return None


def describe_aim(photo, pixel):
    """The place that a pixel means, and the trunk's turn, in words."""
    ahead, _, right = 100 * target_place(photo, pixel)
    way, side = "ahead" if ahead > 0 else "behind", "right" if right > 0 else "left"
    where = f"{abs(ahead):.0f} cm {way}, {abs(right):.0f} cm {side}"
    return f"{where}; {distance_and_turn(photo, pixel)}"


def distance_and_turn(photo, pixel):
    """How far from the trunk's axis a pixel's place lies, and the trunk's turn, in words."""
    place = target_place(photo, pixel)
    turn = trunk_turn(place)
    trunk = "out of reach" if turn is None else f"the trunk turns {np.degrees(turn):z.0f}°"
    away = 100 * np.hypot(*(place[[0, 2]] - TRUNK))
    return minus(f"{away:.0f} cm from the axis: {trunk}")


def aim_in_page(photo):
    """The same for the page to work out (see `explore`)."""
    camera, height = photo.camera, photo.target[1]
    given = {
        "camera": {name: np.asarray(value).tolist() for name, value in vars(camera).items()},
        "arm": KINEMATICS,
        "marks": {"height": height, "ahead": AHEAD, "edge": EDGE, "paint": ON_PHOTO},
    }
    return "aim", lambda: aim_view(photo), given


def pad(photo):
    """Where a photo's target may be dragged, from its shuttlecock on."""
    [at] = photo.camera.project(photo.target)
    start = 2 * np.round(at / 2)
    return Pad(range(20, 581, 2), range(20, 381, 2), ("across", "down"), tuple(start), "pixels")
