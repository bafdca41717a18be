"""Online calibration as its chapter shows it: lessons, lesions, changed worlds."""

import numpy as np
import pytest

from reproduce.experiments import online_calibration
from reproduce.experiments.calibration import SCENARIOS, no_calibration
from reproduce.experiments.online_calibration import error_shares, learn
from reproduce.measures.changed_worlds import BLOCKS, PERTURBATIONS
from vmc_lib.cerebellum.online import WeightCorrection
from vmc_lib.motor import templates


@pytest.fixture(scope="module")
def plans():
    template_set = templates.load(spacing=0.06)
    drawn = online_calibration.draw_plans(template_set, SCENARIOS[0], np.random.default_rng(0))
    return {name: some[:5] for name, some in drawn.items()}


def test_before_its_first_lesson_a_model_leaves_the_planned_error(plans):
    history = learn(WeightCorrection(), plans, [plans["practised"]], rule=no_calibration)
    for name, shares in error_shares(history, plans).items():
        assert history[name].shape == (2, 5, 51, 2)
        assert shares[0] == 1
        assert shares[1] != 1


def test_four_fixed_templates_are_those_of_every_plan():
    template_set = templates.load(spacing=0.06)
    drawn = online_calibration.draw_plans(template_set, SCENARIOS[1], np.random.default_rng(0))
    assert {name: len(some.target) for name, some in drawn.items()} == {
        "practised": 25,
        "never practised": 100,
    }
    assert all(len(some.template_set.points) == 4 for some in drawn.values())


def test_only_off_line_calibration_makes_the_second_attempt_another(plans):
    class Unchanged:
        """A trained correction that corrects nothing."""

        def correct(self, plan):
            return plan

    attempts = online_calibration.lesions(plans["practised"], Unchanged())
    for (_, offline), (first, second) in attempts.items():
        assert (second.error.mean() < first.error.mean()) == offline
        assert np.array_equal(first.endpoint, attempts[False, False][0].endpoint)


def test_in_a_changed_world_only_what_learns_gets_better(plans):
    prism = {"a prism": PERTURBATIONS["a prism"]}
    trained, _ = online_calibration.granule_cell_history(
        {"practised": plans["practised"]}, np.random.default_rng(1)
    )
    learners, curves = online_calibration.adapt_to_worlds(
        trained, plans["practised"].template_set, prism
    )
    assert set(learners) == {("a prism", "aim"), ("a prism", "pull")}
    before, during, _ = BLOCKS
    aim, baseline = (curves["a prism", cure].error for cure in ("aim", "nothing learns"))
    assert len(aim) == sum(BLOCKS)
    assert aim[before + during - 1] < 0.5 * baseline[before + during - 1]
    assert aim[before + during] > 3 * baseline[before + during]  # the after-effect
