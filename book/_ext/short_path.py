"""The short path through the book: sittings of about twenty minutes, one leading to the next.

Where a piece of it ends, the page names the next one; the strip above a chapter (`thread`) and the
sidebar mark the chapters that it goes through.
"""

import re
from html import escape
from itertools import pairwise
from typing import NamedTuple

from docutils.nodes import make_id

MARK = " vmc-short-path"  # a class
RECAP = (
    ' The <a href="#recap">recap</a> below sums up the whole chapter;'
    ' the <a href="#quiz">quiz</a> {} about what you have read.'
)
# What else a chapter's quiz asks is of sections that the path leaves out
QUIZ = {
    "02_candidates": "asks in its first question",
    "04_crbm": "asks in its second question",
    "07_muscle": "asks in its first question",
    "09_planning": "asks in its first and its last question",
    "10_offline": "asks in its last question",
}
HEAD = re.compile(r'<section (?:class="[^"]*" )?id="([^"]+)">\s*<h2>')
LINK = re.compile(r'(<a class="(?:current )?reference internal)(" href="([^"]*)">)')


class Piece(NamedTuple):
    """What is read of a page: from one heading, or else from its top, to the end of another's."""

    page: str
    first: str = ""
    last: str = ""


MERGING = Piece("02_candidates", "Merging", "Merging")
REASONS = Piece("09_planning", "Two reasons to miss", "Two reasons to miss")
SITTINGS = (
    [Piece("01_loop", last="What: from a box to a name")],
    [
        Piece(
            "01_loop",
            "A place: from the eye to the shoulder",
            "The first reach, and what the cerebellum makes of it",
        )
    ],
    [Piece("02_candidates", last="Cutting: segments")],
    [MERGING, Piece("04_crbm", last="What the brain does")],
    [Piece("07_muscle", last="From excitation to activation")],
    [Piece("09_planning", last="What the brain does")],
    [Piece("09_planning", "Three equations", "How good is it?")],
    [REASONS, Piece("10_offline", last="What the brain does")],
    [Piece("10_offline", "The paper's correction", "Does the direction matter?")],
    [Piece("11_online", last="The paper's online calibration")],
    [Piece("11_online", "Granule cells", "A cerebellum that generalises")],
    [Piece("13_see_and_reach", last="The whole chain, stage by stage")],
    [Piece("13_see_and_reach", "When it fails, where did it begin?", "Four brains")],
    [Piece("epilogue")],
)
PIECES = [(nth, piece) for nth, pieces in enumerate(SITTINGS, 1) for piece in pieces]
PAGES = {f"book/{piece.page}" for _, piece in PIECES}


def setup(app):
    app.connect("html-page-context", lead_on, priority=955)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def lead_on(app, pagename, templatename, context, doctree):
    """Where a piece ends, name the next; and mark the path's chapters in the sidebar."""
    if sidebar := context.get("generate_toctree_html"):
        marked = {app.builder.get_relative_uri(pagename, page) or "#" for page in PAGES}
        context["generate_toctree_html"] = lambda **how: mark_links(sidebar(**how), marked)
    for (nth, here), (then, piece) in pairwise(PIECES):
        if f"book/{here.page}" != pagename:
            continue
        page = f"book/{piece.page}"
        title = piece.first or app.env.titles[page].astext()
        address = app.builder.get_relative_uri(pagename, page)
        address += f"#{make_id(piece.first)}" * bool(piece.first)
        link = f'<a href="{address}">{escape(title)}</a>'
        link += "." * (title[-1] not in "?!")
        said = f"Sitting {nth} goes on with: {link}"
        if then > nth:
            said = f"Sitting {nth} of {len(SITTINGS)} ends here. Next: {link}"
        body, place = context["body"], end_of(context["body"], here)
        if here.page != piece.page:  # the page's end leads on, too: its *Next* is another
            again = nav(f"{nth}, again", f"It goes on with: {link}")
            body, said = body + again, said + recap(here.page)
        context["body"] = f"{body[:place]}{nav(nth, said)}\n{body[place:]}"


def mark_links(sidebar, marked):
    """The sidebar, as the theme makes it, with a class on its links to these addresses (HTML)."""

    def add_class(link):
        return f"{link[1]}{MARK}{link[2]}" if link[3] in marked else link[0]

    return LINK.sub(add_class, str(sidebar))


def nav(label, text):
    """A line (HTML) that leads on along the path."""
    label = f'aria-label="The short path, {label}"'
    return f'<nav class="vmc-next-sitting" {label}><b>The short path.</b> {text}</nav>'


def recap(page):
    """What stands at the end of a page that is read in part (HTML)."""
    return RECAP.format(QUIZ.get(page, "asks"))


def end_of(body, piece):
    """Where a piece ends in its page's body (HTML): before the heading after its last.

    ValueError where the page has no such heading.
    """
    heads = list(HEAD.finditer(body))
    names = [head[1] for head in heads]
    last = make_id(piece.last)
    if last not in names:
        raise ValueError(f"{piece.page} has no section {piece.last!r}, but {names}")
    return heads[names.index(last) + 1].start()
