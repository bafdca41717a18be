"""The arm, its muscles and what it reaches for, as a `Scene`.

Positions are metres in the shoulder frame (x forward, y up, z to the right). A scene says which
posture the arm takes, or moves through; where its bones and muscles are then, the viewer works out
from the `anatomy` that comes along. The model ends at the wrist: the hand beyond it is drawn, and
so that it can meet what the wrist reaches for, all that is drawn `BEYOND` the wrist.
"""

from collections.abc import Sequence
from functools import cache
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from vmc_lib import NoReach
from vmc_lib.arm.dynamics import check_posture
from vmc_lib.arm.kinematics import rotate_by_turn, turn_towards
from vmc_lib.arm.simulate import Motion
from vmc_lib.checks import as_numbers, is_within
from vmc_lib.photos import Photo
from vmc_lib.short_repr import short
from vmc_lib.show.scene import Scene

EVERY = 20  # ms between the moments of a movement that a scene carries: the viewer fills in
BEYOND = np.array([0.085, -0.01, -0.025])  # m from the wrist to what the hand holds (ours, by eye)
CLOSING = 0.25  # s before a movement's end in which a grasping hand closes


def arm_scene(
    q: ArrayLike | Motion,
    activation: ArrayLike = 6 * (0,),
    turn: ArrayLike = 0.0,
    photo: Photo | None = None,
    balls: Sequence[tuple[Any, str]] = (),
    grasp: bool = False,
    end: tuple[ArrayLike, float] | None = None,
) -> Scene:
    """The arm in posture q (2,), in radians, on a trunk turned by `turn`; or in a movement.

    A movement is a `Motion`, or has q (T, 2) and `activation` (T, 6), a sample every millisecond,
    and `turn` one or (T,). Muscles redden with `activation` (6,). `photo` puts its shuttlecock and
    its cup on the table; `balls` are (position (3,), colour name) pairs, the green one is the
    target. Where there is neither, there is no table: a hanging arm would reach through it. With
    `grasp` the hand closes: at once, or at the end of the movement. `end` is the movement's end
    point (3,) and how fast the hand still is there, in m/s: a red diamond, on a line from the
    target. ValueError for other shapes, a posture beyond the joints' limits, a colour that has no
    name, or an end without a target.
    """
    _check_goals(photo, balls, end)
    motion = _motion(q, activation, turn, grasp)
    table = bool(photo or len(balls))
    scene = Scene(_furniture(table))
    scene.tell("motion", {name: value.round(4).tolist() for name, value in motion.items()})
    if table:
        _add_goals(scene, photo, balls, end, motion["turn"][-1])
    return scene


def _check_goals(photo, balls, end):
    """Raise ValueError for what is no photo, no balls, or an end without its target."""
    if not (photo is None or hasattr(photo, "target")):
        raise ValueError(f'photo {short(photo)} is none: give one of photos.load("rig", "test")')
    if not np.iterable(balls):
        raise ValueError(f"balls {short(balls)}: give a list of ((x, y, z), colour name)")
    for ball in balls:
        _check_pair("a ball", ball, "((x, y, z), colour name)")
        _samples("a ball's position", ball[0], 3)
    if end is None:
        return
    _check_pair("end", end, "((x, y, z), speed)")
    _samples("the end's place", end[0], 3)
    if not is_within(end[1], 0, np.inf):
        raise ValueError(f"the end's speed {short(end[1])}: give m/s, 0 or more")
    if not any(colour == "green" for _, colour in balls):
        raise ValueError(f"end {short(end)}: give its target, too, as a green ball")


def _check_pair(name, pair, parts):
    """Raise ValueError for what is no pair."""
    if not isinstance(pair, tuple | list) or len(pair) != 2:
        raise ValueError(f"{name} {short(pair)} is no pair: give {parts}")


def _samples(name, values, size):
    """Values (size,), or of a movement (T, size), as an array (T, size)."""
    samples = np.atleast_2d(as_numbers(name, values))
    if samples.ndim != 2 or samples.shape[1] != size:
        raise ValueError(
            f"{name} {short(values)} of shape {np.shape(values)}: give {size} numbers in a tuple"
        )
    return samples


def _motion(q, activation, turn, grasp):
    """A movement's samples by name, one every `EVERY` ms: joints, muscles, trunk and grasp."""
    if isinstance(q, Motion):
        if np.ndim(q.q) != 2:
            raise ValueError(f"{short(q)} is a batch: give one movement of it, list(motion)[0]")
        activation, q = q.activation, q.q
    q = _samples("posture", q, 2)[::EVERY]
    check_posture(q)
    active = _samples("activation", activation, 6)[::EVERY]
    turns = np.atleast_1d(as_numbers("turn", turn))[::EVERY]
    if turns.ndim != 1 or not {len(active), len(turns)} <= {1, len(q)}:
        raise ValueError(
            f"activation {np.shape(activation)} or turn {np.shape(turn)} is of another movement "
            "than the posture: give a row for each of its rows, or one"
        )
    moments = np.arange(len(q)) * EVERY / 1000
    return {
        "q": q,
        "activation": np.broadcast_to(active, (len(q), 6)),
        "turn": np.broadcast_to(turns, len(q)),
        "grasp": np.clip(1 + (moments - moments[-1]) / CLOSING, 0, 1) * bool(grasp),
    }


def _add_goals(scene, photo, balls, end, turn):
    """Add what is reached for, where the trunk has turned at last, and how the reach ends."""
    from vmc_lib.show import props  # here, with meshcat, which the page has not

    turn = turn or (_turn_for(photo.target) if photo else 0.0)  # before a reach: its own
    scene["goal"].set_transform(props.place(beyond_wrist(turn)))
    if photo:
        props.table(scene["table"], photo)
        props.shuttlecock(scene["goal/shuttlecock"], photo)
        props.cup(scene["goal/cup"], photo)
    for i, (position, colour) in enumerate(balls):
        props.ball(scene[f"goal/ball{i}"], position, colour)
        if colour == "green":
            target = position
            scene.tell("target", np.round(target, 5).tolist())
    if end:
        place, speed = end
        props.diamond(scene["goal/end"], place, "red")
        props.line(scene["goal/miss"], (target, place), "red")
        off = float(np.linalg.norm(np.subtract(place, target)))
        scene.tell("end", {"off": round(off, 7), "speed": round(float(speed), 7)})


def beyond_wrist(turn: float) -> np.ndarray:
    """From the wrist to what the hand holds (3,), in m, where the trunk has turned."""
    return rotate_by_turn(BEYOND, turn)


def _turn_for(place):
    try:
        return turn_towards(place)[0]
    except NoReach:
        return 0.0


@cache
def _furniture(table):
    """What arm scenes share: the arm's anatomy, and perhaps a table."""
    scene = Scene()
    at, far = ((0.13, -0.24, 0), 1.05) if table else ((0.14, -0.24, 0), 1.7)  # what may be in sight
    scene.look(np.add(at, far * np.array([0.46, 0.25, 0.78])), at)
    if find_spec("mujoco"):  # not in the page, whose viewer has it from the first scene
        from vmc_lib.show.anatomy import anatomy

        scene.tell("anatomy", anatomy() | {"beyond": BEYOND.tolist(), "every": EVERY / 1000})
    if table:
        from vmc_lib.show import props

        props.table(scene["table"])
        scene["table"].set_transform(props.place((0, BEYOND[1], 0)))  # under what lies on it
    return scene
