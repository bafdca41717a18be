"""Ablation of the torques that turn the upper arm when a muscle pulls at the elbow alone."""

import numpy as np

from vmc_lib.arm import dynamics
from vmc_lib.arm.model import F0, L0, MUSCLES, SLACK, STEP
from vmc_lib.arm.muscle import force


def joint_rotations(motion, coupled=True, constant=()):
    """How far each joint turns (2,) in rad, by Eq. 12, from the start and activation of a motion.

    Without `coupled`, the off-diagonal of the mass matrix is zero. Muscles that are `constant` go
    on pulling as at the start, whatever their length and speed become.
    """
    start, *_ = motion.q
    q, w, kept = start.copy(), np.zeros(2), np.isin(MUSCLES, constant)
    first = None
    for a in motion.activation[:-1]:
        lengths, R = dynamics.paths(q)
        F = force(a, (lengths - SLACK) / L0, -(w @ R) / (2.5 * L0), F0)
        first = F if first is None else first
        F = np.where(kept, first, F)
        passive = -dynamics.torque_for(q, w, np.zeros(2))  # gravity, throw, friction
        A = np.array([dynamics.torque_for(q, w, unit) + passive for unit in np.eye(2)])
        A = A if coupled else np.diag(np.diag(A))
        w = w + STEP * np.linalg.solve(A, R @ F + passive)
        q = q + STEP * w
    return q - start
