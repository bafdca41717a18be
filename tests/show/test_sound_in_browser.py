"""The curves of a demo as sounds: what comes out of the page's audio graph, rendered offline."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

from tests.pages import stop_clock
from tests.project import sample
from vmc_lib.show import Slider, explore, figure

pytestmark = pytest.mark.browser
RATE, PAUSE, LONG = 8000, 0.8, 2  # Hz, s: of the samples, and of page/demo/sound.js
RENDER = f"""() => {{ self.AudioContext = class extends OfflineAudioContext {{
  constructor() {{
    super(2, {10 * RATE}, {RATE});
    self.audio = this;
  }}
  close() {{ self.ended = this; }}
}}; }}"""
HEARD = """async () => {
  const sound = await audio.startRendering();
  return [0, 1].map((ear) => Array.from(sound.getChannelData(ear)));
}"""


def wave(phase):
    """A plot of two curves, and of what is no curve."""
    x = np.linspace(0, 1, 60)
    fig, ax = plt.subplots()
    ax.plot(x, np.sin(2 * np.pi * x + phase), label="wave")
    ax.plot(x, 2 * x - 1, label="a <rise>")
    ax.plot([0, 1], [0, 0])
    ax.plot(np.sin(7 * x), x)
    ax.plot(x, x, ".")
    ax.set(xlim=(0, 1), ylim=(-1, 1))
    return fig


def declare():
    explore(wave, "c", phase=Slider(np.linspace(0, 3, 7), "phase"))
    figure(lambda: wave(1), "A plot that stands still.")
    explore(lambda n: np.eye(n), "c", "words", n=Slider([2, 3], "n"))


@pytest.fixture
def page(open_demos, window):
    page = open_demos(declare, window())
    page.evaluate(RENDER)
    return page


def pitches(samples, start):
    """The pitch (Hz) at 19 moments of a curve, from where the tone passes zero upwards."""
    samples = np.asarray(samples[int(RATE * start) : int(RATE * (start + LONG))])
    rises = np.flatnonzero((samples[:-1] <= 0) & (samples[1:] > 0))
    exact = rises - samples[rises] / (samples[rises + 1] - samples[rises])
    middles = (exact[1:] + exact[:-1]) / 2 / RATE / LONG
    moments = np.linspace(0.05, 0.95, 19)
    return moments, np.interp(moments, middles, RATE / np.diff(exact))


@pytest.mark.parametrize("step", sample([0, 2, 5], 2))
def test_pitch_follows_the_curves_one_by_one_and_then_in_either_ear(page, step):
    box = page.locator(".vmc-demo").nth(0)
    box.get_by_role("slider").fill(str(step))
    box.get_by_role("button", name="Listen").press("Enter")
    left, right = page.evaluate(HEARD)
    each = LONG + PAUSE
    phase = np.linspace(0, 3, 7)[step]
    for samples, nth, curve in (
        (left, 0, lambda x: np.sin(2 * np.pi * x + phase)),
        (right, 1, lambda x: 2 * x - 1),
        (left, 2, lambda x: np.sin(2 * np.pi * x + phase)),
        (right, 2, lambda x: 2 * x - 1),
    ):
        moments, heard = pitches(samples, nth * each + PAUSE)
        assert np.abs(np.log2(heard / 220) - (curve(moments) + 1)).max() < 0.06  # of an octave
    assert np.abs(left[: int(RATE * PAUSE)]).max() == 0 == np.abs(left[int(RATE * 8.5) :]).max()


def test_what_sounds_is_named_and_can_be_stopped(page):
    box = page.locator(".vmc-demo").nth(0)
    button, said = box.locator(".vmc-listen"), box.locator(".vmc-end-signs ~ [role=status]")
    stop_clock(page)
    assert box.locator("[data-curve]").evaluate_all("all => all.map((c) => c.dataset.curve)") == [
        "wave",
        "a <rise>",
    ]
    button.press("Space")
    page.clock.run_for(1000)
    assert said.inner_text() == "wave"
    assert box.locator(".vmc-heard").get_attribute("data-curve") == "wave"
    assert button.inner_text() == "Stop"
    button.evaluate("(it) => (it.textContent = 'Anhalten')")  # as a browser's translation does
    button.press("Space")
    assert page.evaluate("ended === audio")
    assert (button.inner_text(), said.inner_text()) == ("Listen", "")
    assert box.locator(".vmc-heard").count() == 0

    button.click()
    page.clock.run_for(1000)
    assert said.inner_text() == "wave"
    box.get_by_role("slider").press("ArrowRight")  # these curves are gone
    assert (button.inner_text(), said.inner_text()) == ("Listen", "")
    button.click()
    box.evaluate("(demo) => demo.vmc.show()")  # as Play does, and a law of the reader's
    assert button.inner_text() == "Listen"


def test_plots_that_stand_still_are_heard_too_and_pictures_without_curves_are_not(page):
    buttons = page.locator(".vmc-listen")
    stop_clock(page)
    assert [button.is_visible() for button in buttons.all()] == [True, True, False]
    buttons.nth(1).click()
    buttons.nth(0).click()  # one at a time
    assert [buttons.nth(i).inner_text() for i in (0, 1)] == ["Stop", "Listen"]
