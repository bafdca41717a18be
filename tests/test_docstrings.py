"""Every example in a docstring runs and gives what it says."""

import doctest
from importlib import import_module
from pkgutil import walk_packages

import pytest

import vmc_lib

MODULES = [module.name for module in walk_packages(vmc_lib.__path__, "vmc_lib.")]


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_a_module(name):
    failures, _ = doctest.testmod(import_module(name))
    assert failures == 0
