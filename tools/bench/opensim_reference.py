"""Remake `reproduce/results/opensim.npz`, the arm in OpenSim, which the book's arm is held against.

    ARM26=path/to/arm26.osim .bench/bin/python -m tools.bench.opensim_reference

OpenSim arm26: J. Reinbolt, A. Seth, A. Habib, S. Hamner, adapted from K. Holzbaur et al. (2005),
CC BY 3.0. The file is in OpenSim's collection of models, and not here.
"""

import os

import numpy as np
import opensim

from reproduce.results import FOLDER
from vmc_lib.arm.model import DAMPING, MUSCLES, STEP
from vmc_lib.arm.simulate import constant_excitation

JOINTS = ("r_shoulder_elev", "r_elbow_flex")
SHOULDER = np.array([-0.017545, 0.793, 0.17])  # of the shoulder joint, in OpenSim's ground, m
RELEASED = np.radians([(20, 60), (-60, 20), (0, 110), (30, 90), (-30, 60)])
STEADY = np.array([(0.02, 0.05), (0.1, 0.1), (0.05, 0.15), (0.4, 0.4)])  # triceps, biceps


def load():
    """The model, without a word about the bones it cannot draw."""
    opensim.Logger.setLevelString("error")
    return opensim.Model(os.environ["ARM26"])


def state_in_posture(model, q):
    """The model's state, at rest in posture q (2,), and its two coordinates."""
    state = model.initSystem()
    joints = [model.getCoordinateSet().get(name) for name in JOINTS]
    for joint, angle in zip(joints, q, strict=True):
        joint.setValue(state, angle, False)
    return state, joints


def run(model, state, joints, times, accuracy):
    """Joint angles (times, 2) while OpenSim integrates from `state`."""
    manager = opensim.Manager(model)
    manager.setIntegratorAccuracy(accuracy)
    manager.initialize(state)
    states = map(manager.integrate, times)
    return np.array([[joint.getValue(now) for joint in joints] for now in states])


def geometry(model):
    """Lengths, moment arms and wrist over a grid of postures, the jumps of its paths included."""
    muscles = [model.getMuscles().get(name) for name in MUSCLES]
    wrist = model.getMarkerSet().get("r_radius_styloid")
    state, joints = state_in_posture(model, (0, 0))
    rows = {"q": [], "lengths": [], "arms": [], "wrist": []}
    for q in np.radians([(a, b) for a in range(-90, 91, 5) for b in range(0, 131, 10)]):
        for joint, angle in zip(joints, q, strict=True):
            joint.setValue(state, angle, False)
        model.realizePosition(state)
        rows["q"].append(q)
        rows["lengths"].append([m.getLength(state) for m in muscles])
        rows["arms"].append([[m.computeMomentArm(state, j) for m in muscles] for j in joints])
        rows["wrist"].append(wrist.getLocationInGround(state).to_numpy() - SHOULDER)
    return rows


def swing(q):
    """Where the arm without muscles is half a second after it was let go in posture q."""
    model = load()
    model.updForceSet().clearAndDestroy()
    return run(model, *state_in_posture(model, q), [0.5], 1e-11)[0]


def excited_model(excitations, elastic):
    """A model whose muscles get excitations (T, 6) and have settled to the first; our damping.

    Its tendons are `elastic` and its fibres pennate, as arm26 ships, or neither, as ours are
    (OpenSim has no rigid tendon for Thelen's muscle: a very stiff one must do).
    """
    model = load()
    controller = opensim.PrescribedController()
    for name, excitation in zip(MUSCLES, excitations.T.tolist(), strict=True):
        muscle = opensim.Thelen2003Muscle.safeDownCast(model.updMuscles().get(name))
        muscle.setDefaultActivation(max(excitation[0], muscle.getMinimumActivation()))
        if not elastic:
            muscle.set_FmaxTendonStrain(0.001)
            muscle.setPennationAngleAtOptimalFiberLength(0)
        controller.addActuator(muscle)
        signal = opensim.PiecewiseLinearFunction()
        for k, level in enumerate(excitation):
            signal.addPoint(STEP * k, level)
        controller.prescribeControlForActuator(name, signal)
    model.addController(controller)
    for name, damping in zip(JOINTS, DAMPING, strict=True):
        skin = opensim.SpringGeneralizedForce(name)
        skin.setViscosity(damping)
        model.addForce(skin)
    return model


def movement(levels, elastic):
    """Joint angles (60, 2), every 10 ms, that constant excitations (6,) give; from (0°, 60°)."""
    model = excited_model(constant_excitation(levels, 0.6), elastic)
    state, joints = state_in_posture(model, np.radians([0, 60]))
    model.equilibrateMuscles(state)
    return run(model, state, joints, 0.01 * np.arange(1, 61), 1e-7)


if __name__ == "__main__":
    levels = STEADY.repeat(3, axis=1)
    np.savez_compressed(
        FOLDER / "opensim.npz",
        **geometry(load()),
        released=RELEASED,
        swung=[swing(q) for q in RELEASED],
        levels=levels,
        rigid=[movement(level, elastic=False) for level in levels],
        elastic=[movement(level, elastic=True) for level in levels],
    )
