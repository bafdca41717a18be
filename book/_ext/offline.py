"""What makes the built book whole: no page asks anything of a network, or of a kernel."""

import os
import re
from pathlib import Path

from sphinx.errors import ExtensionError

from book._ext.policy import seal

SCRIPTS = {  # of page/book, and what a page must hold to need it: the first that it needs
    "photo.js": 'class="vmc-eye',
    "chapter.js": 'class="vmc-',
    "words.js": "",
}
NEEDS = {  # what a page must hold to need an asset; none needs thebe, which asks the network
    "thebe": r"(?!)",
    "katex": r'class="math|\\\(',
    "design": r'class="[^"]*\bsd-',
}
# Where Sphinx's search reads a word's pages: "constructor" is a property of every object
WORDS_PAGES = re.compile(r"files: (terms|titleTerms)\[word\]")
# Names, punctuation and spaces: coloured as all code is
COLOURLESS = re.compile(r'<span class="(?:n|nn|p|w)">([^<]*)</span>')


def setup(app):
    os.environ["VMC_RENDER_MODE"] = "book"  # kernels inherit it: demos become self-contained pages
    for script in SCRIPTS:
        app.add_js_file(script, defer="defer")
    app.set_html_assets_policy("always")  # equations may come from a cell's output, unannounced
    app.connect("config-inited", launch)
    app.connect("html-page-context", mend, priority=900)
    app.connect("autodoc-process-docstring", code_marks)
    app.connect("build-finished", seal_pages)
    app.connect("build-finished", mend_search)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def launch(app, config):
    """Give a chapter buttons that open it elsewhere, if the repository has a public address.

    It is the one in _config.yml, else the one that a build on GitHub gets.
    """
    options, env = config.html_theme_options, os.environ
    if not options.get("repository_url") and "GITHUB_REPOSITORY" in env:
        options["repository_url"] = "{GITHUB_SERVER_URL}/{GITHUB_REPOSITORY}".format_map(env)
    if not options.get("repository_url"):
        options.pop("launch_buttons", None)


def mend(app, pagename, templatename, context, doctree):
    """Mend the page's settings, its assets and its body."""
    body = context.get("body", "")
    lead_to_what_sets_itself_up(context)
    drop_needless_assets(app, context, body)
    settings_in_file(app, context)  # of those that are left
    context["body"] = mend_body(body)


def lead_to_what_sets_itself_up(context):
    """Let Colab's button open the chapters of their own branch, with a cell that fetches the book.

    Binder builds from the main branch, and has what it needs. The branch: see tools/colab.py.
    """
    for button in context.get("header_buttons", []):
        for one in button.get("buttons", [button]):
            if "colab.research.google.com" in (one.get("url") or ""):
                one["url"] = re.sub(r"/blob/[^/]+/", "/blob/colab/", one["url"])


def settings_in_file(app, context):
    """No settings inside the page, which a strict host forbids, but in a file."""
    files = context["script_files"]
    settings = dict.fromkeys(filter(None, (file.attributes.get("body") for file in files)))
    settings = [line for line in settings if "DOCUMENTATION_OPTIONS" not in line]  # Sphinx's own
    context["script_files"] = [one for one in files if one.attributes.get("body") not in settings]
    (static := Path(app.outdir, "_static")).mkdir(exist_ok=True)
    (static / "settings.js").write_text("\n".join(settings), encoding="utf-8")


def drop_needless_assets(app, context, body):
    """One script of ours; no other, and no style sheet, without use: KaTeX and fonts are .6 MB."""
    page = re.sub("<pre>.*?</pre>", "", body, flags=re.S)  # what is code asks for nothing
    needless = [asset for asset, mark in NEEDS.items() if not re.search(mark, page)]
    needed = next(script for script, mark in SCRIPTS.items() if re.search(mark, page))
    needless = "|".join([*needless, *(rf"/{script}" for script in SCRIPTS if script != needed)])
    for kind in ("script_files", "css_files"):
        context[kind] = [
            file
            for file in context[kind]
            if not re.search(needless, f"{file.filename} {file.attributes.get('body', '')}", re.I)
        ]


def mend_body(body):
    """The page's body without what is needless or wrong in it.

    No element around a word of code without a colour of its own; no list role on what is no list,
    no role that is out of use, and no label that hides a summary's own words; the number of an
    equation outside the `split` that Sphinx puts around its lines; the space before a solution's
    link outside it.
    """
    thebe = (
        r'<script type="text/x-thebe-config">.*?</script>(\s*<script>kernelName = .*?</script>)?'
    )
    body = COLOURLESS.sub(r"\1", re.sub(thebe, "", body, flags=re.S))
    body = re.sub(r"(\\tag\{[^}]*\})(\s*\\end\{split\})", r"\2\1", body)
    body = body.replace('<div role="list" class="citation-list">', "<div>")
    body = body.replace(' role="doc-biblioentry"', "")
    body = re.sub(r"(Solution to)(<a [^>]+>) ", r"\1 \2", body)
    return body.replace('<summary aria-label="Toggle hidden content">', "<summary>")


def seal_pages(app, exception):
    """Give each page its policy."""
    if app.builder.format != "html" or exception:
        return
    for path in Path(app.outdir).rglob("*.html"):
        page = path.read_text(encoding="utf-8")
        if (sealed := seal(page)) != page:
            path.write_text(sealed, encoding="utf-8", newline="\n")


def mend_search(app, exception):
    """Let the search find what its index holds, and no property that every object has."""
    if app.builder.format != "html" or exception:
        return
    path = Path(app.outdir, "_static/searchtools.js")
    path.write_text(own_words(path.read_text(encoding="utf-8")), encoding="utf-8", newline="\n")


def own_words(script):
    """Sphinx's search, or one that is mended already, with reads of the index's own words."""
    own = WORDS_PAGES.sub(r"files: Object.hasOwn(\1, word) ? \1[word] : undefined", script)
    if own.count("files: Object.hasOwn(") != 2:
        raise ExtensionError("searchtools.js reads its index in another way: see own_words")
    return own


def code_marks(app, what, name, obj, options, lines):
    """Docstrings mark code as Markdown does, with single backticks; reStructuredText needs two."""
    marked = re.sub(r"(?<!`)`([^`]+)`(?!`)", r"``\1``\\ ", "\n".join(lines))
    lines[:] = marked.split("\n")
