"""The whole arm's model and bones, derived from a full body: equal to their source."""

import json

import mujoco
import numpy as np

from reproduce.whole_arm import bones, derive, plant

SMALL = """
<mujoco>
  <option timestep="0.002"/>
  <worldbody>
    <body name="torso" pos="0 0 1" euler="90 0 0">
      <geom name="chest" type="sphere" size="0.04" pos="0 0.02 0.02"/>
      <site name="origin" pos="0.05 0.1 0"/> <site name="aside" pos="0.1 0 0.1"/>
      <body name="clavicle_r" pos="0 0.1 0">
        <joint name="one" axis="0 0 1" range="-2 2" damping="0.1"/>
        <geom size="0.02" mass="1"/>
        <site name="passing" pos="0.05 0 0.01"/>
        <body name="humerus_r" pos="0.1 0 0" euler="0 20 0">
          <joint name="two" axis="0 1 0.2" range="-2 2" armature="0.01"/>
          <geom name="bone" type="cylinder" size="0.02 0.1" mass="2"/>
          <site name="insertion" pos="0.1 0 0.02"/> <site name="IFtip_r" pos="0.2 0 0"/>
        </body>
      </body>
    </body>
  </worldbody>
  <tendon>
    <spatial name="t"><site site="origin"/><geom geom="chest" sidesite="aside"/>
      <site site="passing"/><geom geom="bone"/><site site="insertion"/>
      <pulley divisor="2"/><site site="origin"/><site site="passing"/></spatial>
  </tendon>
  <actuator><muscle name="t" tendon="t" force="100" lengthrange="0.1 0.5"/></actuator>
  <equality><joint joint1="one" joint2="two" polycoef="0 0.5 0 0 0"/></equality>
</mujoco>
"""


def test_derived_model_moves_like_its_source():
    """The same lengths and, but for gravity's direction, the same forces, in any posture."""
    full = mujoco.MjModel.from_xml_string(SMALL)
    small = mujoco.MjModel.from_xml_string(derive.arm_mjcf(full))
    turn = mujoco.MjData(full)
    mujoco.mj_kinematics(full, turn)
    full.opt.gravity[:] = turn.body("torso").xmat.reshape(3, 3) @ [0, -9.81, 0]
    one, other = mujoco.MjData(full), mujoco.MjData(small)
    for q in np.random.default_rng(0).uniform(-1, 1, (20, 2)):
        for model, data in ((full, one), (small, other)):
            data.qpos[:] = q
            mujoco.mj_forward(model, data)
        np.testing.assert_allclose(other.ten_length, one.ten_length, atol=1e-5)
        np.testing.assert_allclose(other.qfrc_bias, one.qfrc_bias, atol=1e-3)


def test_bones_lie_where_the_bodies_have_them():
    mesh = '<asset><mesh name="m" vertex="0 0 0  1 0 0  0 1 0  0 0 1"/></asset>'
    geom = '<geom type="mesh" mesh="m" pos="{}" contype="0" conaffinity="0"/>'
    text = SMALL.replace("<tendon>", mesh + "<tendon>")
    text = text.replace('<geom name="chest"', geom.format("3 0 0") + '<geom name="chest"')
    text = text.replace('<site name="passing"', geom.format("0 0 2") + '<site name="passing"')
    full = mujoco.MjModel.from_xml_string(text)
    corners = {tuple(x) for x in [*np.eye(3), np.zeros(3)]}
    at = mujoco.MjData(full)
    mujoco.mj_kinematics(full, at)
    place, axes = derive.world_frame(at, full.body("torso").id)
    shifts = {
        "world": lambda x: (x - place) @ axes - [3, 0, 0],
        "clavicle_r": lambda x: x - [0, 0, 2],
    }
    meshes = bones.bone_meshes(full)
    assert set(meshes) == set(shifts)
    for name, back in shifts.items():
        points = back(np.reshape(meshes[name]["points"], (-1, 3)) / 1e4)
        assert {tuple(np.abs(x)) for x in points.round(3)} == corners
        assert len(meshes[name]["faces"]) == 12


def test_bones_that_ship_are_small_and_whole():
    assert bones.FILE.stat().st_size < 2e6
    for name, part in json.loads(bones.FILE.read_bytes()).items():
        plant.MODEL.body(name)  # raises KeyError where there is none
        assert len(part["points"]) == 3 * (max(part["faces"]) + 1), name
