"""Questions in QTI 1.2, which Canvas imports: a zip of one quiz a chapter.

A question is a group from which Canvas gives each student one variant.
"""

from functools import partial
from xml.etree import ElementTree

from kit.gift import item_names
from vmc_lib.show.packed import pack_zip

SPACE = "http://www.imsglobal.org/xsd/ims_qtiasiv1p2"
PACKAGE = "http://www.imsglobal.org/xsd/imsccv1p1/imscp_v1p1"
CANVAS = "http://canvas.instructure.com/xsd/cccv1p0"
SETTINGS = "associatedcontent/imscc_xmlv1p1/learning-application-resource"


def package(bank, kind="assignment"):
    """The bytes of the zip; `bank` maps (chapter, name) to the variants of a question.

    `kind` is what Canvas makes of a quiz: an "assignment", which it grades, or a "survey", which
    it does not. The same bank gives the same bytes.
    """
    chapters = {}
    for (chapter, name), variants in bank.items():
        chapters.setdefault(chapter, {})[name] = variants
    trees = {"imsmanifest.xml": _manifest(chapters)}
    for chapter, groups in chapters.items():
        trees[f"{chapter}/{chapter}.xml"] = _quiz(chapter, groups)
        trees[f"{chapter}/assessment_meta.xml"] = _settings(chapter, len(groups), kind)
    text = partial(ElementTree.tostring, encoding="utf-8", xml_declaration=True)
    return pack_zip({path: text(tree) for path, tree in trees.items()})


def _element(tag, *children, text=None, **attributes):
    """An element with its children in it."""
    element = ElementTree.Element(tag, attributes)
    element.text = text
    element.extend(children)
    return element


def _manifest(chapters):
    """Each quiz with its questions, and the settings that Canvas reads beside them."""
    resources = []
    for chapter in chapters:
        needs = _element("dependency", identifierref=f"{chapter}.settings")
        questions = _element("file", href=f"{chapter}/{chapter}.xml")
        settings = f"{chapter}/assessment_meta.xml"
        resources += [
            _element("resource", questions, needs, identifier=chapter, type="imsqti_xmlv1p2"),
            _element(
                "resource",
                _element("file", href=settings),
                identifier=f"{chapter}.settings",
                type=SETTINGS,
                href=settings,
            ),
        ]
    parts = _element("organizations"), _element("resources", *resources)
    return _element("manifest", *parts, identifier="quiz-bank", xmlns=PACKAGE)


def _settings(chapter, points, kind):
    texts = {
        "title": chapter,
        "shuffle_answers": "true",
        "quiz_type": kind,
        "points_possible": f"{points}.0",
        "show_correct_answers": "true",
        "allowed_attempts": "1",
    }
    parts = (_element(name, text=text) for name, text in texts.items())
    return _element("quiz", *parts, identifier=chapter, xmlns=CANVAS)


def _quiz(chapter, groups):
    sections = (_group(chapter, name, variants) for name, variants in groups.items())
    root = _element("section", *sections, ident="root_section")
    quiz = _element("assessment", root, ident=chapter, title=chapter)
    return _element("questestinterop", quiz, xmlns=SPACE)


def _group(chapter, name, variants):
    selection = _element(
        "selection_ordering",
        _element(
            "selection",
            _element("selection_number", text="1"),
            _element("selection_extension", _element("points_per_item", text="1.0")),
        ),
    )
    items = map(_item, item_names(f"{chapter} {name}", variants), variants)
    return _element("section", selection, *items, ident=f"{chapter}.{name}", title=name)


def _item(name, question):
    kind = "multiple_choice_question" if question.choices else "numerical_question"
    fields = {"question_type": kind, "points_possible": "1.0", "level": question.level}
    meta = (
        _element(
            "qtimetadatafield",
            _element("fieldlabel", text=label),
            _element("fieldentry", text=entry),
        )
        for label, entry in fields.items()
    )
    response, right = (_choices if question.choices else _number)(question)
    score = {"varname": "SCORE", "vartype": "Decimal", "minvalue": "0", "maxvalue": "100"}
    full = _element("setvar", text="100", action="Set", varname="SCORE")
    texts = {f"choice{k}": text for k, text in enumerate(question.feedback)}
    chosen = [_shows(_element("varequal", text=k, respident="response1"), f"{k}_fb") for k in texts]
    feedback = {f"{k}_fb": text for k, text in texts.items()}
    if question.hint:
        chosen.insert(0, _shows(_element("other"), "general_fb"))
        feedback["general_fb"] = question.hint
    return _element(
        "item",
        _element("itemmetadata", _element("qtimetadata", *meta)),
        _element("presentation", _material(question.prompt, question), response),
        _element(
            "resprocessing",
            _element("outcomes", _element("decvar", **score)),
            *chosen,
            _element("respcondition", _element("conditionvar", right), full, **{"continue": "No"}),
        ),
        *(
            _element("itemfeedback", _element("flow_mat", _material(text, question)), ident=ident)
            for ident, text in feedback.items()
        ),
        ident=name.replace(" ", "."),
        title=name,
    )


def _shows(condition, ident):
    """What is shown after an answer, whatever its score."""
    shown = _element("displayfeedback", feedbacktype="Response", linkrefid=ident)
    return _element(
        "respcondition", _element("conditionvar", condition), shown, **{"continue": "Yes"}
    )


def _material(text, question):
    kind = "text/html" if question.html else "text/plain"
    return _element("material", _element("mattext", text=text, texttype=kind))


def _choices(question):
    labels = [
        _element("response_label", _material(text, question), ident=f"choice{k}")
        for k, text in enumerate(question.choices)
    ]
    response = _element(
        "response_lid",
        _element("render_choice", *labels),
        ident="response1",
        rcardinality="Single",
    )
    right = f"choice{question.choices.index(question.answer)}"
    return response, _element("varequal", text=right, respident="response1")


def _number(question):
    field = _element("render_fib", _element("response_label", ident="answer1"), fibtype="Decimal")
    response = _element("response_str", field, ident="response1", rcardinality="Single")
    exact, low, high = (
        question.decimal(question.answer + k * question.tolerance) for k in (0, -1, 1)
    )
    bounds = _element(
        "and",
        _element("vargte", text=low, respident="response1"),
        _element("varlte", text=high, respident="response1"),
    )
    equal = _element("varequal", text=exact, respident="response1")
    return response, _element("or", equal, bounds)
