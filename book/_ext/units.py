"""A number and its unit stay on one line: "9 mm", "95 %", "2 × 6"."""

import re

from book._ext.numbering import CLOSED, TAG, prose_in

UNIT = r"(?:mm|cm|ms|min|kg|kB|MB|GB|Hz|rad|px|[mshgNV]|%|°)(?![\w’'])"
WITHIN = re.compile(rf"(?<=\d)\s(?={UNIT}|×\s\d)|(?<=\d\s×)\s(?=\d)|(?<=\bN)\s(?=m\b)")
AFTER = re.compile(rf"\s(?={UNIT})")
ENDS = re.compile(r"\d(?:\\\))?\Z")  # in maths, too
INLINE = re.compile(r"</?(?:strong|em|b|i|span)\b|\Z")
TABULAR = {"form", "table"}  # whose columns are as narrow as they need to be


def setup(app):
    app.connect("html-page-context", bind_units, priority=960)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def bind_units(app, pagename, templatename, context, doctree):
    context["body"] = with_units(context.get("body", ""))


def with_units(body):
    """The HTML `body` with a no-break space between each number of its prose and the unit."""
    parts = TAG.split(body)
    for i in prose_in(parts, CLOSED | TABULAR):
        parts[i] = WITHIN.sub("\u00a0", parts[i])
        if AFTER.match(parts[i]) and ENDS.search(_text_before(parts, i)):
            parts[i] = "\u00a0" + parts[i][1:]
    return "".join(parts)


def _text_before(parts, i):
    """The text before part i in its line: "" where another element than of words lies between."""
    while i > 1 and INLINE.match(parts[i - 1]):
        i -= 2
        if parts[i]:
            return parts[i]
    return ""
