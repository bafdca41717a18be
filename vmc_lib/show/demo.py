"""`explore`: one declaration of an interactive demo, three render modes.

A demo is a pure function of its controls over a finite grid. In a live kernel the page's script
asks for one state after the other; in the built book (`VMC_RENDER_MODE=book`) every state is
computed once and travels in the page; in a test (`VMC_RENDER_MODE=test`) one control after the
other goes through all its values. In both, every control must matter.
"""

import gc
import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial
from typing import Any
from uuid import uuid4

import ipywidgets
from IPython.display import HTML, display

from vmc_lib.show.abbreviations import as_control, check_call, defaults
from vmc_lib.show.alt_text import alt_text
from vmc_lib.show.controls import Slider
from vmc_lib.show.data_table import data_tables
from vmc_lib.show.face import check_pads, check_same_kinds, face, lines, moves
from vmc_lib.show.figures import frame, parts_of, pictures, side_by_side
from vmc_lib.show.live import demo_script, exclusive_pyplot
from vmc_lib.show.numbers import Numbers
from vmc_lib.show.outputs import Markup, still
from vmc_lib.show.packed import pack_arrays
from vmc_lib.show.palette import plot_style
from vmc_lib.show.positions import (
    address,
    along,
    first_position,
    idle_controls,
    values_at,
)
from vmc_lib.show.render_mode import render_mode
from vmc_lib.show.scene import Scene
from vmc_lib.show.stored import all_states, page, recipe
from vmc_lib.show.values import Demo, Values

MOST_POSITIONS = 200
SAID = '<p class="vmc-kernel" role="status"></p><p class="vmc-error" role="alert"></p>'
SAMPLE = 8  # positions along a control, of a demo that the page works out
names = itertools.count(1)  # of the demos of a page; a build of the book gives them words


def explore(
    draw: Callable[..., Any] | None = None,
    caption: str = "",
    alt: str | Callable[..., str] | None = None,
    in_page: Any = None,
    data: Mapping[str, Any] | None = None,
    printed: Sequence[Mapping[str, Any]] = (),
    more: Sequence[str] = (),
    **controls: Any,
) -> Any:
    """Show what `draw` returns and let the reader move its controls, as ipywidgets' `interact`.

    `draw(**values)` is a pure function that returns a picture (see `figures`). Each control is a
    `Slider`, a `Pad`, a `Choice` or a `Switch`, a widget of ipywidgets, or what `interact` takes:
    (low, high), (low, high, step), a number, True or False, a list, a dictionary (see
    `abbreviations`). `caption` is Markdown and says what to notice; `alt` describes the picture in
    words, as text or as a function of the same controls; a plot without it describes itself.
    `printed` is where paper shows it, a list of {control: value} moved from the start; by default
    there, and with its first slider at its other end. `more` names controls that stand behind a
    fold, as a plot's numbers do: a figure shows two or three.

    Returns the `Demo`, a widget: its `value` can be read, set, observed and linked. Without `draw`
    it is a decorator, and the function's name becomes the `Demo`'s. ValueError for
    what could not work: an unknown control or picture, a start that is no value; in the book more
    than 200 positions, whose states are stored, and a control without effect.

    A demo may have as many positions as it likes if the book's page works them out itself:
    `in_page` is (name, ground, given), or a function that returns these, called for the book alone.
    The page's `works[name]` (page/demos) draws what `draw` does, by what it is `given` (as JSON
    takes it), on plots or photos that `ground()` returned; with `views`, it puts a pad's handle on
    several of them. Here a sample is evaluated, along each control.

    `data` are arrays, or dictionaries of them, by the names that the cell has for them: they travel
    with the book's page, whose Python could not make them, or not soon.

    >>> import matplotlib.pyplot as plt
    >>> def draw(a, b):
    ...     fig, ax = plt.subplots()
    ...     ax.plot([a, b])
    ...     return fig
    >>> demo = explore(draw, a=(0, 10), b=[1, 2, 4])
    >>> demo.value
    {'a': 5, 'b': 1}
    >>> demo.value = {"b": 4}
    >>> demo.value
    {'a': 5, 'b': 4}
    """
    if draw is None:
        how = {"caption": caption, "alt": alt, "in_page": in_page, "data": data}
        return partial(explore, **how, printed=printed, more=more, **controls)
    demo = widget(draw, caption, alt, in_page, data, printed, more, **controls)
    demo.show()
    return demo


