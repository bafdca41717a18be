import numpy as np


def on_the_table_by_coordinates(eye, direction, height):
    x, y, z = eye
    steps = (y - height) / -direction[1]
    return [x + steps * direction[0], height, z + steps * direction[2]]


def on_the_table_by_interpolation(eye, direction, height):
    other = eye + direction
    share = (eye[1] - height) / (eye[1] - other[1])
    return (1 - share) * eye + share * other


def on_the_table_by_equations(eye, direction, height):
    up = np.array([[0, 1, 0]])
    lines = np.block([[np.eye(3), -direction[:, None]], [up, np.zeros((1, 1))]])
    return np.linalg.solve(lines, np.append(eye, height))[:3]


def first_broken_by_loops(right):
    firsts = []
    for row in right:
        broken = 0
        while broken < len(row) and row[broken]:
            broken += 1
        firsts.append(broken)
    return firsts


def first_broken_by_product(right):
    return np.cumprod(right, axis=1).sum(axis=1)


def first_broken_with_one_more(right):
    return np.column_stack([right, np.zeros(len(right), bool)]).argmin(axis=1)


def first_broken_by_lists(right):
    return [[*row, False].index(False) for row in right.tolist()]
