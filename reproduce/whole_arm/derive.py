"""`arm63.xml` from MyoArm (`myo-sim`, Apache 2.0): its muscles and joints, without meshes.

Kept are what moves and pulls: the bodies from the collarbone on with their masses in numbers, the
joints as far as the wrist, the muscles, the points and shapes that they run over. The fingers stay
straight, the trunk is the world, and the shoulder is its origin. The shoulder blade follows more
strictly than there: its couplings settle in 5 ms in place of 20.
Needs `pip install --no-deps myo-sim==0.2.4`: it asks for MuJoCo 3, and works with ours.
"""

from xml.etree import ElementTree

import mujoco
import numpy as np

from reproduce.whole_arm.plant import FILE

JOINTS = 18  # as far as the wrist; the fingers' come after
SHAPES = {2: "sphere", 5: "cylinder"}  # by mujoco.mjtGeom
SITE, PULLEY = 3, 2  # of mujoco.mjtWrap


def main():
    """Write the file."""
    import myo_sim  # nothing else needs it

    FILE.write_text(
        arm_mjcf(myo_sim.load_spec("myoarm_r").compile()) + "\n", encoding="utf-8", newline="\n"
    )


def arm_mjcf(full):
    """The MJCF text of the arm in a compiled MyoArm."""
    root = ElementTree.Element("mujoco", model="MyoArm without meshes: see CREDITS.md")
    ElementTree.SubElement(root, "compiler", angle="radian")
    ElementTree.SubElement(root, "option", timestep="0.002", gravity="0 -9.81 0")
    world, tendons, pulls, couples = (
        ElementTree.SubElement(root, name)
        for name in ("worldbody", "tendon", "actuator", "equality")
    )
    for muscle in range(full.nu):
        _muscle(full, muscle, tendons, pulls)
    used = {(e.tag, e.get(e.tag)) for e in tendons.iter() if e.tag in ("site", "geom")}
    used |= {("site", e.get("sidesite")) for e in tendons.iter("geom")} | {("site", "fingertip")}
    _bodies(full, world, used)
    for one, other, data in zip(full.eq_obj1id, full.eq_obj2id, full.eq_data, strict=True):
        joints = {"joint1": full.joint(one).name, "joint2": full.joint(other).name}
        _add(couples, "joint", **joints, polycoef=data[:5], solref=[0.005, 1])
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode")


def _add(parent, tag, **values):
    """A new element; numbers are written with six digits."""
    words = {
        key: v if isinstance(v, str) else " ".join(f"{x:.6g}" for x in np.atleast_1d(v))
        for key, v in values.items()
    }
    return ElementTree.SubElement(parent, tag, words)


def _muscle(full, k, tendons, pulls):
    """A muscle's path, by the numbers of its points and shapes, and its strength."""
    tendon, name = full.actuator_trnid[k, 0], full.actuator(k).name
    path = _add(tendons, "spatial", name=name)
    for part in range(full.tendon_adr[tendon], full.tendon_adr[tendon] + full.tendon_num[tendon]):
        kind, thing, more = full.wrap_type[part], full.wrap_objid[part], full.wrap_prm[part]
        if kind == SITE:
            _add(path, "site", site=f"p{thing}")
        elif kind == PULLEY:
            _add(path, "pulley", divisor=more)
        else:
            beside = {"sidesite": f"p{int(more)}"} if more >= 0 else {}
            _add(path, "geom", geom=f"w{thing}", **beside)
    law = dict.fromkeys(("dyntype", "gaintype", "biastype"), "muscle")
    limits = {"ctrlrange": [0, 1], "lengthrange": full.actuator_lengthrange[k]}
    numbers = {key: getattr(full, f"actuator_{key}")[k, :9] for key in ("gainprm", "biasprm")}
    dynamics = full.actuator_dynprm[k, :3]
    _add(pulls, "general", name=name, tendon=name, **law, **limits, **numbers, dynprm=dynamics)


def world_frame(data, body):
    """Where a body of MyoArm lies in our world, (3,), and its axes (3, 3)."""
    turn, origin = data.body("torso").xmat.reshape(3, 3), data.body("humerus_r").xpos
    return turn.T @ (data.xpos[body] - origin), turn.T @ data.xmat[body].reshape(3, 3)


def _bodies(full, world, used):
    """The bodies, and on each what muscles run over; the trunk's things belong to the world."""
    data, made, arm = mujoco.MjData(full), {}, full.body("clavicle_r").id
    mujoco.mj_kinematics(full, data)
    for body in range(full.nbody):
        place, axes = world_frame(data, body)
        if body < arm:
            _geometries(full, body, world, used, place, axes)
            continue
        parent = made.get(full.body_parentid[body])
        if parent is not None:
            place, axes = full.body_pos[body], rotation_matrix(full.body_quat[body])
        parent = world if parent is None else parent
        frame = {"name": full.body(body).name, "pos": place, "quat": _quaternion(axes)}
        made[body] = _add(parent, "body", **frame)
        rest = ("pos", "ipos"), ("quat", "iquat"), ("diaginertia", "inertia"), ("mass", "mass")
        inertia = {word: getattr(full, f"body_{name}")[body] for word, name in rest}
        _add(made[body], "inertial", **inertia)
        first = full.body_jntadr[body]
        for joint in range(first, first + full.body_jntnum[body]):
            if joint < JOINTS:
                _joint(full, joint, made[body])
        _geometries(full, body, made[body], used)


def _joint(full, k, body):
    turns = {"axis": full.jnt_axis[k], "pos": full.jnt_pos[k], "range": full.jnt_range[k]}
    slow = {"damping": full.dof_damping[k], "armature": full.dof_armature[k]}
    _add(body, "joint", name=full.joint(k).name, **turns, **slow)


def _geometries(full, body, element, used, place=0.0, axes=np.eye(3)):  # noqa: B008 (never written to)
    """What muscles run over on a body, whose place and axes an element has so."""
    for k in np.flatnonzero(full.geom_bodyid == body):
        if ("geom", f"w{k}") in used:
            frame = {"pos": place + axes @ full.geom_pos[k]}
            frame["quat"] = _quaternion(axes @ rotation_matrix(full.geom_quat[k]))
            kind = SHAPES[full.geom_type[k]]
            size = full.geom_size[k, : 1 + (kind == "cylinder")]
            loose = {"contype": "0", "conaffinity": "0", "mass": "0"}
            _add(element, "geom", name=f"w{k}", type=kind, size=size, **frame, **loose)
    for k in np.flatnonzero(full.site_bodyid == body):
        name = "fingertip" if full.site(k).name == "IFtip_r" else f"p{k}"
        if ("site", name) in used:
            _add(element, "site", name=name, pos=place + axes @ full.site_pos[k])


def rotation_matrix(quaternion):
    """The rotation matrix (3, 3) of a quaternion (4,)."""
    matrix = np.empty(9)
    mujoco.mju_quat2Mat(matrix, quaternion)
    return matrix.reshape(3, 3)


def _quaternion(matrix):
    quaternion = np.empty(4)
    mujoco.mju_mat2Quat(quaternion, matrix.ravel())
    return quaternion


if __name__ == "__main__":
    main()
