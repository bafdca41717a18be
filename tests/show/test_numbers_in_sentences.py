"""Numbers of a demo in the sentences below it."""

import re

import pytest

from vmc_lib.show import Pad, Slider, demo, explore, figures, markdown
from vmc_lib.show.numbers import Numbers

WORDS = "1,200 boxes → 3: precision 0.82 (0.7 to 0.9), recall −0.51."
ONE = Numbers("demo-7", WORDS, {"load": "1 kg"})


@pytest.mark.parametrize(
    ("place", "text"),
    [
        ("# boxes", "1,200"),
        ("→ #:", "3"),
        ("(# to", "0.7"),
        ("recall #", "−0.51"),
        ("load", "1 kg"),
    ],
)
def test_a_number_is_read_at_its_place(place, text):
    assert re.sub("<.*?>", "", ONE[place]) == text
    assert f'data-place="{place}"' in ONE[place]


@pytest.mark.parametrize("place", ["# cups", "recall", "", "#recall"])
def test_a_number_that_is_not_there_is_refused(place):
    with pytest.raises(ValueError, match="no number at"):
        ONE[place]


@pytest.mark.parametrize("mode", ["live", "test", "book"])
def test_a_demo_gives_its_first_numbers_and_shows_nothing_more(monkeypatch, mode):
    monkeypatch.setenv("VMC_RENDER_MODE", mode)
    monkeypatch.setattr(demo, "display", lambda *_, **__: None)
    numbers = explore(
        lambda n, at: f"<p data-axes>{n} {at}</p>",
        "c",
        lambda n, at: f"{n} rows",
        n=Slider([2, 30], "n", 30, "mm"),
        at=Pad([0, 1], [0, 1]),
    )
    assert ">30<" in numbers["# rows"]
    assert ">30 mm<" in numbers["n"]
    assert numbers.numbers.texts.keys() == {"n"}
    assert numbers._ipython_display_() is None


@pytest.mark.browser
def test_a_sentence_follows_its_demo(open_page, monkeypatch):
    def declare():
        for many in (3, 5):
            numbers = explore(
                lambda n: f"<p>{n}</p>",
                "c",
                lambda n, many=many: f"It has {n * many / 4:.2f} (l₀) of {many}." if n else "None.",
                n=Slider(range(many), "n", 2),
            )
            markdown(f"At {numbers['n']}: {numbers['has # (l₀) of #']}")

    monkeypatch.setenv("VMC_RENDER_MODE", "book")
    parts = []
    for module in (demo, figures):
        monkeypatch.setattr(module, "display", lambda shown: parts.append(shown.data))
    declare()
    page = open_page("".join(parts))
    seen = page.locator(".vmc-now")
    assert seen.all_inner_texts() == ["2", "1.50", "2", "2.50"]
    page.get_by_role("slider").nth(1).press("ArrowRight")
    assert seen.all_inner_texts() == ["2", "1.50", "3", "3.75"]
    page.get_by_role("slider").nth(0).press("Home")
    assert seen.all_inner_texts() == ["0", "–", "3", "3.75"]
