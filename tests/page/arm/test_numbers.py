"""What the arms in the page compute is what Python computes."""

import json
from dataclasses import replace

import numpy as np
import pytest

from book.figures import whole_arm_live
from book.figures.whole_arm import arm_data, lines
from page.arm import live
from tests.page.arm.controls import WHOLE_ARM_TARGET
from vmc_lib.arm import muscle
from vmc_lib.arm.arm26 import geometry
from vmc_lib.arm.dynamics import paths
from vmc_lib.arm.kinematics import to_world
from vmc_lib.arm.model import MUSCLES
from vmc_lib.arm.simulate import simulate
from vmc_lib.cerebellum.offline import algorithm_1, broyden_calibration
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import (
    draw_targets,
    exact_weights,
    habitual_weights,
    is_surrounded,
    plan,
)
from vmc_lib.show.packed import unpack_bytes

WHOLE = 2  # its place among the arms of the page
POSTURES = np.random.default_rng(3).uniform([-0.8, 0.1], [0.6, 2.0], (40, 2))
TARGETS = np.array([[0.12, -0.42], [0.045, -0.345], [0.17, -0.46]])
TARGETS_3D = np.array([WHOLE_ARM_TARGET, [0.52, 0.07, -0.065], [0.485, -0.09, -0.17]])
CLOSE = 1e-3  # rad, m: of the whole arm, as the page has another version of MuJoCo
ANATOMY = """const message = given.scene.find((message) => message.startsWith("anatomy|"));
  const data = JSON.parse(message.slice(8)), anatomy = new vmc["demo/anatomy"].Anatomy(data); """


@pytest.mark.browser
@pytest.mark.parametrize(
    ("name", "law", "low", "high"),
    [
        ("activationRate", muscle.activation_rate, (0, 0), (1, 1)),
        ("forceLength", muscle.force_length, (0,), (2,)),
        ("forceVelocity", muscle.force_velocity, (-4,), (2,)),  # the guards included
        ("passiveForce", muscle.passive_force, (0,), (2,)),
        ("force", muscle.force, (0, 0.2, -3, 0), (1, 1.8, 1.5, 1000)),
    ],
)
def test_muscle_laws(ask, name, law, low, high):
    asked = np.random.default_rng(1).uniform(low, high, (300, len(low)))
    script = f"return asked.map((all) => new muscle.Muscle(given.muscle).{name}(...all));"
    expected = law(*asked.T)
    assert np.allclose(ask(script, asked.tolist()), expected, rtol=1e-12, atol=1e-12)
    assert np.ptp(expected) > 0.5


@pytest.mark.browser
def test_constants_are_pythons_and_a_replaced_law_is_noticed(ask, monkeypatch):
    script = "return new muscle.Muscle(asked).differs;"
    assert ask(script, live.page_constants()["muscle"]) is False
    monkeypatch.setattr(muscle, "TAU_ACTIVATION", 0.05)
    assert ask(script, live.page_constants()["muscle"]) is False
    for name in ("activation_rate", "force_length", "force_velocity", "passive_force"):
        with monkeypatch.context() as patch:
            law = getattr(muscle, name)
            patch.setattr(muscle, name, lambda *given, law=law: 1.01 * law(*given))
            assert ask(script, live.page_constants()["muscle"]) is True, name


@pytest.mark.browser
def test_movements(ask):
    rng = np.random.default_rng(2)
    wild = np.repeat(rng.random((3, 20, 6)), 50, axis=1)  # 1 s, a new command every 50 ms
    motion = simulate(wild, templates.START, live.page_constants()["rest"], engine="mujoco")
    for excitations, q, active in zip(wild, motion.q, motion.activation, strict=True):
        moved = ask("return arm.move(asked);", excitations.tolist())
        assert np.abs([moment["q"] for moment in moved] - q).max() < 1e-9
        assert np.abs([moment["activation"] for moment in moved] - active).max() < 1e-12
    assert np.ptp(motion.q[:, -1], axis=0).min() > 0.05


