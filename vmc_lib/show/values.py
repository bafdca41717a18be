"""The widget that `explore` returns: the values of its controls, to be read, set and linked."""

from functools import partial

import anywidget
import numpy as np
import traitlets
from IPython import get_ipython

from vmc_lib.show.live import Live
from vmc_lib.show.positions import first_position, position, values_at


class Values(dict):
    """What the controls of a demo stand at, by their names: set as a whole."""

    def __repr__(self):
        return repr({name: _plain(value) for name, value in self.items()})

    def __setitem__(self, name, value):
        raise TypeError(
            f"a value alone moves nothing: write demo.value = {{{name!r}: {value!r}}}, "
            "which leaves the other controls where they stand"
        )

    def update(self, *values, **named):
        """Refuse, as one value alone is refused."""
        for name, value in dict(*values, **named).items():
            self[name] = value

    def __ior__(self, values):
        return self | values  # demo.value |= … sets the demo's


class Demo(Live):
    """A demo as an ipywidgets' widget; in the built book, which has no kernel, it is shown alone.

    `value` maps the names of its controls to what they stand at. It can be read, observed, linked
    (`ipywidgets.link`, `jslink`) and set: controls that are not named stay, a number goes to the
    nearest stop. ValueError for a name or a value that it does not have. `demo["recall #"]` is a
    number in a sentence (see `Numbers`).
    """

    value = traitlets.TraitType().tag(
        sync=True,
        to_json=lambda value, demo: demo.as_json(value),
        from_json=lambda value, demo: demo.from_json(value),
    )
    place = traitlets.Int().tag(sync=True)  # see `positions`: where the page puts its controls

    def __init__(self, name, controls, numbers, show, live=None):
        """`show()` shows it; `live` is what the widget of a live kernel is made of: see `Live`."""
        self.name, self.numbers, self._show, self.controls = name, numbers, show, controls
        self._shown_in = None  # the cell in which it was shown last
        start = first_position(controls)
        state = {"place": start, "value": Values(values_at(start, controls))}
        self._live = bool(live)
        if live:
            super().__init__(**live, **state)
        else:
            anywidget.AnyWidget.__init__(self, **state)

    def __setattr__(self, name, value):
        if name in vars(self).get("controls", ()) and not hasattr(self, name):
            raise ValueError(f"a demo has one value: write demo.value = {{{name!r}: {value!r}}}")
        super().__setattr__(name, value)

    def __getattr__(self, name):
        if name in vars(self).get("controls", ()):
            raise AttributeError(f"a demo has one value: read demo.value[{name!r}]")
        raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    def observe(self, handler, names=traitlets.All, type="change"):
        """As of any widget: its `value`; ValueError for a control alone, which would not be told.

        What changed there is `change.new`, a dictionary.
        """
        for name in names if isinstance(names, list | tuple | set) else [names]:
            if name in vars(self).get("controls", ()) and not self.has_trait(name):
                raise ValueError(
                    f"a demo has one value: observe 'value', and read change.new[{name!r}]"
                )
        super().observe(handler, names, type)

    def open(self):
        """Tell the browser of the widget, where one listens."""
        if self._live:
            super().open()

    @property
    def model_id(self):
        """The name by which a box knows it, in the book too."""
        if self.comm is None:
            super().open()
        return super().model_id

    def show(self):
        """Show it below the cell."""
        self._shown_in = _cell()
        self._show()

    def _ipython_display_(self):
        if self._shown_in != _cell():  # or `explore` as a cell's last line would show it twice
            self.show()

    def __getitem__(self, place):
        return self.numbers[place]

    def move(self, place):
        """Let the controls stand at a place of the grid: see `positions`."""
        self.value = values_at(place, self.controls)

    def share(self, widgets):
        """Let controls be shared with ipywidgets' own, {name: widget}: each follows the other."""
        for name, widget in widgets.items():
            widget.observe(partial(self._follow, name), "value")
            self.observe(partial(self._lead, name, widget), "value")

    def _follow(self, name, change):
        self.value = {name: change.new}

    def _lead(self, name, widget, change):
        widget.value = change.new[name]

    @traitlets.validate("value")
    def _on_the_grid(self, proposal):
        if not isinstance(proposal.value, dict):
            raise ValueError(f"value = {proposal.value!r}: give a dictionary, {self.value}")
        values = values_at(self.place, self.controls) | proposal.value
        return Values(values_at(position(values, self.controls), self.controls))

    @traitlets.observe("value")
    def _stand_there(self, change):
        self.place = position(change.new, self.controls)

    def as_json(self, values):
        """The values as JSON takes them: numbers, texts, pairs; labels for all else."""
        return {name: self._as_json(name, value) for name, value in values.items()}

    def _as_json(self, name, value):
        plain = _plain(value)
        if isinstance(plain, tuple):
            return [float(part) for part in plain]
        control = self.controls[name]
        simple = isinstance(plain, int | float | str)
        return plain if simple else control.texts[control.place_of(value)]

    def from_json(self, values):
        """The values that `as_json` has written; others as they are."""
        return {
            name: next((own for own in self._own(name) if self._as_json(name, own) == value), value)
            for name, value in values.items()
        }

    def _own(self, name):
        return getattr(self.controls.get(name), "values", ())


def _plain(value):
    """NumPy's numbers as Python's own, in a pair too."""
    if isinstance(value, tuple):
        return tuple(map(_plain, value))
    return value.item() if isinstance(value, np.generic) else value


def _cell():
    shell = get_ipython()
    return shell.execution_count if shell else -1
