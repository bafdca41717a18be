"""Questions on the whole loop: from a pixel to a place, and what a wrong guess costs."""

import numpy as np

from kit.bank.drawing import bars, points
from kit.question import choice, numeric, picture, steps
from vmc_lib.arm.kinematics import TRUNK, to_world
from vmc_lib.camera import Camera
from vmc_lib.photos import WIDTH

FOCAL, DEPTH = steps(400, 800, 50), steps(0.4, 1.2, 0.1)  # pixels, m
PINHOLE = "Similar triangles: pixels from the middle over focal length = metres aside over depth."


def level_camera(focal):
    """A camera at the origin that looks along x; its picture's axes are z and -y of the room."""
    axes = np.array([[0.0, 0, 1], [0, -1, 0], [1, 0, 0]])
    return Camera(focal, np.array([300.0, 200.0]), axes, np.zeros(3))


def tilted_camera(degrees, height):
    """A camera so high above y = 0 that looks forward and so many degrees down."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    axes = np.array([[0.0, 0, 1], [-s, -c, 0], [c, -s, 0]])
    return Camera(500.0, np.array([300.0, 200.0]), axes, np.array([0.0, height, 0.0]))


def axis_landing(camera, height=0.0):
    """How far forward a camera's axis is at a height, m."""
    return camera.back_project(camera.centre, height)[0, 0]


@numeric("pixels", PINHOLE, tolerance=1)
def pixel_column(focal=FOCAL, depth=DEPTH, aside=steps(0.05, 0.25, 0.01)):
    """A camera has a focal length of {focal} pixels; the middle of its picture is at column 300. A
    point lies {depth} m in front of it and {aside} m to the right of its axis. In which column of
    the picture does it appear?"""
    return level_camera(focal).project([depth, 0, aside])[0, 0]


@numeric("pixels", PINHOLE)
def apparent_width(focal=FOCAL, depth=DEPTH, width=steps(5, 12, 1)):
    """How many pixels wide does a cup of {width} cm appear at a distance of {depth} m from a camera
    with a focal length of {focal} pixels?"""
    half = width / 100 / 2
    return np.ptp(level_camera(focal).project([[depth, 0, -half], [depth, 0, half]])[:, 0])


@numeric("m", PINHOLE)
def distance_from_width(focal=FOCAL, width=steps(5, 12, 1), pixels=steps(30, 90, 5)):
    """A cup of {width} cm appears {pixels} pixels wide to a camera with a focal length of {focal}
    pixels. How far away is it?"""
    return focal * (width / 100) / pixels


@numeric("degrees", "Half of it is the arctangent of 300 / focal.")
def field_of_view(focal=steps(300, 900, 25)):
    """A picture is {WIDTH} pixels wide, its middle lies on the camera's axis, and the focal length
    is {focal} pixels. How wide is the field of view, from edge to edge?"""
    left, right = level_camera(focal).rays([[0, 200], [WIDTH, 200]])
    return np.degrees(np.arccos(left @ right / np.linalg.norm(left) / np.linalg.norm(right)))


@numeric("m", "height / tan(angle)")
def where_the_ray_lands(degrees=steps(30, 70, 5), height=steps(0.4, 0.8, 0.05)):
    """An eye {height} m above the table looks {degrees} degrees down from the horizontal. How far
    forward, along the table, does its axis meet the table?"""
    return axis_landing(tilted_camera(degrees, height))


@numeric(
    "mm", "The line of sight crosses the two heights at points that are height / tan(angle) apart."
)
def wrong_height(degrees=steps(30, 75, 5), high=steps(5, 40, 5)):
    """The eye looks {degrees} degrees down from the horizontal. A thing's middle is {high} mm
    higher than was assumed. By how much is its place wrong, along the table?"""
    camera = tilted_camera(degrees, 0.5)
    return 1000 * (axis_landing(camera) - axis_landing(camera, high / 1000))


@numeric("mm", PINHOLE)
def one_pixel_on_the_table(focal=FOCAL, depth=DEPTH, pixels=steps(2, 12, 1)):
    """The middle of a box is {pixels} pixels too far right. The thing is {depth} m away, the focal
    length {focal} pixels. By how much is the place wrong, sideways?"""
    return 1000 * pixels * depth / focal


@numeric("m", "distance × sin(angle)")
def turn_of_the_trunk(degrees=steps(-40, 60, 10, zero=15), ahead=steps(0.3, 0.5, 0.02)):
    """The hand is {ahead} m straight in front of the trunk's axis. The trunk turns by {degrees}
    degrees, positive to the left. How far to the left of the axis is the hand now (negative: to the
    right)?"""
    point = [TRUNK[0] + ahead, 0.0, TRUNK[1]]
    return TRUNK[1] - to_world(point, np.radians(degrees))[2]


@numeric("mm", "Squares add.")
def errors_together(
    seeing=steps(3, 15, 1),
    moving=steps(2, 12, 0.5),
    pair=("at right angles", "independent, and these are root mean squares"),
):
    """Seeing is {seeing} mm off and moving {moving} mm; the two errors are {pair}. How far from the
    thing does the hand end (its root mean square)?"""
    return np.hypot(seeing, moving)


STEPS = "seen", "named", "placed", "reached"


def photos_left(rng):
    """Of 200 photos, those that are left before the first step and after each of the four."""
    return np.round(200 * np.cumprod([1, *rng.permutation([0.96, 0.91, 0.85, 0.78])])).astype(int)


def chain(axes, left):
    """Five bars: how many photos there are ({left[0]}), and in how many the thing is seen
    ({left[1]}), then named ({left[2]}), then placed ({left[3]}), then reached ({left[4]})."""
    bars(axes, dict(zip(("photos", *STEPS), left, strict=True)), "photos")


@picture(chain)
@choice(*STEPS, hint="Of what reaches a step, the share that it loses: not the tallest drop.")
def step_that_loses_most(left=photos_left):
    """Each bar counts the photos in which this step and all before it succeeded. Which step loses
    the largest share of what reaches it?"""
    return np.argmin(left[1:] / left[:-1])


def three_places(rng):
    """Where a thing is, is seen and where the hand ended: (3, 2), whole cm."""
    true = rng.integers([20, -5], [40, 6])
    seen = true + rng.choice([-4, -3, -2, 2, 3, 4], 2)
    return np.array([true, seen, seen + rng.choice([-5, -4, -3, 3, 4, 5], 2)])


def from_above(axes, places):
    """The table from above, a centimetre a unit: the thing at ({places[0][0]}, {places[0][1]}), the
    place where it is seen at ({places[1][0]}, {places[1][1]}), the end of the hand at
    ({places[2][0]}, {places[2][1]})."""
    names = "the thing", "seen here", "the hand ended here"
    points(axes, dict(zip(names, places, strict=True)), "forward (cm)", "left (cm)")


@picture(from_above)
@numeric("cm", "The arm goes where the eye says: the eye's error is what is left.", tolerance=0.3)
def left_to_the_eye(places=three_places):
    """One reach, seen from above. Calibration now makes the arm perfect: it ends where it is sent.
    How far from the thing will the hand end?"""
    return np.linalg.norm(places[1] - places[0])
