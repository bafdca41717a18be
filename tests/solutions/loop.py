import numpy as np


def chosen_box_by_a_loop(scores, chances):
    best = -1
    for k in range(len(scores)):
        if chances[k] > 0.5 and (best == -1 or scores[k] >= scores[best]):
            best = k
    return best


def chosen_box_sorted(scores, chances):
    order = [k for k in np.argsort(scores) if chances[k] > 0.5]
    return order[-1] if order else -1


def chosen_box_among_indices(scores, chances):
    (named,) = np.nonzero(chances > 0.5)
    return int(named[scores[named].argmax()]) if named.size else -1


def chosen_box_by_max(scores, chances):
    return max((k for k, p in enumerate(chances) if p > 0.5), key=lambda k: scores[k], default=-1)


def mixed_by_tensordot(distances, commands):
    return np.tensordot(1 / distances, commands, 1) / sum(1 / distances)


def mixed_by_broadcasting(distances, commands):
    weights = distances**-1.0 / (distances**-1.0).sum()
    return (weights[:, None, None] * commands).sum(axis=0)


def mixed_by_loops(distances, commands):
    total, out = sum(1 / d for d in distances), np.zeros_like(commands[0])
    for distance, command in zip(distances, commands, strict=True):
        out += command / distance / total
    return out.tolist()


def mixed_by_average(distances, commands):
    return np.average(commands, axis=0, weights=1 / distances)
