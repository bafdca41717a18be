"""Drawing of a sarcomere: what its length and its speed do to the heads."""

import numpy as np

WIDE, HIGH = 440, 96  # of the drawing
REST = 230  # a piece of fibre, from disc to disc, at the optimal length
THICK, THIN = 0.56, 0.48  # myosin and actin, in optimal lengths: a sketch, not a measurement
ROWS = (26, 48, 70)  # where myosin lies, actin above it and below


def sarcomere(length, speed=0.0, place='class="vmc-strip"', wide=WIDE):
    """A piece of fibre as SVG: discs, actin (blue), myosin (red), springs; arrows for the speed.

    `length` is in optimal lengths, `speed` in such lengths a second, lengthening positive.
    `place` are attributes of the drawing, `wide` its width.
    """
    middle, half, half_thick = WIDE / 2, length * REST / 2, THICK * REST / 2
    overlap = np.clip(THIN * REST - (half - half_thick), 0, half_thick)
    parts = []
    for side in (-1, 1):
        disc, end, tip = (middle + side * x for x in (half, half_thick, half - THIN * REST))
        parts.append(_line(disc, 12, disc, 84, "ink", 4))
        for y in ROWS:
            parts += [_line(disc, y + d, tip, y + d, "blue", 3) for d in (-6, 6)]
            parts.append(_spring(end, disc, y))
            heads = end - side * np.arange(8, overlap, 12)
            parts += [_heads(x, y, 3 * side * np.clip(speed, -1, 1)) for x in heads]
        if speed:
            parts.append(_arrow(disc, side * np.sign(speed) * (8 + 5 * abs(speed))))
    parts += [_line(middle - half_thick, y, middle + half_thick, y, "red", 5) for y in ROWS]
    size = f'viewBox="0 0 {WIDE} {HIGH}" width="{wide}" height="{wide * HIGH / WIDE:.0f}"'
    return f"<svg {place} {size}>{''.join(parts)}</svg>"


def _line(x0, y0, x1, y1, colour, width):
    ends = f'x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}"'
    return f'<line {ends} stroke="var(--vmc-{colour})" stroke-width="{width}"/>'


def _heads(x, y, lean):
    """Two heads that grip the actin above and below, dragged along with it."""
    return "".join(_line(x, y, x + lean, y + d, "red", 1.8) for d in (-6, 6))


def _spring(x0, x1, y):
    """The passive spring between the myosin's end and the disc."""
    ys = y + 3 * np.array([0, *(6 * [1, -1]), 0])
    xs = np.linspace(x0, x1, len(ys))
    points = " ".join(f"{x:.1f},{at:.1f}" for x, at in zip(xs, ys, strict=True))
    return f'<polyline points="{points}" fill="none" stroke="var(--vmc-grey)" stroke-width="1.2"/>'


def _arrow(x, long):
    barb = 5 * np.sign(long)
    return (
        f'<path d="M{x:.1f},91h{long:.1f}m{-barb},-4l{barb},4l{-barb},4" fill="none" '
        'stroke="var(--vmc-ink)" stroke-width="1.6"/>'
    )
