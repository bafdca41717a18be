from types import SimpleNamespace

import numpy as np
import pytest

from reproduce.peers.adaptive_controllers import (
    LEARNERS,
    DeltaRuleCells,
    DistalTeacher,
    FeedbackError,
)
from vmc_lib.cerebellum.online import AimCorrection, mossy_fibres
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, plan
from vmc_lib.motor.templates import load


@pytest.fixture(scope="module")
def some():
    return plan(draw_targets(load(), 20, np.random.default_rng(7)), load())


@pytest.mark.parametrize("name", LEARNERS)
def test_every_peer_learns_something(name, some):
    kind, cells = LEARNERS[name]
    pupil = kind(load(), cells())
    before = execute(pupil.correct(some)).error.mean()
    pupil.update(some)
    assert execute(pupil.correct(some)).error.mean() < 0.9 * before


def test_delta_rule_update():
    """A weight changes by rate × activity × error; many updates fit the data."""
    x, y = np.random.default_rng(0).uniform(size=(2, 3, 2))
    cells = DeltaRuleCells(width=0.3, cells=50, rate=0.1).fit(x, np.zeros_like(y))
    cells.partial_fit(x[:1], y[:1])
    active = cells.excite(x[:1])
    np.testing.assert_allclose(cells.purkinje_, 0.1 * active.T @ y[:1])
    again = DeltaRuleCells(width=0.3, cells=50, rate=0.1).fit(x, y)
    for _ in range(3000):
        again.partial_fit(x, y)
    np.testing.assert_allclose(again.predict(x), y, atol=1e-3)


def test_hindsight_and_feedback_error_differ_in_inputs_alone(some):
    """How far beyond to aim is the same number; they differ in where it is held for right."""
    aim, endpoint = some.target + 0.01, some.target - [0.02, 0.0]
    (at_end, hindsight), (at_target, aim_change) = (
        kind(load(), DeltaRuleCells()).training_pairs(some, aim, endpoint)
        for kind in (AimCorrection, FeedbackError)
    )
    np.testing.assert_allclose(hindsight, aim_change)
    np.testing.assert_allclose(at_end[:, :2], endpoint)
    np.testing.assert_allclose(at_target, mossy_fibres(some))


def test_distal_teacher_uses_the_models_jacobian(some):
    """The model's arm goes twice as far as it aims to the side, and turns up into side as well."""
    turn = np.array([[1.0, 0.0], [0.5, 0.0]])
    pupil = DistalTeacher(load(), DeltaRuleCells())
    pupil.model = SimpleNamespace(partial_fit=lambda x, y: None, predict=lambda x: x[:, :2] @ turn)
    endpoint = some.target - [0.02, 0.01]
    inputs, change = pupil.training_pairs(some, some.target, endpoint)
    np.testing.assert_allclose(change, np.tile([0.04, 0.02], (len(endpoint), 1)), atol=1e-9)
    np.testing.assert_allclose(inputs, mossy_fibres(some))
