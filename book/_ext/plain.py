"""A chapter's plain Markdown, which reads well in any notebook, in Sphinx's own words.

A link to the glossary becomes a term, its sections become definitions, a link to the sources a
citation. A cell that carries the tag `optional` begins a section that the page folds. A cell whose
metadata name an `exercise` becomes that exercise, the cells after it that carry the tag `solution`
become its solution, and a quotation that begins with a line in bold becomes an admonition. A quiz,
whose folded answers begin with ✓ or ✗, gets the page's own style, and so does a prediction. A cell
`**Figure.** …` becomes the caption of the figure above it. What only a notebook needs to say
carries the tag `remove-cell`.
"""

import json
import re
from html import escape
from itertools import groupby
from pathlib import Path
from textwrap import indent

from vmc_lib.show import prose
from vmc_lib.show.questions import prediction, question_name

GLOSSARY = Path(__file__).parents[1] / "glossary.md"
HEAD = re.compile(r"^## (.+)\n", re.M)
TERMS = {
    head.replace(" ", "-"): head for head in HEAD.findall(GLOSSARY.read_text(encoding="utf-8"))
}
TERM = re.compile(r"\[([^\]]+)\]\((?:glossary\.md)?#([^)]+)\)")
TERM_LINK = re.compile(r'<a (class="reference internal" href="[^"#]*#term-([^"]+)")')
SENTENCE = re.compile(r".+?\.(?= |$)")
SOURCE = r"\[[^\]]+\]\(references\.bib#(\w+)\)"
SOURCES = re.compile(rf"\({SOURCE}(?:, {SOURCE})*\)")
EXERCISE = re.compile(r"\*\*Exercise(?:: (.+))?\*\*\n\n")
FOLD = re.compile(r"\A<details><summary>Show the solution</summary>\n\n(.*)\n\n</details>\Z", re.S)
BOX = re.compile(r"^> \*\*(.+)\*\*\n((?:>.*\n?)+)", re.M)

QUIZ = re.compile(r"\*\*Quiz\.\*\* (.+)\n\n(<details>[\s\S]+</details>)")
ANSWER = re.compile(r"<details><summary>(.+)</summary>\n\n([✓✗]) (\S[\s\S]*?)\n\n</details>")
PREDICTION = re.compile(
    r"\*\*Predict\.\*\* (.+)\n\n((?:- .+\n)+)\n"
    r"<details><summary>What came out</summary>\n\n\*\*(.+)\.\*\* (.+)\n\n</details>"
)
CHOICE = re.compile(r"^- (.+)", re.M)
WRITTEN_CAPTION = re.compile(r"\*\*Figure\.\*\* ([\s\S]+)")
CAPTION = re.compile(
    r"</figure>((?:(?!<figure).)*?)<figcaption>\s*<p>(.*?)</p>\s*</figcaption>", re.S
)
SIDE = re.compile(r"\b(Left|Right)(?=:)")
STACKED = {"Left": "Above", "Right": "Below"}
VERDICTS = {"✓": ("right", "✓ Right."), "✗": ("wrong", "✗ No.")}


def setup(app):
    app.connect("source-read", translate)
    app.connect("html-page-context", give_captions)
    app.connect("html-page-context", give_cards)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def translate(app, page, source):
    path = Path(app.env.doc2path(page))
    if path == GLOSSARY:
        source[0] = definitions(source[0])
    if path.suffix == ".ipynb":
        notebook = json.loads(source[0])
        notebook["cells"] = list(with_directives(notebook["cells"]))
        source[0] = json.dumps(notebook)


def definitions(text):
    """The glossary's text, its sections as Sphinx's own definitions."""
    first, *rest = HEAD.split(TERM.sub(_term, text))
    pairs = zip(rest[::2], rest[1::2], strict=True)
    defined = "\n\n".join(f"{head}\n{indent(text.strip(), '  ')}" for head, text in pairs)
    return f"{first}```{{glossary}}\n{defined}\n```\n"


def give_captions(app, pagename, templatename, context, doctree):
    """Put each caption into the figure above it."""

    def within(found):
        return f"<figcaption>{SIDE.sub(_side, found[2])}</figcaption></figure>{found[1]}"

    context["body"] = CAPTION.sub(within, context.get("body", ""))


def _side(found):
    """A side's name, and what the style sheet calls it where pictures stand one below the other."""
    return f'<span data-stacked="{STACKED[found[1]]}"><span>{found[1]}</span></span>'


def give_cards(app, pagename, templatename, context, doctree):
    """Give each link to a term a card for the style sheet: the glossary's first sentence."""
    texts = HEAD.split(GLOSSARY.read_text(encoding="utf-8"))[1:]
    cards = {h.replace(" ", "-"): card(t) for h, t in zip(texts[::2], texts[1::2], strict=True)}

    def link(found):
        said = cards.get(found[2])
        return f'<a data-card="{escape(said)}" {found[1]}' if said else found[0]

    context["body"] = TERM_LINK.sub(link, context.get("body", ""))


