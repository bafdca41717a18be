"""Remake opensim.npz, the reference the arm is held against: needs `pip install opensim==4.6`.

python tests/arm/opensim_reference.py path/to/arm26.osim
"""

import sys
from pathlib import Path

import numpy as np
import opensim

MUSCLES = ["TRIlong", "TRIlat", "TRImed", "BIClong", "BICshort", "BRA"]
SHOULDER = np.array([-0.017545, 0.793, 0.17])  # of the shoulder joint, in OpenSim's ground


def paths(model):
    """Lengths, moment arms and wrist over postures; OpenSim's own paths jump beyond these."""
    state = model.initSystem()
    joints = [model.getCoordinateSet().get(name) for name in ("r_shoulder_elev", "r_elbow_flex")]
    muscles = [model.getMuscles().get(name) for name in MUSCLES]
    wrist = model.getMarkerSet().get("r_radius_styloid")
    rows = {"q": [], "lengths": [], "arms": [], "wrist": []}
    for q in np.radians([(a, b) for a in range(-70, 31, 10) for b in range(0, 131, 10)]):
        for joint, angle in zip(joints, q, strict=True):
            joint.setValue(state, angle, False)
        model.realizePosition(state)
        rows["q"].append(q)
        rows["lengths"].append([m.getLength(state) for m in muscles])
        rows["arms"].append([[m.computeMomentArm(state, j) for m in muscles] for j in joints])
        place = wrist.getLocationInGround(state)
        rows["wrist"].append(np.array([place.get(i) for i in range(3)]) - SHOULDER)
    return rows


def drop(model, q):
    """Where the arm without muscles swings in half a second, let go in posture q."""
    model.updForceSet().clearAndDestroy()
    state = model.initSystem()
    joints = [model.getCoordinateSet().get(name) for name in ("r_shoulder_elev", "r_elbow_flex")]
    for joint, angle in zip(joints, q, strict=True):
        joint.setValue(state, angle, False)
    manager = opensim.Manager(model)
    manager.setIntegratorAccuracy(1e-11)
    manager.initialize(state)
    end = manager.integrate(0.5)
    return [joint.getValue(end) for joint in joints]


if __name__ == "__main__":
    arm, start = sys.argv[1], np.radians([20.0, 60.0])
    swing = {"drop_start": start, "drop_end": drop(opensim.Model(arm), start)}
    np.savez_compressed(
        Path(__file__).with_name("opensim.npz"), **paths(opensim.Model(arm)), **swing
    )