def widget(
    draw: Callable[..., Any],
    caption: str = "",
    alt: str | Callable[..., str] | None = None,
    in_page: Any = None,
    data: Mapping[str, Any] | None = None,
    printed: Sequence[Mapping[str, Any]] = (),
    more: Sequence[str] = (),
    **controls: Any,
) -> Demo:
    """A demo as `explore` takes it, not yet shown: to stand in an `HBox`, or where it is displayed.

    As `explore` is to ipywidgets' `interact`, so is this to its `interactive`.

    >>> widget(lambda k: f"<p>{k}</p>", k=(0, 4, 2)).value
    {'k': 2}
    """
    check_call(draw, caption, alt, data, printed, more, controls)
    specs, starts = controls, defaults(draw)
    controls = {name: as_control(name, spec, starts.get(name)) for name, spec in specs.items()}
    printed = [address(values, controls) for values in printed]
    # in JupyterLab several notebooks share a page, and kernels start anew
    name = f"demo-{uuid4().hex[:8] if render_mode() == 'live' else next(names)}"

    def state(place):
        """The description and the pictures at a position of the grid."""
        values = values_at(place, controls)
        try:
            return draw_state(draw, values, name, alt, not in_page)
        except Exception as error:
            error.add_note(f"It was asked for {Values(values)}.")
            raise

    texts = {key: c.texts[c.first] for key, c in controls.items() if isinstance(c, Slider)}
    if render_mode() == "live":
        demo = _live(state, caption, controls, name, texts, more)
    else:
        demo = _checked(state, caption, controls, name, texts, in_page, data, printed, more)
    demo.share({key: one for key, one in specs.items() if isinstance(one, ipywidgets.Widget)})
    return demo


def _checked(state, caption, controls, name, texts, in_page, data, printed, more):
    """The demo in the built book or in a test, which must have all its states."""
    positions = math.prod(len(control.values) for control in controls.values())
    if positions > MOST_POSITIONS and not in_page:
        raise ValueError(
            f"{positions} positions are too many for a page (at most {MOST_POSITIONS}): "
            "give the controls fewer values"
        )
    state = cache(state)
    sample = along(controls, SAMPLE if in_page else MOST_POSITIONS)
    every = sample if in_page else range(positions)
    places = every if render_mode() == "book" else sample
    idle = _idle(state, places, controls)
    if idle and places is not every:  # a control may matter only where another has moved
        places = every
        idle = _idle(state, places, controls)
    if idle:
        raise ValueError(f"the control {idle[0].label!r} never changes the picture")
    start, states = state(first_position(controls)), [state(place) for place in places]
    check_pads(start[1], controls)
    for _, parts in states:
        check_same_kinds(parts, start[1])
    show = lambda: None  # noqa: E731 - in a test
    if render_mode() == "book":
        stored = recipe(in_page, controls, name) if in_page else all_states(states)
        stored |= {"data": pack_arrays(data)} if data else {}
        markup = HTML(page(*start, stored, caption, controls, name, printed, more))
        show = partial(display, markup)
    return Demo(name, controls, Numbers(name, start[0], texts), show)


def draw_state(draw, values, name, alt=None, tables=True):
    """What a demo shows for these values of its controls: words, and parts (see `pictures`)."""
    with exclusive_pyplot(), plot_style():
        picture = parts_of(draw(**values))
        numbers = data_tables(picture) if tables else []  # before the figures are closed
        words = alt(**values) if callable(alt) else alt or _own_words(picture)
        return words, [*pictures(picture, name), *numbers]


def _own_words(picture):
    """What a picture says of itself; a reader's own notebook may leave it at nothing."""
    try:
        return alt_text(picture)
    except ValueError:
        if render_mode() != "live":
            raise
        return "A picture that nobody has described yet."


def figure(picture: Any, caption: str = "", alt: str | Callable[..., str] | None = None) -> None:
    """Show a picture that does not move, or what a function without arguments draws."""
    explore(picture if callable(picture) else lambda: picture, caption, alt)


def _idle(state, places, controls):
    return idle_controls([repr(lines(state(place)[1])) for place in places], places, controls)


def _live(state, caption, controls, name, texts, more):
    """The demo in a kernel; shown, with a still of it for when the kernel is gone."""
    alt, parts = state(first_position(controls))
    check_pads(parts, controls)
    numbers = Numbers(name, alt, texts)
    if not moves(parts, controls):
        markup = Markup(frame(side_by_side(parts, alt), caption=caption), alt)
        return Demo(name, controls, numbers, lambda: display(markup))
    current, handle = (alt, parts), None  # what the reader sees; where its still stands

    def draw(place):
        nonlocal current
        alt, changed = state(place)
        check_same_kinds(changed, parts)
        current = alt, changed
        return [[alt], *lines(changed)]

    def move(place):
        demo.move(place)
        return draw(place)

    def keep(views):
        """Let the still show what the reader sees; of scenes in sight the browser sends a view."""
        (alt, parts), views = current, iter(views)
        views = [isinstance(part, Scene) and next(views) for part in parts]
        parts = [f'<img alt="" src="{v}">' if v else p for p, v in zip(parts, views, strict=True)]
        if handle:
            handle.update(still(alt, parts, name))

    def show():
        nonlocal handle
        handle = display(still(*current, name), display_id=True)
        bundle, metadata = demo._repr_mimebundle_()
        display(bundle, metadata=metadata, raw=True)
        if caption:
            display(Markup(frame("", caption=caption), caption))
        _freeze_once()

    inside = face(alt, parts, controls, name, more=more) + SAID
    scenes = [part.messages() if isinstance(part, Scene) else None for part in parts]
    live = {"page": frame(inside, name), "script": demo_script(), "first": [[alt], *scenes]}
    live["answers"] = {"state": move, "picture": draw, "still": keep}
    demo = Demo(name, controls, numbers, show, live)
    return demo


@cache
def _freeze_once():
    gc.collect()
    gc.freeze()  # or at times a picture waits until all that is loaded has been looked through
