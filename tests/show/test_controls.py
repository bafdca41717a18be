"""Controls: where they start, and which are refused."""

import numpy as np
import pytest

from vmc_lib.show import Slider


def test_impossible_sliders_are_refused():
    with pytest.raises(ValueError, match="'size' has values"):
        Slider([7], "size")
    with pytest.raises(ValueError, match=r"'size' cannot stand at 3: it has 1 m, 2 m$"):
        Slider([1, 2], "size", start=3, unit="m")
    with pytest.raises(ValueError, match=r"stand at 3.3: it has 0, 0.5, 1, …, 10$"):
        Slider(np.linspace(0, 10, 21), "size", start=3.3)
    with pytest.raises(ValueError, match=r"stand at 'm', .*: a unit is given as unit='m'"):
        Slider([1, 2], "size", "m")


def test_a_start_may_be_off_by_rounding():
    assert Slider(np.linspace(0, 1, 11), "x", start=0.3).first == 3
