"""Choices changed one at a time: each changes what it names, and nothing stays changed."""

import numpy as np
import pytest

from reproduce.experiments import sensitivity
from reproduce.peers.muscle_models import LAWS
from vmc_lib.arm import engines, simulate
from vmc_lib.motor import templates
from vmc_lib.motor.planning import is_surrounded

WILD = np.repeat(np.random.default_rng(0).random((2, 3, 6)), 50, axis=1)
ARMS = {
    sensitivity.name_of(choice, other): given["arm"]
    for choice, others in sensitivity.CHOICES.items()
    for other, given in others.items()
    if "arm" in given
}


def run():
    return simulate.simulate(WILD, templates.START).q


def test_every_setting_ships_with_every_rule():
    shipped = sensitivity.load_results()
    names = [
        sensitivity.name_of(choice, other)
        for choice, others in sensitivity.CHOICES.items()
        for other in others
    ]
    for name in (sensitivity.AS_IT_IS, *names):
        assert list(shipped[name]) == list(sensitivity.RULES)
        assert all(misses.shape == (20,) for misses in shipped[name].values())


def test_every_spacing_surrounds_the_targets():
    for spacing in templates.SPACINGS:
        assert is_surrounded(sensitivity.targets(), templates.load(spacing).points).all()


def test_thelens_muscle_in_the_compiled_arm_equals_mujoco():
    with sensitivity.changed_arm(sensitivity.of_muscle(sensitivity.THELEN)):
        found = run()
    law = LAWS[sensitivity.THELEN]
    reference = simulate.simulate(WILD, templates.START, muscle=law).q
    np.testing.assert_allclose(found, reference, atol=1e-6)


def test_another_arm_is_one_for_a_while():
    before, strength = run(), engines.F0
    with sensitivity.changed_arm(sensitivity.with_strength(0.8)):
        assert np.abs(run() - before).max() > 1e-3
    np.testing.assert_array_equal(run(), before)
    assert engines.F0 is strength


@pytest.mark.audit
@pytest.mark.parametrize("name", ARMS)
def test_templates_of_another_arm_end_where_they_should(name):
    with sensitivity.changed_arm(ARMS[name]):
        found = sensitivity.find_templates(0.11)
    goals = sensitivity.reach_templates.reachable_grid(0.11)
    assert np.linalg.norm(found.points - goals, axis=-1).max() < 0.01


@pytest.mark.audit
def test_shipped_misses_are_reproducible():
    choice, other = "templates apart, 6 cm", "8 cm"
    shipped = sensitivity.load_results()[sensitivity.name_of(choice, other)]
    for rule, misses in sensitivity.misses(**sensitivity.CHOICES[choice][other]).items():
        np.testing.assert_allclose(misses, shipped[rule], atol=2e-4)


@pytest.mark.audit
def test_draws_on_thelens_muscle_are_reproducible():
    past = sensitivity.thelen_templates(templates.SPACING)
    now = sensitivity.thelen_tables(past, sensitivity.MANY[0], experiments=1)
    shipped = sensitivity.load_thelen_tables()
    assert now == pytest.approx({name: values[0] for name, values in shipped.items()}, abs=2e-3)
