import numpy as np


def svm_cost_by_a_loop(w, b, x, y, C):
    cost = 0.5 * sum(w**2)
    for example, side in zip(x, y, strict=True):
        if side * (w @ example + b) < 1:
            cost += C * (1 - side * (w @ example + b))
    return cost


def svm_cost_with_the_margin_inside(w, b, x, y, C):
    margins = y * (np.dot(x, w) + b)
    return np.linalg.norm(w) ** 2 / 2 + C * sum(1 - margins[margins <= 1])


def svm_cost_clipped(w, b, x, y, C):
    return np.dot(w, w) / 2 + C * np.clip(1 - y * ((x * w).sum(1) + b), 0, None).sum()


def soft_nms_by_pop(overlaps, scores):
    scores, waiting = list(scores), list(range(len(scores)))
    while waiting:
        waiting.sort(key=lambda k: scores[k])
        best = waiting.pop()
        for k in waiting:
            scores[k] *= 1 - overlaps[best][k]
    return scores


def soft_nms_by_recursion(overlaps, scores):
    if len(scores) == 0:
        return scores
    best = np.argmax(scores)
    rest = np.delete(np.arange(len(scores)), best)
    weaker = scores[rest] * (1 - overlaps[best][rest])
    after = soft_nms_by_recursion(overlaps[np.ix_(rest, rest)], weaker)
    return np.insert(after, best, scores[best])


def soft_nms_in_turns(overlaps, scores):
    scores, had = scores.copy(), []
    for _ in scores:
        best = max(set(range(len(scores))) - set(had), key=lambda k: scores[k])
        had.append(best)
        weaker = 1 - overlaps[:, best]
        weaker[had] = 1
        scores = scores * weaker
    return scores


def soft_nms_last_of_equals(overlaps, scores):
    scores, left = np.array(scores), list(range(len(scores)))
    while left:
        best = left[len(left) - 1 - int(np.argmax(scores[left][::-1]))]
        left.remove(best)
        scores[left] -= scores[left] * overlaps[best, left]
    return scores
