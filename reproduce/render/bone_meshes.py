"""Bone meshes of the page: OpenSim's own meshes for arm26, made small.

GEOMETRY=path/to/folder python -m reproduce.render.bone_meshes, where the folder holds arm26's
.vtp files, writes `FILE`. Vertices that share a cell of a grid become one, their mean; places are
whole tenths of a millimetre. Bones that never move against each other are one mesh, and a finger
knows the joints that bend it.
"""

import json
import os
import re
from itertools import pairwise
from pathlib import Path

import numpy as np

from reproduce.render.meshes import join_triangles
from vmc_lib.show.packed import pack_bytes
from vmc_lib.show.render_mode import STATIC

FILE = STATIC / "vendor/bones.js"
SHOULDER = np.array([-0.017545, -0.007, 0.17])  # m, in the frame of arm26's own ground
CARPALS = "lunate scaphoid triquetrum pisiform capitate trapezium trapezoid hamate"
MIDDLE = ("2mc", "3mc", "4mc", "5mc")
PARTS = {  # each with the side of its cells, in m: what is pale or far needs fewer vertices
    "ribs": (0.01, "ground_ribs"),
    "spine": (0.016, "ground_spine"),
    "girdle": (0.004, "ground_r_clavicle ground_r_scapula"),
    "humerus": (0.002, "arm_r_humerus"),
    "forearm": (0.002, "arm_r_ulna arm_r_radius"),
    "palm": (0.0045, " ".join(f"arm_r_{name}" for name in (*CARPALS.split(), *MIDDLE))),
}
FINGERS = {
    "thumb": "1mc thumbprox thumbdist",
    **{f"finger{n}": f"{n}proxph {n}midph {n}distph" for n in range(2, 6)},
}


def read(file):
    """Points (n, 3) in metres and triangles (m, 3) of an ASCII .vtp file."""
    text = file.read_text(encoding="utf-8")
    points = parse_numbers(text, "<Points>.*?<DataArray", float).reshape(-1, 3)
    corners, ends = (
        parse_numbers(text, f'Name="{name}"', int) for name in ("connectivity", "offsets")
    )
    faces = np.split(corners, ends[:-1])
    return points, np.array([(face[0], *pair) for face in faces for pair in pairwise(face[1:])])


def parse_numbers(text, before, kind):
    """The numbers of the array whose tag begins with the pattern `before`."""
    return np.array(re.search(f"{before}[^>]*>([^<]*)<", text, re.S)[1].split(), kind)


def cluster_vertices(points, faces, cell):
    """The mesh with one vertex, the mean, for all in a cell; what collapses to a line goes."""
    _, where = np.unique(np.floor(points / cell), axis=0, return_inverse=True)
    where = where.ravel()
    sums = np.stack([np.bincount(where, column) for column in points.T], axis=-1)
    faces = where[faces]
    a, b, c = faces.T
    faces = faces[(a != b) & (b != c) & (c != a)]
    _, first = np.unique(np.sort(faces, axis=1), axis=0, return_index=True)
    used, faces = np.unique(faces[np.sort(first)], return_inverse=True)
    means = sums / np.bincount(where)[:, None]
    return means[used], faces.reshape(-1, 3)


def bone_meshes(folder):
    """All that the page draws, as JSON takes it, from the .vtp files in `folder`.

    `parts`: name -> points and faces, flat; of a bone of a finger also the bone `on` which it
    turns, at which `pivot` (3,) and about which `axis` (3,). `wrist`, `palm` (3,): where the hand
    turns, and the middle of what it holds; `along`, `facing` (3,): where fingers and palm point.
    """

    def mesh(names):
        return join_triangles([read(Path(folder) / f"{name}.vtp") for name in names.split()])

    def middle(*names):
        return np.mean([mesh(f"arm_r_{name}")[0].mean(0) for name in names], axis=0)

    parts = {}
    for name, (cell, of) in PARTS.items():
        points, faces = mesh(of)
        shift = SHOULDER if of.startswith("ground") else 0
        parts[name] = pack_mesh(*cluster_vertices(points - shift, faces, cell))
    wrist, knuckles = middle("scaphoid", "lunate", "triquetrum"), middle(*MIDDLE)
    along = unit_vector(knuckles - wrist)
    facing = unit_vector(np.cross(middle("5mc") - middle("2mc"), along))
    facing *= np.sign((middle("thumbdist") - knuckles) @ facing)
    palm = middle("2proxph", "3proxph", "4proxph") - 0.012 * along + 0.035 * facing
    for finger, names in FINGERS.items():
        on, before = "palm", mesh(PARTS["palm"][1])[0]
        for k, bone in enumerate(f"arm_r_{name}" for name in names.split()):
            points, faces = mesh(bone)
            pivot = joint_centre(points, before)
            axis = unit_vector(np.cross(points.mean(0) - pivot, palm - points.mean(0)))
            turns = {"on": on, "pivot": pivot.round(4).tolist(), "axis": axis.round(3).tolist()}
            on, before = f"{finger} {k}", points
            parts[on] = pack_mesh(*cluster_vertices(points, faces, 0.004)) | turns
    vectors = {"wrist": wrist, "palm": palm, "along": along, "facing": facing}
    return {"parts": parts} | {name: vector.round(4).tolist() for name, vector in vectors.items()}


def joint_centre(bone, before):
    """Where two bones (n, 3), (m, 3) meet: the middle of what is near the other, (3,)."""
    gaps = np.linalg.norm(bone[:, None] - before[None, ::5], axis=-1)
    return bone[gaps.min(1) < gaps.min() + 0.004].mean(0)


def unit_vector(vector):
    """The vector (3,), 1 long."""
    return vector / np.linalg.norm(vector)


def pack_mesh(points, faces):
    """A mesh as JSON takes it."""
    return {
        "points": np.rint(1e4 * points).astype(int).ravel().tolist(),
        "faces": faces.ravel().tolist(),
    }


def write(folder):
    """Write what is `bone_meshes` as a script: a page from disk can load nothing else."""
    text = json.dumps(bone_meshes(folder), separators=(",", ":"))
    data = pack_bytes(text.encode())
    FILE.parent.mkdir(exist_ok=True)
    FILE.write_text(
        f'/* arm26\'s bones (reproduce/render/bone_meshes.py). */\nself.vmcBones = "{data}";\n',
        encoding="utf-8",
        newline="\n",
    )


if __name__ == "__main__":
    write(os.environ["GEOMETRY"])
