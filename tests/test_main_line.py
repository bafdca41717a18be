"""The main line of the built chapters is short: words, captions, controls, predictions."""

import pytest

from tests.pages import NUMBERED
from tools.main_line import main_line

each_chapter = pytest.mark.parametrize("path", NUMBERED, ids=lambda path: path.stem)


PAGE = """<article><h1>A title</h1><p>Two words <code>and three</code></p><pre>no code</pre>
<details><summary>one line</summary><p>folded away</p></details>
<section class="vmc-optional"><h2>A head</h2><p>deeper</p><i class="vmc-predict"></i></section>
<fieldset class="vmc-predict"><p>What then?</p></fieldset>
<figure class="vmc-demo" id="demo-1"><svg><text>plot</text></svg><form>
<div class="vmc-pad"><div class="vmc-control"><input type="range"></div></div>
<div class="vmc-control"><input type="range"></div><fieldset class="vmc-control"></fieldset>
<div class="vmc-control"><div class="vmc-options"><label><input type="checkbox"></label></div></div>
<details class="vmc-more"><summary>m</summary><fieldset class="vmc-control"></fieldset></details>
</form><figcaption>A caption of five words</figcaption></figure></article>"""


def test_what_is_read_is_counted(tmp_path):
    path = tmp_path / "page.html"
    path.write_text(PAGE, encoding="utf-8")
    line = main_line(path)
    assert (line.words, line.predictions, line.controls) == (17, 1, [4])
    assert [(one.name, one.caption) for one in line.figures] == [("demo-1", 5)]


def test_the_book_is_short():
    assert sum(main_line(path).words for path in NUMBERED) <= 36_000


@each_chapter
def test_a_chapter_is_short(path):
    assert main_line(path).words <= 2800


@each_chapter
def test_predictions_are_few(path):
    assert main_line(path).predictions <= 4


@each_chapter
def test_captions_are_short(path):
    assert [one for one in main_line(path).figures if one.caption > 40] == []


@each_chapter
def test_a_figure_has_few_controls(path):
    """The first that moves two at most, others three; but four weights are set by four sliders."""
    first, *others = main_line(path).controls
    assert first <= 2
    assert [count for count in others if count > 3] == [4] * (path.stem == "10_offline")