def card(text):
    """The first sentence of a term's text, without marks; "" where it needs mathematics."""
    words = TERM.sub(r"\1", " ".join(text.split())).replace("*", "")
    sentence = SENTENCE.match(words)[0]
    return "" if "$" in sentence else sentence


def with_directives(cells):
    """The cells, each with Sphinx's own words, and between them where a solution starts and ends.

    ValueError for a solution that follows no exercise.
    """
    label = None
    cells = (cell for cell in cells if "remove-cell" not in _tags(cell))
    for solving, group in groupby(cells, _solves):
        if solving and not label:
            raise ValueError("a solution follows no exercise; name the `exercise` in its metadata")
        if solving:
            yield _cell(f"{label}-start", f"{{solution-start}} {label}\n:class: dropdown")
        for cell in group:
            label = cell["metadata"].get("exercise", label)
            if cell["cell_type"] == "markdown":
                cell["source"] = _text("".join(cell["source"]), cell["metadata"])
            if "optional" in _tags(cell):
                cell["source"] = "{.vmc-optional}\n" + cell["source"]
            yield cell
        if solving:
            yield _cell(f"{label}-end", "{solution-end}")


def _solves(cell):
    return "solution" in _tags(cell)


def _tags(cell):
    return cell["metadata"].get("tags", [])


def _cell(name, directive):
    source = f"````{directive}\n````"
    return {"cell_type": "markdown", "id": name, "metadata": {}, "source": source}


def _text(text, metadata):
    text = prose.COMMENT.sub("", text)
    if predicted := PREDICTION.fullmatch(text):
        question, choices, outcome, why = predicted.groups()
        choices = CHOICE.findall(choices)
        return with_guess(prediction(question, choices, outcome, why), choices, metadata)
    text = TERM.sub(_term, text)
    if caption := WRITTEN_CAPTION.fullmatch(text):
        text = f"<figcaption>\n\n{caption[1]}\n\n</figcaption>"
    if quiz := QUIZ.fullmatch(text):
        text = _quiz(*quiz.groups())
    text = SOURCES.sub(_cite, FOLD.sub(r"\1", text))
    text = BOX.sub(_box, text)
    if "exercise" not in metadata:
        return text
    title = EXERCISE.match(text)
    return (
        f":::{{exercise}} {title[1] or ''}\n:label: {metadata['exercise']}\n\n"
        f"{text[title.end() :]}\n:::"
    )


def with_guess(box, choices, metadata):
    """A prediction's box that says where its choices lie on the next figure, if its cell does.

    Its metadata's `guess` is an axis and a number for each choice, as "y 0.1 0.67 1" (page/demo/
    guess.js). ValueError for another number of them.
    """
    if not (guess := metadata.get("guess")):
        return box
    if len(re.findall(r" -?[\d.]+", guess)) != len(choices):
        raise ValueError(f"a guess on {guess!r} needs a number for each of {choices}")
    return box.replace("<fieldset ", f'<fieldset data-guess="{guess}" ')


def _quiz(question, answers):
    """A quiz: each answer, when opened, says whether it is right, and why.

    ValueError for fewer than two answers, one without a verdict and a why, or another number of
    right ones than one.
    """
    found = [mark for _, mark, _ in ANSWER.findall(answers)]
    if not len(found) == answers.count("<details>") >= 2 or found.count("✓") != 1:
        raise ValueError(
            f"the quiz {question!r} needs two or more answers, one of them right; after its "
            f"<summary> and an empty line each goes on with ✓ or ✗ and why: got {answers}"
        )
    name = question_name("quiz", question)
    legend = f'<fieldset class="vmc-quiz" name="{name}"><legend>\n\n{question}\n\n</legend>'
    return f"{legend}\n\n{ANSWER.sub(_answer, answers)}\n\n</fieldset>"


def _answer(answer):
    kind, verdict = VERDICTS[answer[2]]
    return (
        f'<details class="vmc-{kind}"><summary>{answer[1]}</summary>\n\n'
        f"**{verdict}** {answer[3]}\n\n</details>"
    )


def _term(link):
    return f"{{term}}`{link[1]} <{TERMS[link[2]]}>`"


def _cite(links):
    keys = re.findall(SOURCE, links[0])
    return f"{{cite}}`{','.join(keys)}`"


def _box(quotation):
    inside = re.sub(r"^> ?", "", quotation[2], flags=re.M).strip()
    return f"```{{admonition}} {quotation[1]}\n{inside}\n```\n"
