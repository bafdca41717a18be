"""Drawings: two streams, a box corrected, a line of sight, a CRBM's block, a stack. All SVG."""

from vmc_lib.show.palette import css, least_width

WORDS = 14  # px: how large words are


def drawing(width, height, *parts):
    """Parts on a sheet of `width` × `height`, lines in ink, with an arrow's tip to be had."""
    tip = (
        '<marker id="tip" viewBox="0 0 8 8" refX="6" refY="4" markerWidth="6" markerHeight="6" '
        'orient="auto"><path d="M0 0L8 4L0 8z" fill="context-stroke" stroke="none"/></marker>'
    )
    return "\n".join(
        [
            f'<svg viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
            f'font-size="{WORDS}" fill="none" stroke="{css("ink")}" stroke-width="1.5" '
            f'style="{least_width(width, WORDS)}">{tip}',
            *parts,
            "</svg>",
        ]
    )


def words(x, y, text, colour="ink"):
    """A line of text, by the middle of its foot."""
    style = f'fill="{css(colour)}" stroke="none" text-anchor="middle"'
    return f'<text x="{x}" y="{y}" {style}>{text}</text>'


def arrow(path, colour="ink", width=1.5):
    """A line along `path` (SVG) with a tip at its end."""
    return (
        f'<path d="{path}" stroke="{css(colour)}" stroke-width="{width}" marker-end="url(#tip)"/>'
    )


def grid(x, y, side, count, filled=(), colour="blue"):
    """A square of count × count cells; those `filled`, (column, row), in a colour."""
    cell = side / count
    lines = "".join(
        f"M{x + i * cell:.1f} {y}v{side}M{x} {y + i * cell:.1f}h{side}" for i in range(count + 1)
    )
    return (
        "".join(
            f'<rect x="{x + c * cell:.1f}" y="{y + r * cell:.1f}" width="{cell:.1f}" '
            f'height="{cell:.1f}" fill="{css(colour)}" stroke="none"/>'
            for c, r in filled
        )
        + f'<path d="{lines}" stroke="{css("grey")}" stroke-width="1"/>'
    )


def two_streams():
    """The dorsal and the ventral stream on the left half of a brain that looks to the left."""
    outline = (
        "M62 165C45 105 95 45 200 34C310 22 425 55 448 130C458 168 440 192 405 198"
        "C365 204 335 196 305 210C265 240 190 262 142 238C120 226 124 206 146 196"
        "C105 204 72 196 62 165Z"
    )
    folds = "M146 196C205 178 262 166 318 152M240 32C228 72 246 104 218 152"
    cerebellum = "M330 212C345 196 420 196 440 214C448 244 400 262 362 254C336 248 322 232 330 212Z"
    return drawing(
        432,
        290,
        '<g transform="translate(-44)">',
        f'<path d="{outline}" fill="{css("line")}" fill-opacity=".35"/>',
        f'<path d="{folds}" stroke="{css("grey")}"/>',
        f'<path d="{cerebellum}"/>',
        arrow("M408 138C390 92 345 66 262 66", "blue", 4),
        arrow("M404 160C360 196 280 205 190 220", "orange", 4),
        arrow("M236 66C214 68 200 82 192 104", "blue", 2),
        f'<circle cx="418" cy="150" r="15" fill="{css("paper")}"/>',
        words(418, 155, "V1"),
        words(322, 92, "parietal", "blue"),
        words(372, 22, "where: the dorsal stream", "blue"),
        words(180, 122, "motor"),
        words(168, 226, "IT", "orange"),
        words(132, 274, "what: the ventral stream", "orange"),
        words(386, 234, "cerebellum"),
        "</g>",
    )


def box_regression():
    """A box that lies astray, the four numbers that its content gives, and the box they make."""
    cup = f'<path d="M60 42v52q0 26 32 26t32-26v-52zM124 56h16v34h-16" fill="{css("line")}"/>'
    there = f'<g transform="translate(210)">{cup}</g>'

    def box(x, y, width, height, colour):
        return (
            f'<rect x="{x}" y="{y}" width="{width}" height="{height}" '
            f'stroke="{css(colour)}" stroke-width="2.5"/>'
        )

    return drawing(
        420,
        212,
        cup,
        box(86, 56, 72, 78, "orange"),
        arrow("M178 84H242"),
        there,
        box(296, 56, 72, 78, "orange"),
        box(264, 36, 92, 90, "green"),
        arrow("M332 95L314 84", "green"),
        words(100, 22, "before", "orange"),
        words(310, 22, "after one round", "green"),
        words(210, 164, "what it shows: gradients in 10 × 10 cells"),
        words(210, 186, "so: move left and up, stretch across and down"),
    )