@pytest.mark.browser
def test_movements_of_the_whole_arm(ask, past):
    reach = plan(WHOLE_ARM_TARGET, past)
    moved = ask("return arm.reach(asked);", reach.excitations.tolist(), WHOLE)[1:]
    motion = execute(reach).motion
    assert np.abs(np.array([moment["q"] for moment in moved]) - motion.joints).max() < CLOSE
    assert np.allclose([moment["activation"] for moment in moved], motion.activation, atol=1e-9)
    assert np.ptp(motion.joints, axis=0).max() > 0.1


@pytest.mark.browser
def test_joints_and_what_is_drawn_of_the_arm(ask):
    script = "return asked.map((q) => [anatomy.wrist(q, 0.4), anatomy.paths(q), arm.joints(q)]);"
    drawn = ask(ANATOMY + script, POSTURES.tolist())
    for q, (wrist, muscles, joints) in zip(POSTURES, drawn, strict=True):
        expected = geometry(q)
        assert np.allclose(joints, expected.joints, atol=1e-12)
        assert np.allclose(wrist, to_world(expected.joints[-1], 0.4))
        lengths = [np.linalg.norm(np.diff(path, axis=0), axis=1).sum() for path in muscles]
        assert np.allclose(lengths, paths(q)[0], atol=1e-3)
        for name, path in zip(MUSCLES, muscles, strict=True):
            gaps = np.linalg.norm(expected.muscles[name][:, None] - path, axis=-1)
            assert gaps.min(axis=1).max() < 3e-3, name


@pytest.mark.browser
def test_what_is_drawn_of_the_whole_arm(ask, past):
    joints = execute(plan(WHOLE_ARM_TARGET, past)).motion.joints[-1]
    for q in (whole_arm_live.START, joints):
        (ends, ways), data = lines(q), arm_data(q)
        drawn = ask("return arm.look(asked);", q.tolist(), WHOLE)
        assert np.allclose(drawn["joints"], ends, atol=1e-9)
        bodies = map(data.body, ask("return Object.keys(given.bones);", arm=WHOLE))
        frames = [[*body.xmat, *body.xpos] for body in bodies]
        assert np.allclose(drawn["frames"], frames, atol=1e-9)
        apart = [np.abs(np.subtract(*both)).max() for both in zip(drawn["ways"], ways, strict=True)]
        assert np.sum(np.array(apart) > 1e-9) <= 3  # MuJoCo 4 leads them round another side
        assert max(apart) < 0.02


@pytest.mark.browser
def test_a_muscle_reddens_with_activation_and_swells_as_it_shortens(ask):
    rest, half, full = ask("return [0, 0.25, 1].map(vmc['demo/muscles'].redness);")
    assert np.allclose(half, np.mean([rest, full], axis=0))  # the root of a quarter
    assert full[1] < 0.2 < rest[1]
    script = """return asked.map((q) =>
      anatomy.paths(q).map((path, k) => anatomy.belly(path, data.muscles[k])));"""
    bellies = ask(ANATOMY + script, [[0.0, 0.2], [0.0, 1.6]])
    for name, straight, bent in zip(MUSCLES, *bellies, strict=True):
        shorter = name[:2] != "TR"  # bending shortens biceps and brachialis
        assert (max(bent["radii"]) > max(straight["radii"])) == shorter
        assert flesh_volume(straight) == pytest.approx(flesh_volume(bent), rel=0.05)


def flesh_volume(belly):
    steps = np.linalg.norm(np.diff(belly["centres"], axis=0), axis=1)
    radii = np.where(np.array(belly["flesh"]) > 0, belly["radii"], 0)
    return np.pi * (steps * (radii[1:] ** 2 + radii[:-1] ** 2) / 2).sum()


