"""What swapping one part of the reach changes."""

from itertools import product

import numpy as np

from reproduce.experiments import planning_ablation as ablation
from vmc_lib.motor.planning import Plan, draw_targets, plan
from vmc_lib.motor.templates import load


def test_a_correction_keeps_its_best_trial():
    """So none leaves more than the plan, and two trials no more than one."""
    targets = np.array([[0.10, -0.40], [0.15, -0.41]])
    for weights, cm in product(ablation.WEIGHTS, ablation.SPACINGS):
        none, published, one, two = (
            ablation.reach_errors(targets, weights, how, cm) for how in ablation.CORRECTIONS
        )
        assert (published <= none).all()
        assert (two <= one).all()
        assert (one <= none).all()


def test_exact_weights_leave_less_than_habitual_ones():
    [ratio] = ablation.exact_weight_ratios(seeds=[0], count=20)
    assert 0 < ratio < 0.8


def test_only_noise_makes_a_repeated_command_worse_than_its_best_trial():
    habit = plan(draw_targets(load(), 3, np.random.default_rng(1)), load())
    calm = ablation.repeated_errors(habit)
    for rule in ablation.RULES:
        np.testing.assert_allclose(calm[f"{rule}, again"], calm[f"{rule}, best trial"], atol=1e-9)

    class Noisy(Plan):
        @property
        def excitations(self):
            u = super().excitations
            return np.clip(u * rng.normal(1, 0.4, u.shape), 0, 1)

    rng = np.random.default_rng(2)
    noisy = ablation.repeated_errors(Noisy(**vars(habit)))
    for rule in ablation.RULES:
        assert noisy[f"{rule}, again"].mean() > noisy[f"{rule}, best trial"].mean()
