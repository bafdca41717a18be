"""What a page has not: modules that it has no use for do nothing, others are refused in words."""

import builtins
import sys
from importlib.util import find_spec
from types import SimpleNamespace

import numpy as np

NAMES = """anywidget IPython IPython.display ipywidgets joblib markdown_it matplotlib_inline
matplotlib_inline.backend_inline mdit_py_plugins mdit_py_plugins.dollarmath traitlets umsgpack"""


class _Kind(type):
    def __getattr__(cls, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return cls

    def __bool__(cls):  # so matplotlib sees that there is no IPython
        return False


class Absent(metaclass=_Kind):
    """Anything of such a module: its parts are the same again, and it does nothing."""

    def __init__(self, *given, **named):
        pass

    def __call__(self, *given, **named):
        """Nothing: it may be a decorator, or make something."""
        return self

    def __getattr__(self, name):
        return self

    def __bool__(self):
        return False


def stand_in():
    """Let each of `NAMES` be imported whose package is not installed."""
    packages = {name.split(".")[0] for name in NAMES.split()} - sys.modules.keys()
    missing = {package for package in packages if not find_spec(package)}
    names = [name for name in NAMES.split() if name.split(".")[0] in missing]
    sys.modules.update(dict.fromkeys(names, Absent))
    if "scipy" not in sys.modules and not find_spec("scipy"):
        sys.modules["scipy"] = SimpleNamespace(fft=np.fft)  # of it, this alone


def _import(name, *context):
    """`import`, for a reader's lines: what is not there, or does nothing here, is refused."""
    package = name.partition(".")[0]
    idle = package in REFUSED or isinstance(sys.modules.get(package), _Kind | SimpleNamespace)
    try:
        if not idle:
            return builtins.__import__(name, *context)
    except ModuleNotFoundError as error:
        if error.name != package:
            raise
    raise ModuleNotFoundError(f"This page has NumPy alone: {package} needs Python of your own")


def _refuse(words):
    def refuse(*_):
        raise RuntimeError(words)

    return refuse


REFUSED = {"asyncio"}  # a page waits for nothing while lines run
BUILTINS = vars(builtins) | {
    "__import__": _import,
    "input": _refuse("This page cannot ask: write the value into your lines"),
}
BUILTINS |= dict.fromkeys(
    ("exit", "quit"), _refuse("Nothing to leave here: a function ends with return")
)
