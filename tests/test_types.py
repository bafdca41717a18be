"""What is annotated keeps its word, and all that a reader meets is annotated."""

import inspect
from importlib import import_module
from pkgutil import walk_packages
from typing import get_args

import pytest

import vmc_lib
from tests.project import python
from vmc_lib import show
from vmc_lib.cerebellum import adaptation, offline
from vmc_lib.motor import planning

INNER = {"arm.engines", "checks", "compiled", "grading", "hints", "short_repr", "what.learning"}
INNER |= {"where.segmentation"}  # what loops and messages are made of
NAMES = [module.name for module in walk_packages(vmc_lib.__path__, "vmc_lib.")]
MODEL = [name for name in NAMES if not name.startswith("vmc_lib.show")]


def test_the_library_is_as_annotated():
    assert "no issues" in python("-m", "mypy")


def public(members, home):
    """The public functions among members, and those of public classes, that a module defines."""
    for name, member in members:
        if isinstance(member, property):
            member = member.fget
        member = inspect.unwrap(getattr(member, "func", getattr(member, "__func__", member)))
        if not name.startswith("_") and getattr(member, "__module__", None) == home:
            if inspect.isfunction(member):
                yield member
            elif inspect.isclass(member):
                yield from public(vars(member).items(), home)


def untyped(functions):
    return [f.__qualname__ for f in functions if "return" not in f.__annotations__]


@pytest.mark.parametrize("name", [name for name in MODEL if name[len("vmc_lib.") :] not in INNER])
def test_all_of_the_model_is_annotated(name):
    assert not untyped(public(vars(import_module(name)).items(), name))


def test_all_that_shows_is_annotated():
    shown = [getattr(show, name) for name in show.__all__]
    functions = [one for one in shown if inspect.isfunction(one)]
    assert len(functions) > 10
    assert not untyped(functions)


def test_rules_are_annotated_by_their_names():
    names = {module: get_args(get_args(module.Rule)[0]) for module in (offline, planning)}
    assert names == {module: tuple(module.RULES) for module in (offline, planning)}
    corrects = adaptation.Adaptation.__init__.__annotations__["corrects"]
    assert get_args(corrects) == adaptation.CORRECTIONS
