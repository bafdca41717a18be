"""Arrays as text, there and back."""

import gzip
import json
from base64 import b64decode
from types import MappingProxyType

import numpy as np

from vmc_lib.show.packed import pack_arrays, pack_json, unpack_arrays


def test_arrays_come_back_as_they_were(rng):
    given = {
        "x": rng.normal(size=(3, 2)),
        "by": MappingProxyType({"rig": {"a b": np.arange(4)}, "at": np.float32(1)}),
    }
    back = unpack_arrays(pack_arrays(given))
    assert list(back) == ["x", "by"]
    assert np.array_equal(back["x"], given["x"])
    assert np.array_equal(back["by"]["rig"]["a b"], given["by"]["rig"]["a b"])
    assert back["by"]["at"].dtype == np.float32
    assert unpack_arrays("") == {}


def test_json_is_the_same_each_time():
    text = pack_json({"é": [1, None]})
    assert json.loads(gzip.decompress(b64decode(text))) == {"é": [1, None]}
    assert text == pack_json({"é": [1, None]})
