"""A chapter run live, and each of its laws changed afterwards: `python -m tests.changed_laws STEM`.

It prints, as JSON, for each function that a reader can change in the page what its cell then says,
and whether one of the demos that run it shows another picture.
"""

import inspect
import json
import os
import sys
from functools import cache

os.environ |= {"VMC_RENDER_MODE": "live", "MPLBACKEND": "agg"}

from IPython.core.interactiveshell import InteractiveShell

from page.python.grader import changed_names
from tests.laws import functions, law_cells
from tests.project import ROOT, code_cells
from vmc_lib import show
from vmc_lib.show import demo
from vmc_lib.show.abbreviations import as_control

OTHERWISE = """
def otherwise(law):
    def of(answer):
        if isinstance(answer, tuple):
            return tuple(map(of, answer))
        return answer[::-1] if isinstance(answer, list) else 0.7 * answer

    return lambda *given, **named: of(law(*given, **named))
"""
AT = 3  # of each control's values


class Chapter:
    """A chapter's cells, run in a shell of their own."""

    def __init__(self, stem):
        self.shell, self.said, self.demos = InteractiveShell.instance(), [], {}
        self.shell.display_pub.publish = lambda data, **_: self.said.append(data)
        self.cells = code_cells(ROOT / f"book/{stem}.ipynb")
        explore = show.explore

        def explore_and_record(*given, **named):
            asked = inspect.signature(explore).bind(*given, **named)
            asked.apply_defaults()
            self.demos.setdefault(self.now, asked.arguments)
            return explore(*given, **named)

        show.explore = explore_and_record
        for cell in self.cells:
            self.run(cell.source, cell.id, "raises-exception" in cell.metadata.get("tags", []))

    def run(self, lines, name="", may_raise=False):
        """Run lines as a cell; what it shows."""
        self.now = name
        del self.said[:]
        done = self.shell.run_cell(lines, store_history=True)
        assert done.success or may_raise, name
        return " ".join(data.get("text/html", "").split("</style>")[-1] for data in self.said)

    def answers(self, name):
        """What the demo of a cell shows, at some places of its controls."""
        asked = self.demos[name]
        controls = {key: as_control(key, one) for key, one in asked["controls"].items()}
        places = [demo.first_position(controls), *demo.along(controls, AT)]
        values = (demo.values_at(place, controls) for place in places)
        states = (demo.draw_state(asked["draw"], each, "d", asked["alt"]) for each in values)
        return [(words, *demo.lines(parts)) for words, parts in states]


def main(stem):
    """What comes of each law of a chapter: what its cell says, and whether a demo follows."""
    chapter, found = Chapter(stem), {}
    chapter.run(OTHERWISE)
    book = [cell.source for cell in chapter.cells]
    sources = {cell.id: cell.source for cell in chapter.cells}
    before = cache(chapter.answers)
    for cell in law_cells(chapter.cells):
        for law in functions(cell):
            lines = cell.source.split("\n")
            lines.insert(law.lineno - 1, "@otherwise")
            mine = ["\n".join(lines) if one is cell else one.source for one in chapter.cells]
            users = [name for name in chapter.demos if changed_names(mine, book, sources[name])]
            for name in users:
                before(name)
            said = chapter.run("\n".join(lines))
            follows = any(chapter.answers(name) != before(name) for name in users)
            found[law.name] = {"said": said, "follows": follows}
            chapter.run(cell.source)
    return found


if __name__ == "__main__":
    result = json.dumps(main(sys.argv[1]))
    sys.stdout.write(f"\n{result}\n")
