"""Questions on the arm: levers, torques, positions and the motion that follows (Eq. 12)."""

import numpy as np

from kit.bank.drawing import curves
from kit.question import choice, numeric, picture, steps, tenths
from vmc_lib.arm.arm26 import forward, mass_matrix, muscle_paths
from vmc_lib.arm.model import MUSCLES

GRAVITY = 9.81  # m/s²
SHOULDER, ELBOW = steps(-40, 100, 10), steps(10, 120, 10)  # degrees within the joints' limits
LEVER, REACH = steps(1.5, 5, 0.5), steps(22, 32, 1)  # cm
PLANAR = "upper arm 30 cm, forearm 26 cm, both joints turning in one plane; 0 hangs straight down"


def moment_arms(*degrees):
    """Moment arms (2, 6) in cm of our arm's muscles in a posture."""
    return 100 * muscle_paths(forward(np.radians(degrees)))[1]


def wrist(shoulder, elbow):
    """Where the wrist of the planar arm is: forward, up (cm); angles in degrees."""
    upper, lower = np.radians([shoulder, shoulder + elbow])
    return 100 * np.array(
        [0.3 * np.sin(upper) + 0.26 * np.sin(lower), -0.3 * np.cos(upper) - 0.26 * np.cos(lower)]
    )


@numeric("N m", "Moment arm, in metres, × force.")
def torque_of_a_muscle(
    shoulder=SHOULDER, elbow=ELBOW, k=range(len(MUSCLES)), pull=steps(50, 600, 50)
):
    """In a posture of {shoulder} degrees at the shoulder and {elbow} at the elbow, {muscle} has a
    moment arm of {lever} cm at the {joint} (negative: it turns the joint back). It pulls with
    {pull} N. What torque is that?"""
    muscle, joint = MUSCLES[k], "shoulder" if MUSCLES[k] == "TRIlong" else "elbow"
    lever = round(moment_arms(shoulder, elbow)[int(joint == "elbow"), k].item(), 2)
    return pull * lever / 100, {"muscle": muscle, "joint": joint, "lever": lever}


@choice(
    "bends it",
    "straightens it",
    "nothing",
    hint="A muscle can only pull; the sign of its moment arm says which way.",
)
def what_a_muscle_does(shoulder=SHOULDER, elbow=ELBOW, k=range(len(MUSCLES))):
    """At {shoulder} degrees in the shoulder and {elbow} in the elbow, {muscle} has a moment arm of
    {lever:.1f} cm at the elbow. What does its pull do to the elbow, which bends in the positive
    direction?"""
    lever = moment_arms(shoulder, elbow)[1, k]
    return int(lever < 0), {"muscle": MUSCLES[k], "lever": lever}


@numeric("N", "Weight × reach = pull × moment arm.")
def bag_in_the_hand(kilograms=steps(0.5, 5, 0.5), reach=REACH, lever=LEVER):
    """The forearm is level. A bag of {kilograms} kg hangs {reach} cm in front of the elbow, and one
    muscle, with a moment arm of {lever} cm, carries it alone. How hard must it pull (g = {GRAVITY}
    m/s², the forearm's own weight not counted)?"""
    return kilograms * GRAVITY * reach / lever


@numeric("cm", "The forearm's angle is the sum of the two.", tolerance=0.1)
def where_the_wrist_is(
    shoulder=SHOULDER, elbow=ELBOW, way=(("in front of", "behind"), ("above", "below"))
):
    """An arm ({PLANAR}) is at {shoulder} degrees in the shoulder and {elbow} in the elbow. How far
    {way[0]} the shoulder is the wrist ({way[1]} it: a negative number)?"""
    return wrist(shoulder, elbow)[int(way[0] == "above")]


@numeric("cm", "The law of cosines.")
def distance_of_the_wrist(elbow=steps(10, 130, 10)):
    """An arm ({PLANAR}) bends its elbow by {elbow} degrees. How far is the wrist from the
    shoulder?"""
    return np.linalg.norm(wrist(0, elbow))


@numeric("degrees", "The law of cosines; 0 is straight.", tolerance=1)
def elbow_for_a_distance(elbow=steps(10, 130, 10)):
    """An arm ({PLANAR}) has its wrist {distance:.1f} cm from the shoulder. By how many degrees is
    the elbow bent?"""
    return elbow, {"distance": np.linalg.norm(wrist(0, elbow))}


@numeric("cm", "Moment arm × angle in radians.")
def shortening_of_a_muscle(lever=LEVER, degrees=steps(10, 60, 5)):
    """A muscle's moment arm at the elbow is {lever} cm all the way. The elbow bends by {degrees}
    degrees. By how much does the muscle get shorter?"""
    return lever * np.radians(degrees)


@numeric("cm/s", "Both turn at the same angular velocity.")
def speed_of_the_hand(lever=LEVER, reach=REACH, speed=steps(2, 20, 1)):
    """A muscle with a moment arm of {lever} cm at the elbow shortens at {speed} cm/s; no other
    joint moves, and the wrist is {reach} cm from the elbow. How fast is the wrist?"""
    return speed * reach / lever


