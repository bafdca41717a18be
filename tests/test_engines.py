"""The chapters in the two other engines: they open offline, their demos move, nothing fails."""

import os
import re
from contextlib import suppress
from pathlib import Path

import pytest

from tests.engines import NOT_TESTED, Fallen, Firefox, WebKit
from tests.pages import CHAPTERS

pytestmark = pytest.mark.browser
DEMOS = [path for path in CHAPTERS if path.stem[0].isdigit()]

# Moves the first control of every demo that it can move; returns those that showed nothing new.
IDLE = """
  await window.MathJax?.startup?.promise;
  const demos = [...document.querySelectorAll(".vmc-demo:has(> script)")];
  while (demos.some((demo) => !("ready" in demo.dataset))) await new Promise(requestAnimationFrame);
  return demos.filter((demo) => {
    const slider = demo.querySelector("input[data-texts]");
    if (!slider || demo.querySelector(".vmc-scene")) return false;
    const pictures = demo.querySelector(".vmc-pictures"), before = pictures.innerHTML;
    const moved = [...Array(+slider.max + 1).keys()].some((place) => {
      slider.value = place;
      slider.dispatchEvent(new Event("input", { bubbles: true }));
      return pictures.innerHTML !== before;
    });
    return !moved;
  }).map((demo) => demo.id);"""
UNSET = """
  return [...document.querySelectorAll(".math")]
    .filter((one) => !one.querySelector("mjx-container")).map((one) => one.textContent);"""


@pytest.fixture(scope="module", params=[Firefox, WebKit], ids=["Firefox", "WebKit"])
def engine(request, tmp_path_factory):
    if not request.param.program():
        pytest.skip(NOT_TESTED.format(request.param.__name__))
    engine = request.param(tmp_path_factory.mktemp("engine"))
    yield engine
    engine.close()


@pytest.mark.parametrize("path", DEMOS, ids=lambda path: path.stem)
def test_a_chapter_opens_offline_and_its_demos_move(engine, path):
    try:
        moves(engine, path)
    except Fallen:  # seen once in many runs; a page that fells the engine does so twice
        engine.restart()
        moves(engine, path)


def moves(engine, path):
    engine.open(path)
    assert engine.run(IDLE) == []
    assert engine.run(UNSET) == []
    assert engine.errors() == ""


def fell(engine):
    try:
        return engine.run("return false;")
    except Fallen:
        return True
    except AssertionError:  # its driver does not know yet why there is no answer
        return False


@pytest.mark.parametrize("engine", [WebKit], ids=["WebKit"], indirect=True)
def test_an_engine_that_fell_is_noticed_and_starts_anew(engine):
    engine.open(DEMOS[0])
    for name in Path("/proc").glob("[0-9]*/comm"):
        with suppress(OSError):  # others come and go
            pid = int(name.parent.name)
            if os.getpgid(pid) == engine.process.pid and b"WebKitWebProces" in name.read_bytes():
                os.kill(pid, 9)
    assert any(fell(engine) for _ in range(100))
    engine.restart()
    moves(engine, DEMOS[0])


def test_what_fails_is_heard(engine, tmp_path):
    page = tmp_path / "book/page.html"
    page.parent.mkdir()
    page.write_text(
        "<html><head></head><img src='nowhere.png'><script>throw 'aloud'</script>", encoding="utf-8"
    )
    engine.open(page)
    thrown, missing = engine.errors().splitlines()
    assert re.search("aloud|Script error", thrown)  # WebKit tells no more of a file's script
    assert "nowhere.png" in missing
