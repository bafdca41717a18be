"""Controls: where they start, and which are refused."""

import numpy as np
import pytest

from vmc_lib.show import Slider


def test_impossible_sliders_are_refused():
    with pytest.raises(ValueError, match="'size' has values"):
        Slider([7], "size")
    with pytest.raises(ValueError, match="'size' cannot start at 3"):
        Slider([1, 2], "size", start=3)


def test_a_start_may_be_off_by_rounding():
    assert Slider(np.linspace(0, 1, 11), "x", start=0.3).first == 3
