"""Questions in QTI 1.2, which Canvas imports: a zip of one quiz a chapter.

A question is a group from which Canvas gives each student one variant.
"""

from kit.elements import element, xml
from kit.gift import item_names
from vmc_lib.show.packed import pack_zip

SPACE = "http://www.imsglobal.org/xsd/ims_qtiasiv1p2"
PACKAGE = "http://www.imsglobal.org/xsd/imsccv1p1/imscp_v1p1"
CANVAS = "http://canvas.instructure.com/xsd/cccv1p0"
SETTINGS = "associatedcontent/imscc_xmlv1p1/learning-application-resource"
FILE = "webcontent"
ROOT = "%24IMS-CC-FILEBASE%24/"  # of the zip's files, to Canvas


def package(bank, kind="assignment"):
    """The bytes of the zip; `bank` maps (chapter, name) to the variants of a question.

    `kind` is what Canvas makes of a quiz: an "assignment", which it grades, or a "survey", which
    it does not. The same bank gives the same bytes.
    """
    chapters = {}
    for (chapter, name), variants in bank.items():
        chapters.setdefault(chapter, {})[name] = variants
    pictures = {}
    for (chapter, name), variants in bank.items():
        for title, question in zip(
            item_names(f"{chapter} {name}", variants), variants, strict=True
        ):
            if question.picture:
                pictures[_path(title)] = question.picture.png
    trees = {"imsmanifest.xml": _manifest(chapters, pictures)}
    for chapter, groups in chapters.items():
        trees[f"{chapter}/{chapter}.xml"] = _quiz(chapter, groups)
        trees[f"{chapter}/assessment_meta.xml"] = _settings(chapter, len(groups), kind)
    return pack_zip({path: xml(tree) for path, tree in trees.items()} | pictures)


def _path(title):
    """Where the picture of an item lies in the zip."""
    return f"pictures/{title.replace(' ', '-')}.png"


def _manifest(chapters, pictures):
    """Each quiz with its questions, the settings that Canvas reads beside them, and pictures."""
    resources = [
        element("resource", element("file", href=path), identifier=path, type=FILE, href=path)
        for path in pictures
    ]
    for chapter in chapters:
        needs = element("dependency", identifierref=f"{chapter}.settings")
        questions = element("file", href=f"{chapter}/{chapter}.xml")
        settings = f"{chapter}/assessment_meta.xml"
        resources += [
            element("resource", questions, needs, identifier=chapter, type="imsqti_xmlv1p2"),
            element(
                "resource",
                element("file", href=settings),
                identifier=f"{chapter}.settings",
                type=SETTINGS,
                href=settings,
            ),
        ]
    parts = element("organizations"), element("resources", *resources)
    return element("manifest", *parts, identifier="quiz-bank", xmlns=PACKAGE)


def _settings(chapter, points, kind):
    texts = {
        "title": chapter,
        "shuffle_answers": "true",
        "quiz_type": kind,
        "points_possible": f"{points}.0",
        "show_correct_answers": "true",
        "allowed_attempts": "1",
    }
    parts = (element(name, text=text) for name, text in texts.items())
    return element("quiz", *parts, identifier=chapter, xmlns=CANVAS)


def _quiz(chapter, groups):
    sections = (_group(chapter, name, variants) for name, variants in groups.items())
    root = element("section", *sections, ident="root_section")
    quiz = element("assessment", root, ident=chapter, title=chapter)
    return element("questestinterop", quiz, xmlns=SPACE)


def _group(chapter, name, variants):
    selection = element(
        "selection_ordering",
        element(
            "selection",
            element("selection_number", text="1"),
            element("selection_extension", element("points_per_item", text="1.0")),
        ),
    )
    items = map(_item, item_names(f"{chapter} {name}", variants), variants)
    return element("section", selection, *items, ident=f"{chapter}.{name}", title=name)


def _item(name, question):
    if question.picture:
        question = question.with_picture(ROOT + _path(name))
    kind = "multiple_choice_question" if question.choices else "numerical_question"
    fields = {"question_type": kind, "points_possible": "1.0", "level": question.level}
    meta = (
        element(
            "qtimetadatafield",
            element("fieldlabel", text=label),
            element("fieldentry", text=entry),
        )
        for label, entry in fields.items()
    )
    response, right = (_choices if question.choices else _number)(question)
    score = {"varname": "SCORE", "vartype": "Decimal", "minvalue": "0", "maxvalue": "100"}
    full = element("setvar", text="100", action="Set", varname="SCORE")
    texts = {f"choice{k}": text for k, text in enumerate(question.feedback)}
    chosen = [
        _show_feedback(element("varequal", text=k, respident="response1"), f"{k}_fb") for k in texts
    ]
    feedback = {f"{k}_fb": text for k, text in texts.items()}
    if question.hint:
        chosen.insert(0, _show_feedback(element("other"), "general_fb"))
        feedback["general_fb"] = question.hint
    return element(
        "item",
        element("itemmetadata", element("qtimetadata", *meta)),
        element("presentation", _material(question.prompt, question), response),
        element(
            "resprocessing",
            element("outcomes", element("decvar", **score)),
            *chosen,
            element("respcondition", element("conditionvar", right), full, **{"continue": "No"}),
        ),
        *(
            element("itemfeedback", element("flow_mat", _material(text, question)), ident=ident)
            for ident, text in feedback.items()
        ),
        ident=name.replace(" ", "."),
        title=name,
    )


def _show_feedback(condition, ident):
    """What is shown after an answer, whatever its score."""
    shown = element("displayfeedback", feedbacktype="Response", linkrefid=ident)
    return element(
        "respcondition", element("conditionvar", condition), shown, **{"continue": "Yes"}
    )


def _material(text, question):
    kind = "text/html" if question.html else "text/plain"
    return element("material", element("mattext", text=text, texttype=kind))


def _choices(question):
    labels = [
        element("response_label", _material(text, question), ident=f"choice{k}")
        for k, text in enumerate(question.choices)
    ]
    response = element(
        "response_lid",
        element("render_choice", *labels),
        ident="response1",
        rcardinality="Single",
    )
    right = f"choice{question.choices.index(question.answer)}"
    return response, element("varequal", text=right, respident="response1")


def _number(question):
    field = element("render_fib", element("response_label", ident="answer1"), fibtype="Decimal")
    response = element("response_str", field, ident="response1", rcardinality="Single")
    exact, low, high = (
        question.decimal(question.answer + k * question.tolerance) for k in (0, -1, 1)
    )
    bounds = element(
        "and",
        element("vargte", text=low, respident="response1"),
        element("varlte", text=high, respident="response1"),
    )
    equal = element("varequal", text=exact, respident="response1")
    return response, element("or", equal, bounds)
