"""A page's content security policy: it runs what it was built with, and sends nothing to anyone."""

import re
from base64 import b64encode
from hashlib import sha256
from html import unescape
from pathlib import Path

from vmc_lib.show.packed import unpack_bytes

INTERPRETER = Path(__file__).parents[2] / "page/python/interpreter.js"
META = '<meta http-equiv="Content-Security-Policy" content="{}">'
POLICY = (
    "default-src 'none'; script-src {}; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; font-src 'self' data:; worker-src blob:; "
    "form-action 'self'; base-uri 'none'"
)
OLD = re.compile(META.format('[^"]*'))
CHARSET = re.compile('<meta charset="utf-8"[^>]*>', re.I)
SCRIPT = re.compile(r"<script\b([^>]*)>(.*?)</script>", re.S)
DATA = re.compile(r'\btype="(?:application|text/x)')
PACKED = re.compile(r'\bid="[\w.]+\.js"')  # a script that the page unpacks
HANDLER = re.compile(r'\son[a-z]+="([^"<>]+)"')
PYTHON = re.compile(r'data-function="|class="vmc-measure|\btag_(?:runs|draws)-in-page')
PHYSICS = re.compile(r'class="vmc-(?:live|eye)\b|src="arm\.js"')


def seal(page, *more, frames=""):
    """The HTML `page` with its policy, before all that the policy is to hold.

    It names by their sums the scripts that stand in the page, packed ones too, and `more` that
    those write; files may be loaded where the page names some, and text becomes code only for
    Python and the physics ('unsafe-eval'). `frames` are the pages that it may show inside.
    """
    page = OLD.sub("", page)
    scripts = [*_scripts(page), *more]
    markup = SCRIPT.sub(r"<script\1>", page)  # without the megabytes that are packed in scripts
    if python := PYTHON.search(markup):
        scripts.append(frame_script())
    handlers = [unescape(text) for text in HANDLER.findall(markup)]
    allowed = {
        "'self'": re.search(r"<script[^>]*\ssrc=", markup),
        "'unsafe-eval'": python or PHYSICS.search(markup),
        "'unsafe-hashes'": handlers,
    }
    allowed = [name for name, needed in allowed.items() if needed]
    allowed += sorted(set(map(hash_source, scripts + handlers)))
    meta = META.format(POLICY.format(" ".join(allowed) or "'none'"))
    if frames:
        meta = meta.replace("; form-action", f"; frame-src {frames}; form-action")
    charset = CHARSET.search(page)
    before = charset.end() if charset else 0
    return page[:before] + meta + page[before:]


def _scripts(page):
    """The texts of the scripts that stand in a page."""
    for attributes, text in SCRIPT.findall(page):
        if PACKED.search(attributes):
            yield unpack_bytes(text).decode()
        elif not DATA.search(attributes) and text:
            yield text


def hash_source(script):
    """How a policy names the text of a script: its SHA-256, in base64."""
    return f"'sha256-{b64encode(sha256(script.encode()).digest()).decode()}'"


def frame_script():
    """The script of the frame in which the page's Python lives."""
    lines = re.search(r"const OPEN = (.+?);\n", INTERPRETER.read_text(encoding="utf-8"), re.S)[1]
    return "".join(re.findall('"(.*)"', lines))
