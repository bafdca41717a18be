"""What platforms import: the bank in GIFT and in QTI."""

import io
import re
from base64 import b64decode
from collections import Counter
from html import unescape
from urllib.parse import unquote
from xml.etree import ElementTree
from zipfile import ZipFile

import nbformat
import numpy as np
import pytest
from nbformat.v4 import new_markdown_cell, new_notebook

from kit.__main__ import CHAPTERS
from kit.bank import bank
from kit.chapter_questions import bank_questions
from kit.gift import gift
from kit.moodle import moodle_xml
from kit.qti import SPACE, package
from tests.project import sample


@pytest.fixture(scope="module")
def variants():
    """The bank, and what the chapters ask."""
    notebooks = {path.stem: nbformat.read(path, as_version=4) for path in CHAPTERS}
    return bank() | {
        (chapter, name): several
        for chapter, notebook in notebooks.items()
        for name, several in bank_questions(notebook, chapter).items()
    }


def test_the_chapters_own_questions_are_most_of_the_bank_and_say_why(variants):
    levels = Counter(several[0].level for several in variants.values())
    assert levels["apply"] <= levels["predict"] + levels["understand"]
    for (chapter, name), [question, *_] in variants.items():
        if re.match("prediction|quiz", name):
            assert question.answer in question.choices
            assert question.hint or all(question.feedback), (chapter, name)
            assert not re.search(r"<(?!/?(em|strong|code)>)\w", question.text)


def without_pictures(variants):
    return {key: several for key, several in variants.items() if not several[0].picture}


PREDICTION = """**Predict.** Which?

- this
- that

<details><summary>What came out</summary>

**that.** So it is.

</details>"""
TEXT = r"(?:[^~=#{}:\\]|\\[~=#{}:\\])+"
NUMBER = r"-?\d+(?:\.\d+)?"  # the grammar has no exponents
ITEM = re.compile(
    rf"::{TEXT}::\[(?:plain|html)\]{TEXT}\{{"
    rf"(?:#{NUMBER}:{NUMBER}|(?:\n[=~]{TEXT}(?:#{TEXT})?)+)(?:\n####{TEXT})?\n\}}"
)


def test_gift_follows_its_grammar(variants):
    variants = without_pictures(variants)
    items = []
    for block in gift(variants).split("\n\n"):
        if not re.fullmatch(r"\$CATEGORY: \$course\$/\w+/\w+/\w+", block):
            assert ITEM.fullmatch(block), block
            items.append(block)
    assert len(items) == sum(map(len, variants.values()))
    for block in items:
        assert len(re.findall(r"(?<!\\)=", block)) == (0 if "{#" in block else 1)


def test_a_number_is_exported_to_a_fraction_of_its_tolerance(variants):
    for question in (question for several in variants.values() for question in several):
        if not question.choices:
            error = abs(float(question.decimal(question.answer)) - question.answer)
            assert error <= question.tolerance / 100


def test_gift_accepts_a_number_within_its_tolerance(variants):
    questions = [q for several in without_pictures(variants).values() for q in several]
    wanted = [(q.answer, q.tolerance) for q in questions if not q.choices]
    exported = re.findall(rf"\{{#({NUMBER}):({NUMBER})", gift(variants))
    assert np.array(exported, float) == pytest.approx(np.array(wanted), rel=0.01)


# Of QTI 1.2: what an element may hold, in this order (the parts that the bank uses)
MODEL = {
    "questestinterop": "assessment",
    "assessment": "section+",
    "section": "selection_ordering?(section|item)+",
    "selection_ordering": "selection",
    "selection": "selection_number selection_extension",
    "item": "itemmetadata presentation resprocessing itemfeedback*",
    "itemmetadata": "qtimetadata",
    "qtimetadata": "qtimetadatafield+",
    "qtimetadatafield": "fieldlabel fieldentry",
    "presentation": "material(response_lid|response_str)",
    "response_lid": "render_choice",
    "response_str": "render_fib",
    "render_choice": "response_label+",
    "render_fib": "response_label",
    "response_label": "material?",
    "resprocessing": "outcomes respcondition+",
    "outcomes": "decvar",
    "respcondition": "conditionvar setvar?displayfeedback?",
    "conditionvar": "(varequal|or|other)",
    "or": "varequal and",
    "and": "vargte varlte",
    "itemfeedback": "flow_mat",
    "flow_mat": "material",
    "material": "mattext",
    "selection_extension": "points_per_item",
}


def assert_model(element):
    """Each element holds what QTI allows it, and no two items have one ident."""
    name = element.tag.removeprefix(f"{{{SPACE}}}")
    held = "".join(f"<{child.tag.removeprefix(f'{{{SPACE}}}')}>" for child in element)
    assert re.fullmatch(re.sub(r"(\w+) ?", r"(?:<\1>)", MODEL.get(name, "")), held), (name, held)
    idents = [child.get("ident") for child in element if child.get("ident")]
    assert len({*idents}) == len(idents)
    for child in element:
        assert_model(child)


LARGEST = 30_000  # bytes of a picture
MANIFEST = "imsmanifest.xml"


@pytest.mark.parametrize("kind", ["assignment", "survey"])
def test_canvas_is_told_whether_a_quiz_is_graded(variants, kind):
    zipped = ZipFile(io.BytesIO(package(without_pictures(variants), kind)))
    for path in (name for name in zipped.namelist() if name.endswith("assessment_meta.xml")):
        settings = ElementTree.fromstring(zipped.read(path))  # noqa: S314 (our own)
        assert settings.find("{*}quiz_type").text == kind


