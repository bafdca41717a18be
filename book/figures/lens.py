"""A magnifier in a photo's corner: the target, the true place and the end point, from the side."""

import numpy as np

from vmc_lib.arm.kinematics import rotate_by_turn, to_world
from vmc_lib.show.palette import ON_PHOTO

RADIUS, MOST = 104, 5.0  # pixels; pixels a mm, at most: less where a mark would lie outside
LONG = 0.7 * RADIUS  # pixels from the middle, where marks still lie inside


def lens(photo, box, reach, motion=None):
    """What lies round the target of a reach, in the arm's plane: SVG for a photo of 600 × 400.

    A ring at the place seen, a cross at the true one; after a motion a dot where the hand ends and
    its way over the hold, beside the end of the first reach, dashed.
    """
    along = rotate_by_turn([1.0, 0, 0], reach.turn)

    def flat(places):
        away = 1000 * (np.atleast_2d(places) - reach.target)
        return np.column_stack([away @ along, -away[:, 1]])

    motions = [] if motion is None else [reach.planned, motion]
    [true, *ends] = flat([photo.target, *map(reach.endpoint, motions)])
    scale = LONG / max(LONG / MOST, np.abs([true, *ends]).max())
    x, y = _corner(box)
    parts = [f'<circle r="{RADIUS}" fill="#10151c" fill-opacity=".85" stroke="none"/>']
    if motions:
        way = scale * flat(to_world(motion.wrist[::5], reach.turn))
        first, last = scale * np.array(ends)
        if motion is not reach.planned:
            parts += [_line([[0, 0], first], "grey", dashed=True), _circle(first, 7, "grey")]
        parts += [_line(way, "orange"), _line([[0, 0], last], "red"), _circle(last, 6, "red", True)]
    parts += [_line(scale * true + np.outer([-8, 8], way), "ink") for way in ([1, 1], [1, -1])]
    parts += [_circle([0, 0], 10, "green"), _bar(scale)]
    inside = "\n".join(parts)
    return f'<g transform="translate({x} {y})" stroke-width="3">{inside}</g>\n'


def _corner(box):
    """The middle of a disc in that corner of a photo that lies farthest from a box (4,)."""
    middle = np.add(box[:2], box[2:]) / 2
    inset = RADIUS + 6
    places = np.array([(x, y) for x in (inset, 600 - inset) for y in (inset, 400 - inset)])
    return places[np.linalg.norm(places - middle, axis=1).argmax()]


def _bar(scale):
    """A bar of 1 cm, or of 5 cm where that would be short, with its length."""
    mm = 10 if 10 * scale > 15 else 50
    y, half = RADIUS - 16, mm * scale / 2
    text = f'<text y="{y - 8}" text-anchor="middle" stroke="none" fill="{ON_PHOTO["ink"]}">'
    return f"{_line([[-half, y], [half, y]], 'ink')}{text}{mm // 10} cm</text>"


def _circle(middle, radius, colour, filled=False):
    x, y = np.round(middle, 1)
    fill = ON_PHOTO[colour] if filled else "none"
    return f'<circle cx="{x}" cy="{y}" r="{radius}" fill="{fill}" stroke="{ON_PHOTO[colour]}"/>'


def _line(points, colour, dashed=False):
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    dashes = ' stroke-dasharray="4 4"' * dashed
    return f'<polyline points="{points}" stroke="{ON_PHOTO[colour]}"{dashes}/>'
