"""Functions compiled by numba: at their first call, and again when what they read has changed."""

from collections.abc import Callable
from functools import wraps
from hashlib import sha256
from importlib.util import find_spec
from inspect import unwrap
from logging import getLogger
from types import CodeType, FunctionType, ModuleType
from typing import Any
from warnings import warn

import numpy as np

AVAILABLE = find_spec("numba") is not None  # not in the page


def compiled(loop: Callable[..., Any]) -> Callable[..., Any]:
    """`numba.njit` of a function and of the plain functions that it calls.

    Numba freezes the module-level constants and functions that a function reads. If one is rebound,
    as chapters invite readers to (not: changed in place), it is compiled again at its next call.
    The machine code is kept for the next process, where its folder can be written; a damaged file
    of it is made anew, and logged. Without numba, or with what numba cannot compile, a
    call runs as plain Python, slowly, with a warning; so it does, without one, where
    NUMBA_DISABLE_JIT asks for it.
    `__wrapped__` is that plain Python. Arguments are positional; functions that call each other in
    a circle cannot be compiled.
    """
    machine, frozen = None, []

    @wraps(loop)
    def call(*values):
        nonlocal machine, frozen
        run = machine
        if run is None or any(space.get(name) is not x for space, name, x in frozen):
            reads = list(_reads(loop))
            machine = run = _machine(loop, reads)  # before `frozen`: another thread may call
            frozen = reads
        return run(*values)

    return call


def _reads(function):
    """What numba freezes of a function, and of those it calls: (module's names, name, value)."""
    space, names = function.__globals__, dict.fromkeys(_names(function.__code__))
    for name in names:
        if name in space and space[name] is not function:
            yield space, name, space[name]
            if isinstance(space[name], FunctionType) and unwrap(space[name]) is not function:
                yield from _reads(unwrap(space[name]))
            if isinstance(space[name], ModuleType):  # numbers by their module's name
                inside = vars(space[name])
                numbers = (n for n in names if isinstance(inside.get(n), float | int | np.ndarray))
                yield from ((inside, n, inside[n]) for n in numbers)


def _names(code):
    """The names that code looks up, its comprehensions' too."""
    yield from code.co_names
    for part in code.co_consts:
        if isinstance(part, CodeType):
            yield from _names(part)


def _machine(loop, frozen):
    try:
        from numba import config, njit  # here, for it takes 0.3 s and 100 MB
        from numba.core.errors import NumbaError
    except (ImportError, OSError) as error:
        warn(f"without numba loops run as plain Python, slowly: {error}", stacklevel=1)  # said once
        return loop
    if config.DISABLE_JIT:
        return loop

    content = _content(loop), [(name, _content(x)) for _, name, x in frozen]
    digest = sha256(repr(content).encode()).hexdigest()[:12]

    def ready(function):
        """The same function, which finds compiled ones, in a module that the cache can import.

        Named by what all of them read: by its name the cache finds a file, and the linker a callee,
        which it may have from another file.
        """
        code, space = function.__code__, function.__globals__
        names = (n for n in _names(code) if type(space.get(n)) is FunctionType)
        called = {n: unwrap(space[n]) for n in names}
        callees = {n: njit(ready(f)) for n, f in called.items() if f is not function}
        parts = function.__name__, function.__defaults__, function.__closure__
        home = {"__name__": loop.__globals__.get("__name__")}
        copied = FunctionType(code, space | callees | home, *parts)
        copied.__qualname__ += f"-{digest}"
        return copied

    plain = ready(loop)
    try:
        machine = njit(plain, cache=True, nogil=True)
        _guard(machine._cache)
    except RuntimeError:  # no folder for the cache
        machine = njit(plain, nogil=True)

    def run(*values):
        try:
            return machine(*values)
        except NumbaError as error:
            warn(f"{loop.__name__} runs as plain Python, slowly: {error}", stacklevel=3)
            return loop(*values)

    return run


def _guard(cache):
    """Let numba's cache survive files that are cut, empty or foreign, and a disk that is full."""

    def guarded(use):
        def guard(*values):
            try:
                return use(*values)
            except Exception as error:  # from pickle anything
                getLogger(__name__).info("%s is made anew: %r", cache.cache_path, error)
                try:
                    cache.flush()
                except OSError:  # it cannot be written
                    cache.disable()

        return guard

    cache.load_overload, cache.save_overload = map(
        guarded, (cache.load_overload, cache.save_overload)
    )


def _content(value):
    """What tells a value from another, also in the next process."""
    if isinstance(value, FunctionType):
        function = unwrap(value)
        cells = [cell.cell_contents for cell in function.__closure__ or ()]
        defaults = function.__defaults__, tuple((function.__kwdefaults__ or {}).items())
        return [_content(x) for x in (function.__code__, *defaults, *cells)]
    if isinstance(value, CodeType):
        return value.co_code, value.co_names, [*map(_content, value.co_consts)]
    if isinstance(value, np.ndarray | np.generic):
        return value.shape, value.dtype.str, value.tobytes()
    if isinstance(value, tuple):
        return [*map(_content, value)]
    if isinstance(value, frozenset):
        return sorted(map(repr, value))
    return value if isinstance(value, int | float | str | bytes) else type(value).__name__
