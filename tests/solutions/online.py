import numpy as np


def after_lessons_in_place(v, active, answers, rate):
    v = np.array(v)
    for lesson in range(len(answers)):
        error = answers[lesson] - np.dot(active[lesson], v)
        v += rate * error * active[lesson]
    return v


def after_lessons_by_recursion(v, active, answers, rate):
    if len(active) == 0:
        return v
    taught = v + (answers[0] - active[0] @ v) * active[0] * rate
    return after_lessons_by_recursion(taught, active[1:], answers[1:], rate)


def after_lessons_cell_by_cell(v, active, answers, rate):
    v = list(v)
    for a, y in zip(active, answers, strict=True):
        error = y - sum(weight * x for weight, x in zip(v, a, strict=True))
        v = [weight + rate * error * x for weight, x in zip(v, a, strict=True)]
    return v


def sparse_by_a_threshold(x, centres, width, most):
    active = np.exp(-(np.linalg.norm(centres - x, axis=1) ** 2) / 2 / width**2)
    return np.where(active >= np.sort(active)[-most], active, 0)


def sparse_by_the_nearest(x, centres, width, most):
    far = [sum((c - x) ** 2) for c in centres]
    active = np.zeros(len(centres))
    for k in sorted(range(len(far)), key=far.__getitem__)[:most]:
        active[k] = np.exp(-far[k] / (2 * width * width))
    return active


def sparse_by_ranks(x, centres, width, most):
    active = np.exp(-0.5 * (((x - centres) / width) ** 2).sum(1))
    stronger = (active[:, None] < active).sum(axis=1)
    return active * (stronger < most)
