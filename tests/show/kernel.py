"""Demos to ask, and a live widget in a page: this process answers it, as a kernel would."""

from vmc_lib.show import explore


def named(**values):
    """A picture that names the position of every control."""
    return f"<svg>\n<text>{list(values.values())}</text>\n</svg>"


def show(draw=named, alt="words", **controls):
    return explore(draw, caption="A *caption*: $x < y$.", alt=alt, **controls)


RENDER = """async ([script, traits, kernel, busy]) => {
  const url = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
  const listeners = {};
  const model = {
    busy,
    get: (name) => (model.traits ?? traits)[name] ?? traits[name],
    widget_manager: { get_model: async (id) => id === traits.channel && model },
    on: (event, listener) => ((listeners[event] ??= []).push(listener)),
    off: () => {},
    send: (message) => {
      if (model.closed) throw new Error("Cannot send");
      if (!model.busy) self[kernel](message).then((reply) => emit("msg:custom", reply));
    },
  };
  const emit = (event, value) => (listeners[event] ?? []).forEach((listener) => listener(value));
  Object.assign(self, { [`${kernel}Model`]: Object.assign(model, { emit }) });
  const el = document.body.appendChild(document.createElement("div"));
  await (await import(url)).default.render({ model, el });
}"""
TRAITS = ("page", "vendored", "first", "channel", "place")


def render(page, widget, monkeypatch, kernel="kernel", busy=False):
    """Show a widget (`Live`) at the end of a page; a `busy` kernel hears questions, and is silent.

    The page's `kernelModel`, by another name where `kernel` has one, is what the widget talks to:
    it may be `closed` or `busy`, and `emit(event, value)` is what Jupyter calls.
    """

    def answer(message):
        replies = []
        monkeypatch.setattr(widget._channel, "send", replies.append)
        widget._channel._handle_custom_msg(message, [])
        return replies.pop()

    page.expose_function(kernel, answer)
    traits = {name: getattr(widget, name, None) for name in TRAITS}
    page.evaluate(RENDER, [widget._esm, traits, kernel, busy])
