"""What swapping one part of the reach changes."""

from itertools import product

import numpy as np

from reproduce.experiments import planning_ablation as ablation
from vmc_lib.motor.planning import draw_targets, plan
from vmc_lib.motor.templates import load


def test_a_correction_keeps_its_best_trial():
    """So none leaves more than the plan, and two trials no more than one."""
    targets = np.array([[0.10, -0.40], [0.15, -0.41]])
    for weights, cm in product(ablation.WEIGHTS, ablation.SPACINGS):
        none, published, one, two, _ = (
            ablation.reach_errors(targets, weights, how, cm) for how in ablation.CALIBRATIONS
        )
        assert (published <= none).all()
        assert (two <= one).all()
        assert (one <= none).all()


def test_only_noise_makes_a_repeated_command_worse_than_its_best_trial():
    habit = plan(draw_targets(load(), 3, np.random.default_rng(1)), load())
    calm = ablation.repeated_errors(habit)
    for rule in ablation.RULES:
        np.testing.assert_allclose(calm[f"{rule}, again"], calm[f"{rule}, best trial"], atol=1e-9)
    noisy = ablation.repeated_errors(ablation.on_noisy_arm(habit, 40))
    for rule in ablation.RULES:
        assert noisy[f"{rule}, again"].mean() > noisy[f"{rule}, best trial"].mean()


def test_muscle_noise_scatters_the_hand():
    once = plan(np.tile([0.15, -0.40], (10, 1)), load())
    calm, weak, strong = (np.array(ablation.muscle_scatter(once, p)) for p in (0, 10, 40))
    np.testing.assert_allclose(calm, 0, atol=1e-9)
    assert (calm[:3] < weak[:3]).all()
    assert (weak[:3] < strong[:3]).all()
