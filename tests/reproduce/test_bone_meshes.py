"""The bones that the page draws: small enough, whole, and made of what OpenSim has."""

import gzip
import json
import re

import numpy as np
import pytest

from reproduce.render import bone_meshes
from vmc_lib.show.packed import unpack_bytes

VTP = """<?xml version="1.0"?><VTKFile><PolyData><Piece>
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">
0 0 0  0.01 0 0  0.01 0.01 0  0 0.01 0  0.0102 0.0101 0
</DataArray></Points><Polys>
<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3 1 2 4</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4 7</DataArray>
</Polys></Piece></PolyData></VTKFile>"""


def parts():
    """The meshes in the script that the page loads, by name."""
    data = re.search('"(.*)"', bone_meshes.FILE.read_text(encoding="utf-8"))[1]
    return json.loads(unpack_bytes(data))["parts"]


def test_polygons_become_triangles_and_near_vertices_one(tmp_path):
    (tmp_path / "a.vtp").write_text(VTP, encoding="utf-8")
    points, faces = bone_meshes.read(tmp_path / "a.vtp")
    assert faces.tolist() == [[0, 1, 2], [0, 2, 3], [1, 2, 4]]
    fewer, triangles = bone_meshes.cluster_vertices(points, faces, 0.002)
    assert len(fewer) == 4
    assert len(triangles) == 2  # the sliver between two vertices that became one is gone
    assert np.allclose(fewer.max(axis=0), [0.0101, 0.01005, 0])


def test_a_joint_lies_where_two_bones_meet():
    along = np.linspace(0, 1, 101)[:, None] * [0, -0.04, 0]
    assert np.allclose(
        bone_meshes.joint_centre(along - [0, 0.041, 0], along), [0, -0.041, 0], atol=0.004
    )


def test_shipped_bones_are_small_and_valid():
    assert len(gzip.compress(bone_meshes.FILE.read_bytes())) < 250_000
    for name, part in parts().items():
        assert len(part["points"]) // 3 == max(part["faces"]) + 1, name
        if "on" in part:
            assert part["on"] in parts()
            assert np.linalg.norm(part["axis"]) == pytest.approx(1, abs=0.002)


def test_a_step_writes_it_from_a_folder(tmp_path, monkeypatch):
    """With every bone the same triangles, set apart: enough to see that all parts are read."""
    names = [name for _, of in bone_meshes.PARTS.values() for name in of.split()]
    names += [f"arm_r_{name}" for of in bone_meshes.FINGERS.values() for name in of.split()]
    for k, name in enumerate(names):
        origin = f"{0.01 * (k % 5):g} {0.02 * k:g} {0.01 * (k % 3):g}"
        text = re.sub(r"0 0 0  .*\n", f"{origin}  1 0 0  1 1 0  0 1 0  2 2 0\n", VTP)
        (tmp_path / f"{name}.vtp").write_text(text, encoding="utf-8")
    monkeypatch.setattr(bone_meshes, "FILE", tmp_path / "vendor/bones.js")
    bone_meshes.write(tmp_path)
    fingers = {f"{finger} {k}" for finger in bone_meshes.FINGERS for k in range(3)}
    assert parts().keys() == bone_meshes.PARTS.keys() | fingers
