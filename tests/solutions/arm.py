import numpy as np


def moment_arms_in_a_loop(length, q, turn):
    arms = np.zeros(2)
    for joint in range(2):
        forward, back = q.copy(), q.copy()
        forward[joint] += turn
        back[joint] -= turn
        arms[joint] = (length(back) - length(forward)) / (2 * turn)
    return arms


def moment_arms_by_name(length, q, turn):
    shoulder, elbow = q
    first = length([shoulder + turn, elbow]) - length([shoulder - turn, elbow])
    second = length([shoulder, elbow + turn]) - length([shoulder, elbow - turn])
    return -first / turn / 2, -second / turn / 2


def moment_arms_of_two_slopes(length, q, turn):
    steps = turn * np.eye(2)
    forward = [(length(q + step) - length(q)) / turn for step in steps]
    back = [(length(q) - length(q - step)) / turn for step in steps]
    return -(np.array(forward) + back) / 2


def moment_arms_in_half_steps(length, q, turn):
    steps = np.diag([turn / 2, turn / 2])
    return [-(length(q + step) - length(q - step)) / turn for step in steps]


def posture_by_cosines(hand, upper, fore):
    far = np.hypot(*hand)
    inside = np.arccos((upper**2 + fore**2 - far**2) / (2 * upper * fore))
    at_shoulder = np.arccos((upper**2 + far**2 - fore**2) / (2 * upper * far))
    return np.arctan2(hand[0], -hand[1]) - at_shoulder, np.pi - inside


def posture_by_complex_numbers(hand, upper, fore):
    x, y = hand
    elbow = np.arccos((x**2 + y**2 - upper**2 - fore**2) / (2 * upper * fore))
    arm = upper + fore * np.exp(1j * elbow)
    return [np.angle((-y + 1j * x) / arm), elbow]


def posture_by_sines(hand, upper, fore):
    far = np.linalg.norm(hand)
    cosine = (far**2 - upper**2 - fore**2) / (2 * upper * fore)
    elbow = np.arctan2(np.sqrt(1 - cosine**2), cosine)
    bearing = np.pi / 2 + np.arctan2(hand[1], hand[0])
    inward = np.arctan(fore * np.sin(elbow) / (upper + fore * cosine))
    return np.array([bearing - inward, elbow])
