import numpy as np


def one_joint_by_a_mask(torque, gain):
    active = np.zeros(len(gain))
    helps = gain * torque > 0
    active[helps] = torque * gain[helps] / (gain[helps] ** 2).sum()
    return active


def one_joint_by_least_norm(torque, gain):
    helping = np.where(np.sign(gain) == np.sign(torque), gain, 0)
    return np.linalg.pinv(helping[None]) @ [torque]


def one_joint_by_a_loop(torque, gain):
    total = sum(g**2 for g in gain if g * torque > 0)
    return [g * torque / total if g * torque > 0 else 0 for g in gain]


def self_motion_by_least_squares(turning, jacobian):
    return turning - np.linalg.lstsq(jacobian, jacobian @ turning, rcond=None)[0]


def self_motion_by_normal_equations(turning, jacobian):
    J = jacobian
    return turning - J.T @ np.linalg.solve(J @ J.T, J @ turning)


def self_motion_by_the_null_space(turning, jacobian):
    null = np.linalg.svd(jacobian)[2][3:]
    return null.T @ (null @ turning)


def self_motion_by_gram_and_schmidt(turning, jacobian):
    basis, _ = np.linalg.qr(jacobian.T)
    for direction in basis.T:
        turning = turning - (turning @ direction) * direction
    return turning
