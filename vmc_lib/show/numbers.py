"""Numbers of a demo in the sentences below it: they follow what the reader moves."""

import html
import re

NUMBER = r"(−?\d+(?:[.,]\d+)*)"


class Numbers:
    """What a demo's words and sliders say, by place: markup that `demo.js` keeps true.

    `numbers["recall #"]` is the number at the # in the demo's `words`, `numbers["load"]` what the
    slider `load` stands at, of the `texts` by name: both as the demo first shows them, so that a
    page without scripts is right, too. ValueError where it says no such thing.
    """

    def __init__(self, name, words, texts):
        self.name, self.words, self.texts = name, words, texts

    def __getitem__(self, place):
        found = "#" in place and re.search(re.escape(place).replace(r"\#", NUMBER), self.words)
        if not found and place not in self.texts:
            raise ValueError(
                f"no number at {place!r}: the demo says {self.words!r}, and has the sliders "
                f"{', '.join(self.texts) or 'none'}"
            )
        text = found[1] if found else self.texts[place]
        data = f'data-demo="{self.name}" data-place="{html.escape(place)}"'
        return f'<span class="vmc-now" {data}>{html.escape(text)}</span>'
