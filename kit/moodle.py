"""Questions in Moodle XML, pictures included: a category a question, as in GIFT."""

from base64 import b64encode
from itertools import zip_longest

from kit.elements import element, xml
from kit.gift import category, item_names


def moodle_xml(bank):
    """The bytes of a file; `bank` maps (chapter, name) to the variants of a question.

    A prediction counts nothing: its grade is 0.
    """
    questions = []
    for (chapter, name), variants in bank.items():
        path = element("category", _text(category(chapter, name, variants)))
        questions.append(element("question", path, type="category"))
        questions += map(_question, item_names(f"{chapter} {name}", variants), variants)
    return xml(element("quiz", *questions))


def _question(name, question):
    files = []
    if question.picture:
        data = b64encode(question.picture.png).decode()
        files = [element("file", text=data, name="picture.png", path="/", encoding="base64")]
        question = question.with_picture("@@PLUGINFILE@@/picture.png")
    form = "html" if question.html else "plain_text"
    answers = (_choices if question.choices else _number)(question, form)
    return element(
        "question",
        element("name", _text(name)),
        element("questiontext", _text(question.prompt), *files, format=form),
        element("generalfeedback", _text(question.hint), format=form),
        element("defaultgrade", text="0" if question.level == "predict" else "1"),
        *answers,
        type="multichoice" if question.choices else "numerical",
    )


def _choices(question, form):
    pairs = zip_longest(question.choices, question.feedback, fillvalue="")
    return [
        element("single", text="true"),
        element("shuffleanswers", text="true"),
        element("answernumbering", text="none"),
        *(
            element(
                "answer",
                _text(choice),
                element("feedback", _text(feedback), format=form),
                fraction="100" if choice == question.answer else "0",
                format=form,
            )
            for choice, feedback in pairs
        ),
    ]


def _number(question, form):
    number, tolerance = map(question.decimal, (question.answer, question.tolerance))
    parts = _text(number), element("tolerance", text=tolerance)
    return [element("answer", *parts, fraction="100", format="plain_text")]


def _text(text):
    return element("text", text=text)
