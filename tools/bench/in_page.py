"""The arms in the built pages beside the same arms in Python: loading, drawing, stepping.

make book, then .venv/bin/python -m tools.bench.in_page   (a browser, an idle machine)
"""

from pathlib import Path
from time import perf_counter

import numpy as np

from reproduce.whole_arm import habits
from reproduce.whole_arm.experiment import seconds_per_second
from tools import browser
from tools.bench.report import publish, seconds
from vmc_lib.arm.model import STEP
from vmc_lib.arm.simulate import simulate
from vmc_lib.motor import templates

BOOK = Path(__file__).parents[2] / "_build/html/book"
DRAWN = 5.0  # s of drawing that are counted
COUNT = 2000  # steps of the arm of six muscles
FRAMES = """() => vmc["demo/scene"].viewOf(document.querySelector(".vmc-live .vmc-scene"))
  .viewer.renderer.info.render.frame"""
LIFE = """async (seconds) => {
  const data = JSON.parse(document.querySelector(".vmc-live script").textContent);
  const arm = await vmc["arm/load"].load(data);
  const movement = Array(Math.round(seconds / data.step)).fill(data.rest);
  const spent = () => {
    const start = performance.now();
    arm.move(movement);
    return (performance.now() - start) / 1000;
  };
  return seconds / Math.min(...Array.from({ length: 5 }, spent)); // the least that noise disturbed
}"""


def measure_arm(name, reaches):
    """Seconds from the click to an arm, drawn frames a second, seconds of its life in one second.

    An arm that `reaches` is drawn in one reach after the other, any other runs by itself.
    """
    with browser.launch() as chromium:
        page = chromium.new_context(offline=True).new_page()
        page.goto((BOOK / f"{name}.html").as_uri())
        arm = page.locator(".vmc-live")
        arm.scroll_into_view_if_needed()
        page.wait_for_selector(".vmc-live canvas")
        began = perf_counter()
        arm.locator("[name=main]").click()
        arm.locator("form > fieldset:not([disabled])").wait_for()
        loading = perf_counter() - began
        began, first = perf_counter(), page.evaluate(FRAMES)
        while (drawn := perf_counter() - began) < DRAWN:
            if reaches:
                arm.locator("[name=main]").click()
            page.wait_for_timeout(1000)  # sooner than a reach ends
        frames = (page.evaluate(FRAMES) - first) / drawn
        if not reaches:
            arm.locator("[name=main]").click()  # pause
        pace = page.evaluate(LIFE, COUNT * STEP)
    return loading, frames, pace


def row(arm, timing, python):
    """One line of the table; `python` is how many seconds of its life Python runs in one."""
    loading, frames, pace = timing
    return {
        "arm": arm,
        "click to a moving arm (s)": round(loading, 2),
        "drawn frames a second": round(frames),
        "× real time": round(pace, 1),
        "× Python's MuJoCo": round(pace / python, 1),
    }


def main():
    """Measure both arms in one run."""
    still = np.tile(np.full(6, 0.1), (COUNT, 1))
    spent = seconds(lambda: simulate(still, templates.START, engine="mujoco"), repeats=3)
    six = row("six muscles", measure_arm("08_arm", reaches=False), COUNT * STEP / spent)
    python = seconds_per_second(habits.muscle_synergies())
    publish("in_page", [six, row("whole", measure_arm("15_whole_arm", reaches=True), python)])


if __name__ == "__main__":
    main()