@numeric("rad/s²", "Solve inertia · acceleration = torque: a torque at one joint moves both.")
def motion_that_follows(
    shoulder=SHOULDER, elbow=ELBOW, joint=("shoulder", "elbow"), torque=tenths(-3, 3, 2)
):
    """The arm's inertia is {inertia} kg m². What muscles give, less what gravity, motion and
    damping take, is {torque} N m. What is the acceleration of the {joint} (Eq. 12)?"""
    inertia = np.round(mass_matrix(forward(np.radians([shoulder, elbow]))), 3)
    answers = np.linalg.solve(inertia, torque).round(6)  # a 0 that rounding hides: drawn again
    return answers[int(joint == "elbow")], {"inertia": inertia}


ELBOWS = np.arange(0, 131, 2.0)  # degrees, the upper arm hanging


def levers(k):
    """Moment arms of a muscle at the elbow, cm, over `ELBOWS`."""
    return np.array([moment_arms(0, elbow)[1, k] for elbow in ELBOWS])


def lever_curve(axes, k, elbow):
    """A muscle's moment arm at the elbow, in cm, against the elbow's angle, 0 to 130 degrees: a
    curve with one mark on it, at {elbow} degrees and {lever:.1f} cm."""
    curves(axes, ELBOWS, {"": levers(k)}, "elbow (degrees)", "moment arm (cm)")
    axes.plot(elbow, moment_arms(0, elbow)[1, k], "ko")


BENDERS = [MUSCLES.index(name) for name in ("BIClong", "BICshort", "BRA")]


@picture(lever_curve)
@numeric("N m", "Read the moment arm at the mark, in metres; times the force.", tolerance=0.5)
def torque_at_the_mark(k=BENDERS, elbow=steps(30, 110, 10), pull=steps(200, 600, 50)):
    """In the posture of the mark this muscle pulls with {pull} N. What torque does it make at the
    elbow?"""
    lever = moment_arms(0, elbow)[1, k]
    return pull * lever / 100, {"lever": lever}


def bend(shoulder):
    """Where the elbow of the planar arm is: forward, up (cm)."""
    return 30 * np.array([np.sin(np.radians(shoulder)), -np.cos(np.radians(shoulder))])


def stick(axes, shoulder, elbow):
    """An arm of two links from the side, the shoulder in the middle above. The elbow is at
    ({x[0]:.0f}, {y[0]:.0f}) cm, the wrist at ({x[1]:.0f}, {y[1]:.0f}), forward and up."""
    axes.plot(*np.transpose([(0, 0), bend(shoulder), wrist(shoulder, elbow)]), "o-", lw=3)
    axes.set_aspect("equal", "datalim")
    axes.set(xlabel="forward (cm)", ylabel="up (cm)")
    axes.grid(alpha=0.4)


@picture(stick)
@choice(
    "{shoulder} and {elbow}",
    "{shoulder} and {absolute}",
    "{absolute} and {elbow}",
    hint="The elbow's angle is that between the links, not that of the forearm with the vertical.",
)
def angles_of_a_posture(shoulder=steps(10, 50, 10), elbow=steps(30, 90, 10)):
    """Which angles has this arm, in degrees, at the shoulder and at the elbow ({PLANAR})?"""
    x, y = np.transpose([bend(shoulder), wrist(shoulder, elbow)])
    return 0, {"absolute": shoulder + elbow, "x": x, "y": y}


PAIRS = [(b, t) for b in ("BIClong", "BRA", "BICshort") for t in ("TRIlat", "TRImed", "TRIlong")]


def lengths(names):
    """Lengths of two muscles, cm, over `ELBOWS`, (2, n)."""
    places = [MUSCLES.index(name) for name in names]
    paths = [muscle_paths(forward(np.radians([0, elbow])))[0][places] for elbow in ELBOWS]
    return 100 * np.transpose(paths)


def two_lengths(axes, pair, swap):
    """The lengths of two muscles, in cm, against the elbow's angle. From 0 to 130 degrees A goes
    from {a[0]:.1f} to {a[1]:.1f}, B from {b[0]:.1f} to {b[1]:.1f}."""
    a, b = lengths(pair)[[swap, 1 - swap]]
    curves(axes, ELBOWS, {"A": a, "B": b}, "elbow (degrees)", "length (cm)")


@picture(two_lengths)
@choice("A", "B", hint="A muscle only shortens when it pulls: it turns the joint that way.")
def which_one_bends(pair=PAIRS, swap=(0, 1)):
    """The elbow's angle grows as the arm bends. Which muscle bends it by its pull?"""
    a, b = lengths(pair)[[swap, 1 - swap]][:, [0, -1]]
    return int(a[1] > a[0]), {"a": a, "b": b}
