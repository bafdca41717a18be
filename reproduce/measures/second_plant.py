"""Another robot, planned and calibrated by the same functions: two links driven by torques.

The paper says that its method applies to other robots. This one has no muscles: two uniform rods
turn in a horizontal plane, with viscous joints, by any textbook's equations (Eq. 12 with torques in
place of muscles). All its numbers are our choice.
"""

from functools import partial
from types import SimpleNamespace

import numpy as np

from vmc_lib.arm.simulate import UNPERTURBED, check_unperturbed
from vmc_lib.cerebellum.offline import algorithm_1, broyden_calibration
from vmc_lib.cerebellum.online import AimCorrection
from vmc_lib.motor.execution import execute
from vmc_lib.motor.inverse_dynamics import minimum_jerk
from vmc_lib.motor.planning import draw_targets, exact_weights, plan
from vmc_lib.motor.templates import HOLD, TemplateSet

L1, L2, M1, M2 = 0.35, 0.30, 3.0, 2.0  # m and kg: the rods' lengths and masses
VISCOSITY = 1.0  # N m s / rad, of both joints
STEP, MOVING, SAMPLES = 0.002, 350, 500  # s; steps of a movement, and with the hold that follows
START = np.radians([0.0, 110.0])
GOALS = np.stack(np.meshgrid(*[np.arange(0.15, 0.46, 0.06)] * 2), axis=-1).reshape(-1, 2)  # m


def tip(q):
    """Where postures q (…, 2) put the arm's tip, (…, 2), m."""
    bearings = np.stack([q[..., 0], q.sum(axis=-1)], axis=-1)  # of the two rods
    return np.stack([np.cos(bearings) @ [L1, L2], np.sin(bearings) @ [L1, L2]], axis=-1)


def posture(point):
    """The joint angles (…, 2), elbow bent leftwards, that put the tip at a point (…, 2)."""
    elbow = np.arccos(((point**2).sum(axis=-1) - L1**2 - L2**2) / (2 * L1 * L2))
    aside = np.arctan2(L2 * np.sin(elbow), L1 + L2 * np.cos(elbow))
    return np.stack([np.arctan2(point[..., 1], point[..., 0]) - aside, elbow], axis=-1)


def mass_and_drag(q, velocity):
    """The mass matrix (…, 2, 2), and the Coriolis and viscous torques (…, 2)."""
    cos, sin = np.cos(q[..., 1]), np.sin(q[..., 1])
    coupled, far, (v1, v2) = M2 * L1 * L2 / 2, M2 * L2**2 / 3, np.moveaxis(velocity, -1, 0)
    near, cross = (M1 / 3 + M2) * L1**2 + far + 2 * coupled * cos, far + coupled * cos
    mass = np.stack([near, cross, cross, far + 0 * cos], axis=-1).reshape(*cos.shape, 2, 2)
    coriolis = coupled * np.stack([-sin * v2 * (2 * v1 + v2), sin * v1**2], axis=-1)
    return mass, coriolis + VISCOSITY * velocity


def reach(torques, perturbation=UNPERTURBED):
    """The tip's path over the hold, `hold` (…, n, 2), and its mean, `endpoint`, in m.

    Torques (…, T, 2), in N m, move the arm from rest in `START`; the last are then held.
    ValueError for a perturbation.
    """
    check_unperturbed(perturbation)
    q, velocity = (np.broadcast_to(x, (*torques.shape[:-2], 2)) for x in (START, np.zeros(2)))
    held, path = round(HOLD / STEP), []
    for step in range(torques.shape[-2] + held):
        torque = torques[..., min(step, torques.shape[-2] - 1), :]
        mass, drag = mass_and_drag(q, velocity)
        velocity = velocity + STEP * np.linalg.solve(mass, (torque - drag)[..., None])[..., 0]
        q = q + STEP * velocity
        path.append(q)
    hold = tip(np.stack(path[-held - 1 :], axis=-2))
    return SimpleNamespace(hold=hold, endpoint=hold.mean(axis=-2))


def torque_templates():
    """Past experience: the torques that bring the tip smoothly to each of GOALS (N, 2)."""
    q = minimum_jerk(START, posture(GOALS), SAMPLES, MOVING)
    velocity = np.diff(q, axis=1, prepend=q[:, :1]) / STEP
    mass, drag = mass_and_drag(q[:, :-1], velocity[:, :-1])
    torques = (mass @ (np.diff(velocity, axis=1) / STEP)[..., None])[..., 0] + drag
    return TemplateSet(reach(torques).endpoint, torques, (-np.inf, np.inf), reach)


def experiment(seed, laws=None):
    """For one draw of targets, by name: the planned miss over the reach, and what rules leave.

    Other laws in the place of Eq. 6–7, each of a random generator `rng`, leave so much after as
    many tries, by their names, and after two.
    """
    rng, past = np.random.default_rng(seed), torque_templates()
    habit, lessons = (plan(draw_targets(past, n, rng), past) for n in (25, 100))
    tries = broyden_calibration(habit).error.mean(axis=1)
    aimed = AimCorrection(past).update(lessons).correct(habit)
    left = {
        "off-line, published": algorithm_1(habit).error.min(axis=0).mean(),
        "own off-line": tries[2],
        "own online": execute(aimed).error.mean(),
        "exact weights": execute(plan(habit.target, past, exact_weights)).error.mean(),
    }
    for name, law in (laws or {}).items():
        tried = algorithm_1(habit, change=partial(law, rng=rng)).error
        left[name], left[f"{name}, two tries"] = (
            tried[:k].min(axis=0).mean() for k in (len(tried), 3)
        )
    reach_of = np.linalg.norm(habit.target, axis=-1).mean()
    return {"planned / reach": tries[0] / reach_of, **{k: v / tries[0] for k, v in left.items()}}
