"""Numbers: every "Eq. 4" in the prose is a link to that equation, and every figure has a number.

The chapters say "Eq. 4" in plain words, which read well in a notebook too; the built page links
them, also in captions and in what cells print.
"""

import re
from functools import partial
from itertools import count
from pathlib import Path

REFERENCE = re.compile(r"Eqs?\.\s(\d+)(?:([–-]|\sto\s|\sand\s)(\d+))?")
EQUATION_NUMBER = re.compile(r"\\tag\{(\d+)\}")
DISPLAYED = re.compile(
    r'<div class="(?:amsmath )?math notranslate nohighlight"[^>]*>'
    rf"(?=(?:(?!</div>).)*?{EQUATION_NUMBER.pattern})",
    re.S,
)
FIGURE_NUMBER = re.compile(r"Figure ([\d.]+)</span>")  # as `with_figure_numbers` writes it
TAG = re.compile(r"(<[^>]+>)")
# Where no link may stand, or where the text is not prose
CLOSED = {"a", "button", "code", "h1", "h2", "h3", "label", "pre", "script", "style", "summary"}
CLOSED |= {"svg"}


def setup(app):
    app.connect("env-updated", find_equations)
    app.connect("html-page-context", add_numbers, priority=950)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def find_equations(app, env):
    """Where each numbered equation stands: on the last page that shows it, its own chapter."""
    env.equation_pages = {}
    for page in env.toctree_includes.get(env.config.root_doc, []):
        text = Path(env.doc2path(page)).read_text(encoding="utf-8")
        for tag in EQUATION_NUMBER.findall(text):
            env.equation_pages[tag] = page


def add_numbers(app, pagename, templatename, context, doctree):
    env, body = app.env, context.get("body", "")
    chapter = env.toc_secnumbers.get(pagename, {}).get("", ())
    body = with_links(body, env.equation_pages, partial(app.builder.get_relative_uri, pagename))
    here = {tag for tag, page in env.equation_pages.items() if page == pagename}
    context["body"] = with_figure_numbers(with_anchors(body, here), chapter)


def with_links(body, pages, uri):
    """The HTML `body` with each "Eq. N" of its prose a link to `uri(pages[N])`."""

    def link(found):
        tag = found[1]
        return f'<a href="{uri(pages[tag])}#eq-{tag}">{found[0]}</a>' if tag in pages else found[0]

    parts = TAG.split(body)
    for i in prose_in(parts, CLOSED):
        parts[i] = REFERENCE.sub(link, parts[i])
    return "".join(parts)


def prose_in(parts, shut):
    """Which `parts` of a body, split at its tags, are prose: in no maths, in no tag of `shut`."""
    closed, depth = None, 0
    for i, part in enumerate(parts):
        tag = re.match(r"<(/?)(\w+)", part)
        if not tag:
            if not closed:
                yield i
        elif tag[2] == closed:
            depth += -1 if tag[1] else 1
            closed = closed if depth else None
        elif not closed and not tag[1] and (tag[2] in shut or "math notranslate" in part):
            closed, depth = tag[2], 1


def equations_named(text):
    """The numbers of the equations that a text names, as "Eq. 5", "Eq. 6–7" or "Eq. 3 and 5"."""
    named = set()
    for first, word, last in REFERENCE.findall(text):
        ends = int(first), int(last or first)
        named.update(ends if "and" in word else range(ends[0], ends[1] + 1))
    return named


def with_anchors(body, tags):
    """The HTML `body` with a place to link to before the first equation of each of the `tags`."""
    left = set(tags)

    def mark_first(found):
        if found[1] not in left:
            return found[0]
        left.remove(found[1])
        return f'<span id="eq-{found[1]}"></span>{found[0]}'

    return DISPLAYED.sub(mark_first, body)


def with_figure_numbers(body, chapter):
    """The HTML `body` with its captions numbered: Figure 9.1, where `chapter` is (9,)."""
    numbers = (".".join(map(str, (*chapter, n))) for n in count(1))
    return re.sub(
        r"<figcaption[^>]*>",
        lambda found: f'{found[0]}<span class="vmc-number">Figure {next(numbers)}</span> ',
        body,
    )
