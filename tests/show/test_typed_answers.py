"""Typed answers: one rule in Python and in the page; what cannot be read is not wrong."""

import pytest

from vmc_lib.show import check, questions
from vmc_lib.show.answers import judge

WIDTH = 11.547, 0.1, "mm"
WIDTHS = (190, 190, 95), 0, "pixels"
OVERLAP = 1 / 9, 0.003, ""
DELAY = 70, 0, "ms"
PAIR = (0.5, -8), 0.01, "m"
ANSWERS = {  # question: {verdict: what readers type}
    WIDTH: {
        "right": """11.5|11,5|11.5 mm|11.5mm|1.15 cm|0.0115 m|11500 µm|11.5 Millimetres|23/2 mm
            1.15e1|1.15E+1 mm|1.15·10^1|1.15 × 10¹|115 * 10**-1|≈11.5|~ 11.5 mm|about 11.5|d = 11.5
            (11.5)|11.5 (mm)|[11.5]|11.5 mm.|11.5!|"11.5"|“11.5 mm”|１１.５|+11.5""",
        "wrong": "12|11.5 cm|11.5 km|-11.5|10^1|1/0|11.",
        "unit": "11.5 ms|11.5 s|11.5 mm/s|11.5 mm²|11.5 N·m|11.5 N m|11.5 %|11.5°",
        "unread": "x|mm|eleven|11 or 12|11-12|1 112|11½|11.5.2|²|20/tan(60)|20 / tan(60°)",
    },
    WIDTHS: {
        "right": """190 190 95|190, 190, 95|190,190,95|(190, 190, 95)|[190 190 95]|190 × 190, 95
            190x190x95|190, 190 and 95|190; 190; 95.|190 px, 190 px, 95 px|a = 190, b = 190, c = 95
            1.9e2 190 95 pixels""",
        "wrong": "190 190 96|95 190 190",
        "unit": "190 190 95 mm",
        "unread": "190|190 190|190 190 95 95|190 x 95",
    },
    OVERLAP: {
        "right": """1/9|1 / 9|⅑|0,111|.111|11.1 %|11 per cent|0.111 times|1/9 = 0.111
            1.11·10⁻¹|1.11 * 10^(-1)""",
        "wrong": "0.2|1|11|10^-1",
        "unit": "0.111 mm|0.111 of it",
        "unread": "one ninth|1:9",
    },
    DELAY: {"right": "70|70 ms|0.07 s|0,07 seconds", "wrong": "70 s|0.07", "unit": "70 mm"},
    PAIR: {"right": "0,5 −8|1/2; -8|0.5 m, -800 cm|x = 0,5, y = -8", "wrong": "0.5, 8"},
}
EVERY = [
    (question, verdict, text.strip())
    for question, verdicts in ANSWERS.items()
    for verdict, texts in verdicts.items()
    for text in texts.replace("\n", "|").split("|")
]


@pytest.mark.parametrize(("question", "verdict", "text"), EVERY)
def test_an_answer_is_read_as_people_write_it(question, verdict, text):
    expected, tolerance, unit = question
    assert judge(text, expected, tolerance, unit) == verdict


@pytest.mark.browser
def test_the_page_judges_as_python_does(open_page, outputs, book):
    forms = outputs(questions)
    for expected, tolerance, unit in ANSWERS:
        check(None, expected, tolerance, unit=unit)
    page = open_page(f"<h1>Q</h1>{''.join(forms)}")
    assert "in mm" in page.locator("form").first.inner_text()
    judged = page.evaluate(
        """texts => texts.map(([form, text]) => vmc["demo/questions"].judge(text,
          JSON.parse(document.querySelectorAll("form")[form].dataset.check)))""",
        [[list(ANSWERS).index(question), text] for question, _, text in EVERY],
    )
    assert judged == [verdict for _, verdict, _ in EVERY]
    page.fill("input >> nth=0", "11.5 s")
    page.keyboard.press("Enter")
    assert "Write it in mm, please" in page.inner_text("[role=status] >> nth=0")
