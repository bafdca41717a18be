import numpy as np


def pooled_widths_by_recursion(width, filter_width, block, layers):
    if layers == 0:
        return []
    pooled = (width - filter_width + 1) // block
    return [pooled, *pooled_widths_by_recursion(pooled, filter_width, block, layers - 1)]


def pooled_widths_by_counting(width, filter_width, block, layers):
    widths = np.zeros(layers, int)
    for layer in range(layers):
        hidden = len(range(width - filter_width + 1))
        widths[layer] = width = len(range(block, hidden + 1, block))
    return widths


def pooled_widths_by_floor(width, filter_width, block, layers):
    widths = [width]
    while len(widths) <= layers:
        widths.append(int(np.floor((widths[-1] - (filter_width - 1)) / block)))
    return widths[1:]


def pixels_seen_from_the_top(filters, blocks):
    seen = 1
    for filter_width, block in zip(filters[::-1], blocks[::-1], strict=True):
        seen = seen * block + filter_width - 1
    return seen


def pixels_seen_at_once(filters, blocks):
    steps = np.cumprod([1, *blocks])[:-1]
    return 1 + int(np.sum((np.array(filters) + np.array(blocks) - 2) * steps))


def pixels_seen_by_recursion(filters, blocks):
    if not filters:
        return 1
    return (pixels_seen_by_recursion(filters[1:], blocks[1:]) - 1) * blocks[0] + (
        blocks[0] + filters[0] - 1
    )
