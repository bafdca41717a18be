"""Plain loops, run as fast as C: a decorator for what cannot be said in whole arrays."""

from functools import cache, wraps
from hashlib import sha256
from inspect import unwrap
from numbers import Number
from types import CodeType, FunctionType, ModuleType
from warnings import warn

import numpy as np


def compiled(loop):
    """The function `loop`, compiled by numba for the processor at hand when it is first called.

    The plain functions that it calls are compiled with it. Numba freezes what they read from
    outside; so all of that is looked at in every call, and whoever changes a constant, or replaces
    a function, has the loop compiled anew. What was compiled is kept beside the source, or in the
    user's cache folder, for the next process; where neither can be written, each process compiles
    anew. What numba cannot compile runs as it stands, with a warning. `__wrapped__` is the plain
    Python.
    """

    @wraps(loop)
    def call(*values):
        return _machine(loop, _frozen_in(loop))(*values)

    return call


@cache
def _machine(loop, frozen):
    from numba import njit  # here, for it weighs 0.3 s and 100 MB on who never calls
    from numba.core.errors import NumbaError

    def ready(function):
        space = function.__globals__ | {n: njit(ready(f)) for n, f in _called(function)}
        parts = function.__name__, function.__defaults__, function.__closure__
        return FunctionType(function.__code__, space, *parts)

    plain = ready(loop)
    plain.__qualname__ += "-" + sha256(repr(frozen).encode()).hexdigest()[:12]  # the file's name
    try:
        machine = njit(plain, cache=True, nogil=True)
    except RuntimeError:  # no folder for the cache
        machine = njit(plain, nogil=True)

    def run(*values):
        nonlocal machine
        try:
            return machine(*values)
        except NumbaError as error:
            warn(f"{loop.__name__} runs as plain Python, slowly: {error}", stacklevel=3)
            machine = loop
            return loop(*values)

    return run


def _called(function):
    """The plain functions that a function finds in its module: pairs of name and function."""
    names = {n: function.__globals__.get(n) for n in function.__code__.co_names}
    found = ((n, unwrap(f)) for n, f in names.items() if isinstance(f, FunctionType))
    return [(n, f) for n, f in found if f is not function]


def _frozen_in(value, names=()):
    """What numba freezes of a function, or of what it reads: its code and values, all the way."""
    if isinstance(value, FunctionType):
        value = unwrap(value)
        code, space = value.__code__, value.__globals__
        cells = [cell.cell_contents for cell in value.__closure__ or ()]
        read = [space.get(n) for n in code.co_names if space.get(n) is not value]
        read += [value.__defaults__, *cells]
        return _instructions(code), *(_frozen_in(x, code.co_names) for x in read)
    if isinstance(value, CodeType):
        return _instructions(value)
    if isinstance(value, ModuleType):
        read = (vars(value).get(n) for n in names)
        return tuple(_frozen_in(x) for x in read if isinstance(x, Number | tuple | np.ndarray))
    if isinstance(value, np.ndarray):
        return value.shape, value.dtype.str, value.tobytes()
    if isinstance(value, tuple):
        return tuple(map(_frozen_in, value))
    return value if isinstance(value, Number | str | bytes) else type(value).__name__


@cache  # code never changes
def _instructions(code):
    return code.co_code, code.co_names, *map(_frozen_in, code.co_consts)
