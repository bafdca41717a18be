"""Exercises of the chapter on the hierarchy."""

import numpy as np

from vmc_lib.grading import Exercise


def pooled_widths(width, filter_width, block, layers):
    widths = []
    for _ in range(layers):
        hidden = width - filter_width + 1
        width = hidden // block
        widths.append(width)
    return widths


def _machine(rng):
    return (
        int(rng.integers(200, 400)),
        int(rng.integers(4, 9)),
        int(rng.choice([2, 3])),
        int(rng.integers(1, 4)),
    )


def _widths(after):
    """`pooled_widths` with another width after one layer."""

    def wrong(width, filter_width, block, layers):
        widths = []
        for _ in range(layers):
            width = after(width, filter_width, block)
            widths.append(width)
        return widths

    return wrong


POOLED_WIDTHS = Exercise(
    pooled_widths,
    _machine,
    {
        "A filter of width 200 fits once into 200 pixels, not zero times: add 1.": (
            _widths(lambda width, n, block: (width - n) // block)
        ),
        "A block that is not full is left out: round down.": (
            _widths(lambda width, n, block: (width - n + block) // block)
        ),
        "Blocks do not overlap: each takes `block` columns, so divide.": (
            _widths(lambda width, n, block: width - n + 1 - block + 1)
        ),
        "A width is a whole number: use `//`.": _widths(lambda width, n, c: (width - n + 1) / c),
        "These are the hidden maps' widths. Give the pooled ones.": (
            lambda width, n, block, layers: [
                w - n + 1 for w in [width, *pooled_widths(width, n, block, layers - 1)]
            ]
        ),
    },
)


def pixels_seen(filters, blocks):
    seen, step = 1, 1  # pixels seen; pixels between two neighbours
    for filter_width, block in zip(filters, blocks, strict=True):
        seen += (filter_width - 1) * step
        seen += (block - 1) * step
        step *= block
    return seen


def _layers(rng):
    count = rng.integers(2, 5)
    return rng.integers(3, 12, count).tolist(), rng.integers(2, 4, count).tolist()


PIXELS_SEEN = Exercise(
    pixels_seen,
    _layers,
    {
        "Right for one layer. Neighbours in a pooled map lie `block` pixels apart, so that the "
        "next filter reaches farther: keep a step.": lambda filters, blocks: (
            sum(filters) + sum(blocks) - 2 * len(blocks) + 1
        ),
        "The blocks widen the view, too: a pooled unit sees all that its hidden units see.": (
            lambda filters, blocks: (
                1 + np.dot(np.subtract(filters, 1), np.cumprod([1, *blocks[:-1]]))
            )
        ),
        "The step grows too early: within a block hidden units are still as close as before.": (
            lambda filters, blocks: (
                1
                + np.dot(np.subtract(filters, 1), np.cumprod([1, *blocks[:-1]]))
                + np.dot(np.subtract(blocks, 1), np.cumprod(blocks))
            )
        ),
        "You multiplied the widths. Windows of neighbours overlap: each adds only its step.": (
            lambda filters, blocks: np.prod(filters) * np.prod(blocks)
        ),
    },
)