def line_of_sight():
    """From the side: an eye, its line of sight, and two heights at which a thing may lie on it."""
    return drawing(
        430,
        230,
        f'<path d="M10 190H420" stroke="{css("grey")}" stroke-width="4"/>',
        f'<circle cx="40" cy="40" r="12" fill="{css("paper")}"/><circle cx="46" cy="44" r="4"/>',
        arrow("M52 48L352 188", "blue", 2),
        f'<path d="M251 138H328M304 163H328" stroke="{css("grey")}" stroke-dasharray="4 4"/>',
        f'<circle cx="245" cy="138" r="6" fill="{css("orange")}" stroke="none"/>',
        f'<circle cx="298" cy="163" r="6" fill="{css("green")}" stroke="none"/>',
        words(40, 20, "eye"),
        words(186, 84, "line of sight", "blue"),
        words(376, 143, "if it stands"),
        words(368, 168, "if it lies"),
        arrow("M245 204H296", "red"),
        words(270, 222, "off by so much", "red"),
        words(90, 184, "table"),
    )


def crbm_block():
    """Picture, one map of hidden units with a block of 2 × 2, and the map of its pooled units."""
    window = f'<rect x="48" y="46" width="60" height="60" stroke="{css("blue")}" stroke-width="3"/>'
    block = (
        f'<rect x="240" y="36" width="50" height="50" stroke="{css("orange")}" stroke-width="3"/>'
    )
    return drawing(
        432,
        190,
        grid(8, 26, 120, 6),
        window,
        grid(190, 36, 100, 4, [(2, 1)], "orange"),
        block,
        grid(370, 61, 50, 2, [(1, 0)], "orange"),
        arrow("M112 74H248", "blue"),
        arrow("M294 61H384", "orange"),
        words(68, 168, "picture v"),
        words(240, 160, "hidden map h"),
        words(380, 135, "pooled map p"),
        words(159, 62, "match", "blue"),
        words(332, 52, "pool", "orange"),
        words(240, 180, "of a block, at most one is on", "orange"),
    )


def stack(sizes, n_w):
    """The CDBN's layers, to scale, in two rows: `sizes` is layer → (maps, height, width)."""
    parts = []
    for i, (layer, (maps, height, width)) in enumerate(sizes.items()):
        side, copies, x, foot = width * 0.42, min(maps, 4), 70 + 140 * (i % 3), (110, 216)[i // 3]
        for k in reversed(range(copies)):
            parts.append(
                f'<rect x="{x - side / 2 + 4 * k:.0f}" y="{foot - side - 4 * k:.0f}" '
                f'width="{side:.0f}" height="{side:.0f}" fill="{css("paper")}"/>'
            )
        parts.append(words(x, foot + 20, layer))
        parts.append(words(x, foot + 37, f"{maps} × {height} × {width}"))
    steps = f"match by {n_w} × {n_w}, pool by 2 × 2, and again;", "then the mean of the maps"
    parts += [words(210, 282 + 20 * row, step, "grey") for row, step in enumerate(steps)]
    return drawing(420, 312, *parts)


def smith_predictor():
    """Smith's predictor: a model beside the arm, and the same model as late as the eye."""

    def box(x, y, width, text, colour):
        frame = f'<rect x="{x}" y="{y}" width="{width}" height="36" stroke="{css(colour)}"/>'
        return frame + words(x + width / 2, y + 23, text, colour)

    def meeting(x, y, *signs):
        return f'<circle cx="{x}" cy="{y}" r="11"/>' + "".join(words(*sign) for sign in signs)

    return drawing(
        432,
        290,
        arrow("M4 50H35"),
        words(16, 38, "aim"),
        meeting(48, 50, (32, 78, "−")),
        arrow("M59 50H82"),
        box(86, 32, 84, "feedback", "ink"),
        arrow("M170 50H222"),
        box(226, 32, 60, "arm", "ink"),
        arrow("M286 50H328"),
        words(306, 40, "hand"),
        box(332, 32, 96, "eye: late", "orange"),
        arrow("M408 68V240H365", "orange"),
        words(380, 190, "report", "orange"),
        arrow("M194 50V125H222", "blue"),
        words(190, 20, "command"),
        box(226, 107, 60, "model", "blue"),
        arrow("M286 125H314", "blue"),
        box(318, 107, 72, "as late", "blue"),
        arrow("M352 143V227", "blue"),
        meeting(352, 240, (340, 222, "−"), (374, 232, "+")),
        arrow("M300 125V227", "blue"),
        words(228, 190, "model’s hand, now", "blue"),
        f'<path d="M341 240H313" stroke="{css("red")}" stroke-dasharray="5 4" '
        'marker-end="url(#tip)"/>',
        words(326, 284, "0, if the model is exact", "red"),
        meeting(300, 240, (288, 222, "+")),
        arrow("M289 240H48V64"),
        words(162, 262, "what the feedback takes for the hand"),
    )
