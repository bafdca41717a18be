"""Circuit diagram of the cerebellum: granule cells, a Purkinje cell, a climbing fibre."""

import numpy as np

from vmc_lib.show.palette import least_width

WIDE, HIGH = 560, 300
WORDS = 13  # px: how large words are
GRANULES = np.linspace(60, 310, 10)  # x of each granule cell
FIBRES = np.linspace(85, 130, len(GRANULES))  # y of the line that each sends to the right
ACTIVE = (3, 4, 5)  # the few that this target excites
TREE = 440  # x of the Purkinje cell


def circuit():
    """What the chapter's equations model, as SVG; who learns is drawn in red."""
    parts = [_path(f"M20,270H{GRANULES[-1] + 20:.0f}", "blue", 4)]
    for k, (x, y) in enumerate(zip(GRANULES, FIBRES, strict=True)):
        colour, wide = ("orange", 2.4) if k in ACTIVE else ("grey", 1)
        parts.append(_path(f"M{x:.0f},268V222", "blue", 1.4))
        parts.append(_path(f"M{x:.0f},205V{y:.1f}H535", colour, wide))
        parts.append(_dot(x, 213, 9, colour))
        parts.append(_dot(TREE - 24 + 4.6 * k, y, 4.5 if k in ACTIVE else 3, "red"))
    boughs = "".join(f"M{TREE},170L{TREE + d},80" for d in range(-30, 40, 12))
    parts += [_path(boughs, "purple", 1.6), _dot(TREE, 180, 15, "purple")]
    parts += [_path(f"M{TREE},195V270", "purple", 3)]
    parts += [_path(f"M515,280C515,200 {TREE + 30},210 {TREE + 6},110", "red", 2)]
    words = (
        (20, 292, "mossy fibres: where the target is", "blue"),
        (328, 218, "granule cells:", "ink"),
        (328, 234, "few answer", "ink"),
        (150, 70, "their lines, with weights v (red dots)", "ink"),
        (TREE - 104, 186, "Purkinje cell", "purple"),
        (TREE - 72, 262, "sum(x)", "purple"),
        (462, 296, "climbing fibre: the error", "red"),
    )
    halo = 'stroke="var(--vmc-paper)" stroke-width="5" paint-order="stroke"'  # over the lines
    parts += [
        f'<text x="{x}" y="{y}" fill="var(--vmc-{c})" {halo}>{t}</text>' for x, y, t, c in words
    ]
    size = f'viewBox="0 0 {WIDE + 90} {HIGH}" width="{WIDE + 90}" height="{HIGH}"'
    letters = f'font-size="{WORDS}" style="{least_width(WIDE + 90, WORDS)}"'
    return f"<svg {size} {letters}>{''.join(parts)}</svg>"


def _path(d, colour, width):
    return f'<path d="{d}" fill="none" stroke="var(--vmc-{colour})" stroke-width="{width}"/>'


def _dot(x, y, r, colour):
    return f'<circle cx="{x:.0f}" cy="{y:.1f}" r="{r}" fill="var(--vmc-{colour})"/>'
