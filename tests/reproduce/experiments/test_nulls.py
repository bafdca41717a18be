"""Nulls: they cost what the mechanism costs, and ask for nothing that it asks for."""

import numpy as np
import pytest

from reproduce.experiments import nulls
from reproduce.experiments.calibration import AS_PRINTED, SCENARIOS
from reproduce.experiments.calibration import load_results as load_movements
from tests.project import sample
from vmc_lib.cerebellum.offline import algorithm_1_change
from vmc_lib.cerebellum.online import WeightCorrection
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import draw_targets, exact_weights, habitual_weights, plan


@pytest.fixture(scope="module")
def habit():
    past = templates.load(hold=0.0)
    return plan(draw_targets(past, 6, np.random.default_rng(3)), past)


def test_every_rule_makes_as_many_tries(habit):
    for name, rule in nulls.offline_rules(np.random.default_rng(0)).items():
        assert len(rule(habit).error) == 1 + nulls.TRIES, name
    assert sorted(nulls.COARSE_TO_FINE) == list(range(nulls.TRIES))


def test_blind_search_sees_neither_target_nor_hand(habit):
    changes = [
        nulls.blind_change(habit, hand, rng=np.random.default_rng(1))
        for hand in (habit.target, habit.target + 1)
    ]
    np.testing.assert_array_equal(*changes)
    np.testing.assert_allclose(np.linalg.norm(changes[0], axis=-1), nulls.LENGTH)


def test_a_random_direction_is_as_long_as_equations_6_and_7(habit):
    hand = execute(habit).endpoint
    own = algorithm_1_change(habit, hand, 3, (0, 0), 1)
    other = nulls.random_direction_change(habit, hand, 3, (0, 0), 1, rng=np.random.default_rng(1))
    np.testing.assert_allclose(*(np.linalg.norm(x, axis=-1) for x in (own, other)))
    assert not np.allclose(own, other)


def test_a_random_length_keeps_the_direction_of_equations_6_and_7(habit):
    hand = execute(habit).endpoint
    own = algorithm_1_change(habit, hand, 3, (0, 0), 1)
    other = nulls.random_length_change(habit, hand, 3, (0, 0), 1, rng=np.random.default_rng(1))
    lengths = [np.linalg.norm(x, axis=-1) for x in (own, other)]
    np.testing.assert_allclose((own * other).sum(axis=-1), np.prod(lengths, axis=0))
    assert (lengths[1] < 2 * nulls.LENGTH).all()
    assert not np.allclose(*lengths)


def test_the_line_search_is_along_equation_4(habit):
    hand = execute(habit).endpoint
    change = nulls.line_search_change(habit, hand, 9)
    np.testing.assert_allclose((change[:, None] @ habit.points)[:, 0], habit.target - hand)


def test_shuffled_pairs_keep_the_corrections_and_change_their_places(habit):
    own, dealt = WeightCorrection(), nulls.ShuffledPairs(rng=np.random.default_rng(0))
    for learner in (own, dealt):
        learner.update(habit)
    [(places, right)], [(same, shuffled)] = own.training_pairs, dealt.training_pairs
    np.testing.assert_array_equal(places, same)
    np.testing.assert_allclose(np.sort(right, axis=0), np.sort(shuffled, axis=0))
    assert not np.allclose(right, shuffled)


def test_no_lesson_changes_other_weights():
    past = templates.load()
    habit = plan(draw_targets(past, 3, np.random.default_rng(0)), past)
    learner = nulls.OtherWeights(exact_weights).update(habit)
    expected = plan(habit.target, past, exact_weights).weights
    np.testing.assert_allclose(learner.correct(habit).weights, expected)


def test_other_weights_sum_to_one():
    target, points = np.array([0.02, 0.01]), np.array([[0, 0], [0.06, 0], [0.06, 0.06], [0, 0.06]])
    made = {name: rule(target, points) for name, rule in nulls.WEIGHTS.items()}
    for name, weights in made.items():
        assert weights.sum() == pytest.approx(1), name
        assert not np.allclose(weights, habitual_weights(target, points)), name
    np.testing.assert_array_equal(made["nearest only"], [1, 0, 0, 0])


def test_what_ships_is_table_v_and_its_nulls_of_the_same_movements():
    tried = nulls.load_results()[nulls.BY_TRIES]
    table_5 = load_movements()[f"{SCENARIOS[0]}, {AS_PRINTED}"]["off-line, published"]
    np.testing.assert_allclose(tried[nulls.EQ_6_7][:, -1], table_5, atol=2e-4)
    few, full = ((tried[nulls.EQ_6_7] - tried[nulls.BLIND])[:, k].mean() for k in (3, nulls.TRIES))
    assert few < -0.1, "with few tries the direction shows"
    assert full > -0.05, "with the paper's number it does not"
    nearer = tried[nulls.EQ_6_7] < tried[nulls.SAME_LENGTH]
    assert nearer[:, -1].mean() > 0.8, "but for its length"
    np.testing.assert_array_equal(tried[nulls.IN_ORDER][:, -1], tried[nulls.EQ_6_7][:, -1])
    assert tried[nulls.LINE][:, -1].mean() < 0.12


def test_a_teacher_of_many_tries_is_algorithm_1_and_one_of_small_n_teaches_better():
    lessons, teaching = (nulls.load_results()[x] for x in (nulls.BY_LESSONS, nulls.BY_TEACHING))
    same = {nulls.EQ_6_7: nulls.ALGORITHM_2, nulls.IN_ORDER: nulls.ALGORITHM_2}
    same[nulls.BLIND] = nulls.BLINDLY_TAUGHT
    three = nulls.TAUGHT.index(3)
    for kind in (nulls.IN_SAMPLE, nulls.HELD_OUT):
        for teacher, lesson in same.items():
            full = teaching[f"{teacher}, {kind}"][:, -1]
            np.testing.assert_allclose(full, lessons[f"{lesson}, {kind}"][:, 1], atol=2e-4)
        small, spread = (teaching[f"{x}, {kind}"][:, three] for x in (nulls.IN_ORDER, nulls.EQ_6_7))
        assert (small < full).mean() > 0.8, kind
        assert (small < spread).mean() > 0.8, kind


@pytest.mark.parametrize("part", sample(nulls.EXPERIMENTS, nulls.BY_WEIGHTS))
def test_one_draw_of_nulls_is_reproducible(part):
    now, shipped = nulls.EXPERIMENTS[part](0), nulls.load_results()[part]
    for name, value in now.items():
        np.testing.assert_allclose(value, shipped[name][0], atol=2e-4)
