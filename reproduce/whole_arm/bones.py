"""Bone meshes of the whole arm, from MyoArm's own, simplified for the page.

Each lies in its body's frame, as `arm63.xml` has it; the ribs, which do not move, in the world's.
Needs what `reproduce.whole_arm.derive` needs.
"""

import json

import mujoco
import numpy as np

from reproduce.render.bone_meshes import cluster_vertices, pack_mesh
from reproduce.render.meshes import join_triangles
from reproduce.whole_arm.derive import rotation_matrix, world_frame
from reproduce.whole_arm.plant import FILE as MODEL

FILE = MODEL.with_name("bones63.json")
CELL, RIBS = 0.003, 0.008  # m: sides of the cells in which vertices become one


def main():
    """Write the file."""
    import myo_sim  # nothing else needs it

    full = myo_sim.load_spec("myoarm_r").compile()
    FILE.write_text(
        json.dumps(bone_meshes(full), separators=(",", ":")) + "\n", encoding="utf-8", newline="\n"
    )


def bone_meshes(full):
    """The bones of a compiled MyoArm, as JSON takes them: by body, points and faces, flat."""
    data = mujoco.MjData(full)
    mujoco.mj_kinematics(full, data)
    place, axes = world_frame(data, full.body("torso").id)
    points, faces = _mesh(full, full.body("torso").id)
    bones = {"world": pack_mesh(*cluster_vertices(points @ axes.T + place, faces, RIBS))}
    for body in range(full.body("clavicle_r").id, full.nbody):
        if mesh := _mesh(full, body):
            bones[full.body(body).name] = pack_mesh(*cluster_vertices(*mesh, CELL))
    return bones


def _mesh(full, body):
    """All meshes of a body as one, in its frame: points (n, 3) in m and triangles; or None."""
    meshes = []
    for geom in np.flatnonzero(
        (full.geom_bodyid == body) & (full.geom_type == mujoco.mjtGeom.mjGEOM_MESH)
    ):
        mesh = full.mesh(full.geom_dataid[geom])
        first, faces = mesh.vertadr[0], mesh.faceadr[0]
        points = full.mesh_vert[first : first + mesh.vertnum[0]]
        triangles = full.mesh_face[faces : faces + mesh.facenum[0]]
        meshes.append(
            (points @ rotation_matrix(full.geom_quat[geom]).T + full.geom_pos[geom], triangles)
        )
    return join_triangles(meshes) if meshes else None


if __name__ == "__main__":
    main()
