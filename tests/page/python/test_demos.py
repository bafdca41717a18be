"""The page's Python draws a chapter's demos as the notebook does, with a changed law as well."""

import inspect
import json
import re
from unittest.mock import patch
from zlib import crc32

import matplotlib.pyplot as plt
import numpy as np
import pytest

from page.python import demos
from page.python.grader import changed_names
from tests.laws import functions, law_cells
from tests.page.python.conftest import ASK
from tests.pages import open_html
from tests.project import CHAPTERS, code_cells, sample
from vmc_lib.show import Choice, figures
from vmc_lib.show.data_table import panels
from vmc_lib.show.packed import pack_arrays

LAWS = {  # by chapter: a change of what the book has; it moves two demos at least
    "04_crbm": ("np.exp(-energies)", "np.exp(energies)"),
    "08_arm": ("return R *", "return -R *"),
    "11_online": ("active.T @ answers)", "-active.T @ answers)"),
    "16_noise": ("K = P @", "K = 0.5 * P @"),
    "07_muscle": ("np.exp(-40 *", "0.5 * np.exp(-40 *"),
    "12_while_it_moves": ("return gain * (q_ref", "return 0.5 * gain * (q_ref"),
    "10_offline": ("return k * cosine", "return 0.5 * k * cosine"),
    "09_planning": ("(1 / d) / (1 / d).sum(", "(1 / d**2) / (1 / d**2).sum("),
}


def chapter_demos(stem):
    """Every demo of a chapter that is drawn in the page: (the code above, laws below; its cell)."""
    [chapter] = [chapter for chapter in CHAPTERS if chapter.stem == stem]
    above, cells = [], code_cells(chapter)
    for n, cell in enumerate(cells):
        tags = set(cell.metadata.get("tags", []))
        if not tags & {"solution", "remove-input"}:
            if "draws-in-page" in tags:
                below = [law.source for law in law_cells(cells[n:])]
                yield [*above, *below], cell.source
            above.append(cell.source)


DEMOS = {chapter.stem: list(chapter_demos(chapter.stem)) for chapter in CHAPTERS}
DEMOS = {stem: found for stem, found in DEMOS.items() if found}


def starts(controls):
    """The places where a demo's controls begin."""
    first = {key: one.first for key, one in controls.items() if not isinstance(one, demos.Pad)}
    return first | {key: one.first for key, one in demos.sliders(controls).items()}


def between(controls):
    """Where one slider after the other that can stands at random, and where all do."""
    rng, first = np.random.default_rng(0), starts(controls)
    can = {key: one for key, one in demos.sliders(controls).items() if one.continuous}
    apart = {key: round(rng.uniform(0, len(one.values) - 1), 1) for key, one in can.items()}
    yield from (first | {key: place} for key, place in apart.items())
    if len(apart) > 1:
        yield first | apart


def moved(mine, above, cell):
    """The first place where the law `mine` shows something else, if any.

    Of where a demo begins, along its choices, and at the end of a slider.
    """
    controls = demos.prepare(tuple(above), cell)[1]
    first = starts(controls)
    choices = {k: len(one.values) for k, one in controls.items() if isinstance(one, Choice)}
    places = [first, *(first | {k: n} for k, count in choices.items() for n in range(count))]
    places += [first | {k: len(one.values) - 1} for k, one in demos.sliders(controls).items()]
    return next((p for p in places if digest(mine, cell, p) != digest(above, cell, p)), None)


def digest(above, cell, places, data=""):
    """A few numbers that stand for all that a demo's plots show and say, and how many these are."""
    demo, controls, _ = demos.prepare(tuple(above), cell, data)
    with patch.object(figures, "data_uri", lambda image: f"{crc32(image.tobytes())}"):
        picture = demo["draw"](**demos.values_at(places, controls))
    shown, parts = panels(picture), picture if isinstance(picture, tuple) else [picture]
    words = [one.title for one in shown] + [part for part in parts if isinstance(part, str)]
    scenes = (part.messages() for part in parts if hasattr(part, "messages"))
    words += [line for lines in scenes for line in lines if line.startswith("motion|")]
    plt.close("all")
    series = [one for panel in shown for one in panel.series]
    every = [np.concatenate([s.keys, s.values, s.ends.ravel()]) for s in series]
    said = [float(x) for one in words for x in re.findall(r"-?\d+(?:\.\d+)?", one)]
    every = np.nan_to_num(np.concatenate([[0.0], said, *every]))
    return [len(every), float(every.sum()), float(every @ np.cos(np.arange(len(every))))]


ASKED = f"""import json
import re
from unittest.mock import patch
from zlib import crc32
import matplotlib.pyplot as plt
import numpy as np
from page.python import demos
from vmc_lib.show import figures
from vmc_lib.show.data_table import panels
{inspect.getsource(digest)}
print(json.dumps([digest(*one) for one in json.loads(given)]))"""


@pytest.fixture(scope="module")
def page(offline, site):
    python = "<!-- tag_draws-in-page: its policy lets Python run -->"
    page = open_html(offline, site, f"<h1>D</h1>{python}")
    page.evaluate("() => { vmc['python/interpreter'].limit.seconds = 100 }")
    yield page
    page.close()
    assert page.errors == []


def with_law(stem, above):
    """A chapter's code with its changed law."""
    old, new = LAWS.get(stem, ("", ""))
    return [lines.replace(old, new) if old else lines for lines in above]


# Photos, patches, words, an arm and a changed law; the others' demos take three minutes
SOME = sample(DEMOS, "03_regions", "04_crbm", "06_names", "08_arm")


@pytest.mark.browser
@pytest.mark.parametrize("stem", SOME)
def test_the_pages_numbers_are_the_notebooks(page, stem):
    for above, cell in DEMOS[stem]:
        _, controls, data = demos.prepare(tuple(above), cell)
        data = pack_arrays(data) if data else ""
        asked = [(above, cell, place, data) for place in (starts(controls), *between(controls))]
        mine = with_law(stem, above)
        if changed_names(mine, above, cell) and (place := moved(mine, above, cell)):
            asked.append((mine, cell, place, ""))
        for code, _, place, data in asked:
            answer = page.evaluate(ASK, ["demos", "draw", code, above, cell, "d", place, data])
            assert "error" not in answer, (answer, cell)
        said, printed = page.evaluate(
            ASK, ["grader", "run", [], f"given = {json.dumps(asked)!r}\n{ASKED}"]
        )
        assert said.startswith("✓ It runs"), said
        ours = [digest(*one[:3]) for one in asked]
        np.testing.assert_allclose(json.loads(printed), ours, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("path", CHAPTERS, ids=lambda path: path.stem)
def test_every_law_is_run_by_a_demo_of_the_page(path):
    for cell in law_cells(code_cells(path)):
        for law in functions(cell):
            head = cell.source.split("\n")[law.lineno - 1]
            mine = cell.source.replace(head, f"@staticmethod\n{head}")
            others = [
                (replaced(above, cell.source, mine), above, own) for above, own in DEMOS[path.stem]
            ]
            assert any(law.name in changed_names(*one) for one in others), law.name


def replaced(cells, old, new):
    return [new if one == old else one for one in cells]


@pytest.mark.parametrize("stem", sample(LAWS, *{*LAWS} - {"12_while_it_moves"}))
def test_a_law_moves_two_demos(stem):
    found = [(with_law(stem, above), above, cell) for above, cell in DEMOS[stem]]
    assert sum(bool(changed_names(*one)) and moved(*one) is not None for one in found) >= 2
