"""The running thread: a quiet strip above each chapter, the loop's sixteen marks and one miss.

The same photo and the same arm, arrested at the chapter's step, and how far the hand is then from
what it reaches for, as `book.figures.thread` works it out when the book is built.
"""

import re
from html import escape
from pathlib import Path

from book._ext.execute import digest
from book._ext.short_path import PAGES

CHAPTER = re.compile(r"book/(\d\d)_\w+")
SHORT = {int(found[1]) for page in PAGES if (found := CHAPTER.fullmatch(page))}  # chapters
LAST = "book/epilogue"
PHOTO = "_static/thread.webp"


def setup(app):
    app.add_config_value("thread_state", "", "html")
    app.connect("config-inited", note_state)
    app.connect("html-page-context", add_strip, priority=960)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def note_state(app, config):
    """Let every page be written again where what the strips say may have changed."""
    last = Path(app.srcdir, f"{LAST}.ipynb")
    if last.exists():  # in a tiny book of the tests it does not
        made = (Path(__file__).with_name(f"{name}.py") for name in ("thread", "short_path"))
        config.thread_state = digest(last) + "".join(x.read_text(encoding="utf-8") for x in made)


def chapters(env):
    """The book's chapters by number, and the plain text of each one's title."""
    pages = env.toctree_includes.get(env.config.root_doc, [])
    numbers = {int(found[1]): page for page in pages if (found := CHAPTER.fullmatch(page))}
    return {n: (page, env.titles[page].astext()) for n, page in sorted(numbers.items())}


def add_strip(app, pagename, templatename, context, doctree):
    """Put the strip above the page, if it is a chapter or the last page."""
    found = CHAPTER.fullmatch(pagename)
    if not found and pagename != LAST:
        return
    from book.figures import thread  # here, for it brings the model along

    photo, pixels = Path(app.outdir, PHOTO), thread.photo_file()
    if not photo.exists() or photo.read_bytes() != pixels:
        photo.parent.mkdir(exist_ok=True)
        photo.write_bytes(pixels)
    number = int(found[1]) if found else None
    places = {
        n: (app.builder.get_relative_uri(pagename, page) or "#", title)
        for n, (page, title) in chapters(app.env).items()
    }
    address = context["pathto"](PHOTO, resource=True)
    context["body"] = strip(number, places, address) + context["body"]


def strip(number, places, photo):
    """The strip (HTML) of a chapter by its number, of the last page by None.

    `places` are chapters' numbers with their addresses and titles; `photo` is the photo's address.
    A chapter that makes the miss smaller says the plan's, too; one before any reach, its step.
    """
    from book.figures import thread

    marks = "".join(mark(n, *place, n == number) for n, place in places.items())
    step, (miss, words) = thread.step_of(number), thread.words(number)
    first = places[1][0].rstrip("#")
    before = thread.words(number - 1)[0] if number in [*places][1:] else ""
    earlier = f"{thread.misses()['plan']:.1f} → " if before not in ("", miss) else ""
    said = f"miss {earlier}<b>{miss}</b>" if miss else f"photo 1: {words}"
    spoken = f"miss {earlier}{miss}: photo 1, {words}" if miss else said
    return (
        f'<nav class="vmc-thread" aria-label="The loop"><ol>{marks}</ol>'
        f'<a href="{first}#demo-whole-loop?photo=0&amp;step={step}" '
        f'aria-label="{spoken}. See this step in chapter 1">'
        f"{thread.picture(number, photo)}<span>{said}</span></a></nav>\n"
    )


def mark(number, address, title, here):
    """One of the loop's marks: a link to a chapter, lit where it is `here`."""
    name = escape(f"{number} {title}{', on the short path' * (number in SHORT)}", quote=True)
    lit = ' class="vmc-short-path"' * (number in SHORT) + ' aria-current="page"' * here
    return f'<li><a href="{address}" title="{name}" aria-label="{name}"{lit}></a></li>'