@pytest.mark.browser
@pytest.mark.parametrize("arm", [0, WHOLE], ids=["planar", "whole"])
@pytest.mark.parametrize(
    ("name", "rule"), [("habitualWeights", habitual_weights), ("exactWeights", exact_weights)]
)
def test_plans(ask, past, arm, name, rule):
    script = f"""const plan = planning.plan(asked, templateSet, planning.{name});
      return {{ ...plan, u: templateSet.excitations(plan) }};"""
    if arm == WHOLE:
        plans = [(target, plan(target, past, rule=rule)) for target in TARGETS_3D]
    else:
        own = templates.load()
        inner = own.points[is_surrounded(own.points, own.points)]
        targets = [*TARGETS, *inner[:2]]  # the last two on a template itself
        plans = [(target, plan(target, own, rule)) for target in targets]
    for target, expected in plans:
        answer = ask(script, target.tolist(), arm)
        close = {"atol": 1e-10 if arm == WHOLE else 1e-12}
        assert answer["chosen"] == expected.rows.tolist()
        assert np.allclose(answer["weights"], expected.weights, **close)
        assert np.allclose(answer["u"], expected.excitations, **close)


@pytest.mark.browser
def test_a_reach_with_weights_set_by_hand(ask):
    rng, own = np.random.default_rng(5), templates.load()
    targets, by_hand = draw_targets(own, 20, rng), rng.uniform(-0.1, 0.6, (20, 4))
    planned = plan(targets, own)
    hold = execute(replace(planned, weights=by_hand)).hold
    script = "return asked.map(([at, weights]) => reach(planning.plan(at, templateSet))(weights));"
    asked = [[*pair] for pair in zip(targets.tolist(), by_hand.tolist(), strict=True)]
    seen = np.array(ask(script, asked))
    assert np.abs(seen[..., :2] - hold).max() < 1e-6


def broyden(planned):
    return broyden_calibration(planned, live.TRIALS)


@pytest.mark.browser
@pytest.mark.parametrize(
    ("name", "rule", "arm"),
    [
        ("algorithm1", algorithm_1, 0),
        ("broydenCalibration", broyden, 0),
        ("broydenCalibration", broyden, WHOLE),
    ],
)
def test_calibration(ask, past, name, rule, arm):
    script = f"""const plan = planning.plan(asked, templateSet);
      return [...calibration.{name}(plan, reach(plan), given.calibration)];"""
    planar = plan(TARGETS, templates.load())
    planned = plan(TARGETS_3D, past) if arm == WHOLE else planar
    expected = rule(planned)
    arrays = {"reached": expected.endpoint, "error": expected.error}
    if arm != WHOLE:
        arrays |= {"weights": expected.weights}
    for k, target in enumerate(planned.target):
        trials = ask(script, target.tolist(), arm)
        for key, array in arrays.items():
            answer = np.array([trial[key] for trial in trials])
            assert np.abs(answer - array[:, k]).max() < (CLOSE if arm == WHOLE else 1e-6), key


@pytest.mark.browser
def test_templates_on_a_line_and_targets_outside_are_refused(ask):
    script = "try {{ {} }} catch (error) {{ return error.message; }}"
    on_a_line = [[0.1, -0.4], [0.2, -0.4], [0.3, -0.4], [0.4, -0.4]]
    exact = script.format("return planning.exactWeights([0.25, -0.35], asked);")
    assert "on one line" in ask(exact, on_a_line)
    planned = script.format("return planning.plan(asked, templateSet);")
    assert "not surrounded" in ask(planned, [0.5, -0.4])


def test_knots_make_the_templates():
    given = live.page_constants()["templateSet"]
    knots = np.frombuffer(unpack_bytes(given["knots"]), np.float32)
    knots = knots.reshape(given["shape"]).astype(float)
    assert np.abs(live.spline() @ knots - templates.load().excitations).max() < 1e-12
    json.dumps(given, allow_nan=False)
