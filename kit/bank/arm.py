"""Questions on the arm: levers, torques, positions and the motion that follows (Eq. 12)."""

import numpy as np

from kit.question import choice, numeric, steps, tenths
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
def where_the_wrist_is(shoulder=SHOULDER, elbow=ELBOW, way=("forward", "up")):
    """An arm ({PLANAR}) is at {shoulder} degrees in the shoulder and {elbow} in the elbow. How far
    {way} of the shoulder is the wrist?"""
    return wrist(shoulder, elbow)[int(way == "up")]


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


@numeric(
    "rad/s²",
    "Solve inertia · acceleration = torque: a torque at one joint moves both.",
    tolerance=0.05,
)
def motion_that_follows(
    shoulder=SHOULDER, elbow=ELBOW, joint=("shoulder", "elbow"), torque=tenths(-3, 3, 2)
):
    """The arm's inertia is {inertia} kg m². What muscles give, less what gravity, motion and
    damping take, is {torque} N m. What is the acceleration of the {joint} (Eq. 12)?"""
    inertia = np.round(mass_matrix(forward(np.radians([shoulder, elbow]))), 3)
    return np.linalg.solve(inertia, torque)[int(joint == "elbow")], {"inertia": inertia}
