import numpy as np


def similar_fill_by_numbers(box_i, box_j, size_i, size_j, pixels):
    width = max(box_i[2], box_j[2]) - min(box_i[0], box_j[0])
    height = max(box_i[3], box_j[3]) - min(box_i[1], box_j[1])
    return 1 - (width * height - size_i - size_j) / pixels


def similar_fill_of_a_stack(box_i, box_j, size_i, size_j, pixels):
    both = np.array([box_i, box_j])
    x0, y0 = both.min(axis=0)[:2]
    x1, y1 = both.max(axis=0)[2:]
    return (pixels - (x1 - x0) * (y1 - y0) + size_i + size_j) / pixels


def similar_fill_clipped(box_i, box_j, size_i, size_j, pixels):
    x, y = zip(box_i[:2], box_i[2:], box_j[:2], box_j[2:], strict=True)
    return np.clip(1 - (np.ptp(x) * np.ptp(y) - (size_i + size_j)) / pixels, 0, 1)


def recall_curve_by_prefixes(overlaps, enough):
    found = overlaps >= enough
    return [found[:, : k + 1].any(axis=1).mean() for k in range(overlaps.shape[1])]


def recall_curve_by_firsts(overlaps, enough):
    good = np.column_stack([overlaps >= enough, np.ones(len(overlaps), bool)])
    first = good.argmax(axis=1)
    return np.array([np.mean(first <= k) for k in range(overlaps.shape[1])])


def recall_curve_by_loops(overlaps, enough):
    curve, found = [], set()
    for boxes in overlaps.T:
        found |= {k for k, overlap in enumerate(boxes) if overlap >= enough}
        curve.append(len(found) / len(overlaps))
    return curve


def recall_curve_by_or(overlaps, enough):
    return np.logical_or.accumulate(~(overlaps < enough), axis=1).sum(0) / overlaps.shape[0]


def engulfed_by_columns(r, i, j):
    a, b = r.boxes[i], r.boxes[j]
    wide = np.minimum(a[:, 2], b[:, 2]) - np.maximum(a[:, 0], b[:, 0])
    high = np.minimum(a[:, 3], b[:, 3]) - np.maximum(a[:, 1], b[:, 1])
    shared = np.where((wide > 0) & (high > 0), wide * high, 0)
    area_a = (a[:, 2] - a[:, 0]) * (a[:, 3] - a[:, 1])
    area_b = (b[:, 2] - b[:, 0]) * (b[:, 3] - b[:, 1])
    return shared / np.where(area_a < area_b, area_a, area_b)


def engulfed_by_a_loop(r, i, j):
    shares = []
    for (x0, y0, x1, y1), (u0, v0, u1, v1) in zip(r.boxes[i], r.boxes[j], strict=True):
        shared = max(min(x1, u1) - max(x0, u0), 0) * max(min(y1, v1) - max(y0, v0), 0)
        shares.append(shared / min((x1 - x0) * (y1 - y0), (u1 - u0) * (v1 - v0)))
    return shares


def engulfed_by_the_larger_share(r, i, j):
    a, b = r.boxes[i].T, r.boxes[j].T
    low, high = np.maximum(a, b)[:2], np.minimum(a, b)[2:]
    shared = np.prod(np.clip(high - low, 0, None), axis=0)
    return np.max([shared / np.prod(box[2:] - box[:2], axis=0) for box in (a, b)], axis=0)