variants_each = pytest.mark.parametrize("count", sample([2, None], 2))  # each draws a picture


@variants_each
def test_qti_is_well_formed_and_each_item_accepts_its_answer(variants, count):
    variants = {name: several[:count] for name, several in variants.items()}
    packed = package(variants)
    assert package(variants) == packed
    zipped = ZipFile(io.BytesIO(packed))
    manifest = ElementTree.fromstring(zipped.read(MANIFEST))  # noqa: S314 (our own)
    files = [file.get("href") for file in manifest.findall(".//{*}file")]
    pictures = [path for path in files if path.startswith("pictures/")]
    assert all(len(zipped.read(path)) < LARGEST for path in pictures)
    chapters = [path.stem for path in CHAPTERS]
    settings = [f"{chapter}/assessment_meta.xml" for chapter in chapters]
    quizzes = [f"{chapter}/{chapter}.xml" for chapter in chapters]
    wanted = sorted(settings + quizzes + pictures)
    assert sorted(files) == wanted == sorted({*zipped.namelist()} - {MANIFEST})
    identifiers = {one.get("identifier") for one in manifest.findall(".//{*}resource")}
    needed = {one.get("identifierref") for one in manifest.findall(".//{*}dependency")}
    assert needed == identifiers - {*chapters, *pictures}
    items = {}
    for path in quizzes:
        tree = ElementTree.fromstring(zipped.read(path))  # noqa: S314
        assert tree.tag == f"{{{SPACE}}}questestinterop"
        assert_model(tree)
        items |= {item.get("title"): item for item in tree.findall(".//{*}item")}
    assert len(items) == sum(map(len, variants.values()))
    for (chapter, name), several in variants.items():
        for k, question in enumerate(several, start=1):
            item = items[f"{chapter} {name} {k}"]
            scored = item.find(".//{*}setvar/..")
            right = scored.find(".//{*}varequal").text
            shown = {one.get("linkrefid") for one in item.findall(".//{*}displayfeedback")}
            images = re.findall(r'src="(.+?)"', item.find(".//{*}mattext").text)
            assert len(images) == bool(question.picture)
            assert {unquote(src).removeprefix("$IMS-CC-FILEBASE$/") for src in images} <= {
                *pictures
            }
            kept = {one.get("ident") for one in item.findall("{*}itemfeedback")}
            assert shown == kept
            assert shown
            if question.choices:
                labels = {x.get("ident"): x for x in item.findall(".//{*}response_label")}
                assert unescape(labels[right].find(".//{*}mattext").text) == question.answer
            else:
                bounds = [float(item.find(f".//{{*}}{tag}").text) for tag in ("vargte", "varlte")]
                error = max(question.tolerance / 100, 1e-12)
                wanted = [question.answer + k * question.tolerance for k in (-1, 1)]
                assert bounds == pytest.approx(wanted, abs=error)
                assert float(right) == pytest.approx(question.answer, abs=error)


@variants_each
def test_moodle_xml_accepts_each_answer_and_holds_its_picture(variants, count):
    variants = {name: several[:count] for name, several in variants.items()}
    document = ElementTree.fromstring(moodle_xml(variants))  # noqa: S314 (our own)
    items = {item.findtext("name/text"): item for item in document if item.find("category") is None}
    assert len(items) == sum(map(len, variants.values()))
    assert len(document) == len(items) + len(variants)  # a category each
    for (chapter, name), several in variants.items():
        for k, question in enumerate(several, start=1):
            item = items[f"{chapter} {name} {k}"]
            assert item.findtext("defaultgrade") == str(int(question.level != "predict"))
            answers = {unescape(a.findtext("text")): a for a in item.findall("answer")}
            [right] = [text for text, a in answers.items() if a.get("fraction") == "100"]
            if question.choices:
                wanted = map(unescape, (*question.choices, question.answer))
                assert [*answers, right] == [*wanted]
            else:
                error = max(question.tolerance / 100, 1e-12)
                assert float(right) == pytest.approx(question.answer, abs=error)
                tolerance = float(answers[right].findtext("tolerance"))
                assert tolerance == pytest.approx(question.tolerance, abs=error)
            files = item.findall("questiontext/file")
            assert len(files) == bool(question.picture)
            for file in files:
                assert f"@@PLUGINFILE@@/{file.get('name')}" in item.findtext("questiontext/text")
                assert b64decode(file.text).startswith(b"\x89PNG")


def test_a_prediction_leads_to_its_figure():
    cells = [
        new_markdown_cell("# Names: *what*\n\nIt begins."),
        new_markdown_cell("**Figure.** One."),
        new_markdown_cell(PREDICTION),
        new_markdown_cell("**Figure.** Two."),
        new_markdown_cell(PREDICTION),
        new_markdown_cell("## More"),
        new_markdown_cell("**Figure.** Three."),
    ]
    notebook = new_notebook(cells=cells)
    own, other = "<em>Names: *what*</em>, Figure 6.2", "<em>Names: *what*</em>, after Figure 6.2"
    places = {
        (): (f"({own})", f"({other})"),
        ("figure-6-2", "figure-6-3"): (
            f"({own}: <code>demos/figure-6-2.html</code> of the kit)",
            f"({other})",
        ),
    }
    for demos, wanted in places.items():
        questions = bank_questions(notebook, "06_names", demos).values()
        assert tuple(question.text for [question] in questions) == tuple(
            f"Which? {place}" for place in wanted
        )
    first, _ = bank_questions(
        notebook, "06_names", places.popitem()[0], "https://a.b/kit/"
    ).values()
    assert '<a href="https://a.b/kit/demos/figure-6-2.html">its demo</a>' in first[0].text
