"""Reprs of a line for objects that hold arrays."""

from dataclasses import fields, is_dataclass
from reprlib import Repr

FEW = 4  # numbers of an array that are shown


class _ShortRepr(Repr):
    """`reprlib` with the shapes of long arrays, and the names alone of objects that hold some."""

    def repr_ndarray(self, array, level):
        if array.size > FEW:
            return f"array{array.shape}"
        return str((array.round(3) if array.dtype.kind in "fc" else array).tolist())

    def repr_float64(self, number, level):
        return f"{number:.3f}"

    def repr_instance(self, value, level):
        name = f"{type(value).__name__}(…)"
        return name if is_dataclass(value) else super().repr_instance(value, level)


def short(value):
    """A repr of a line of any value."""
    return _ShortRepr().repr(value)


def short_repr(self):
    """The `__repr__` of a dataclass or a named tuple: of arrays, their shapes."""
    names = getattr(self, "_fields", None) or [field.name for field in fields(self)]
    parts = (f"{name}={short(getattr(self, name))}" for name in names)
    return f"{type(self).__name__}({', '.join(parts)})"
