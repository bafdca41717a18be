"""Eq. 3–5: weights, neighbours and what happens at their edges."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from vmc_lib import NoReach
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute, rotate_about_eye
from vmc_lib.motor.planning import (
    draw_targets,
    exact_weights,
    habitual_weights,
    is_surrounded,
    least_change,
    nearest,
    plan,
    surrounding,
)
from vmc_lib.motor.templates import TemplateSet

SQUARE = np.array([(0.1, -0.3), (0.0, -0.3), (0.0, -0.4), (0.1, -0.4)])
INSIDE = st.tuples(st.floats(0, 0.1), st.floats(-0.4, -0.3)).map(np.array)


@given(INSIDE)
def test_habitual_weights_are_equation_5(target):
    weights = habitual_weights(target.tolist(), SQUARE)
    distance = np.linalg.norm(SQUARE - target, axis=1)
    if distance.min() > 1e-6:
        np.testing.assert_allclose(weights, (1 / distance) / (1 / distance).sum(), rtol=1e-9)
    assert np.all(weights >= 0)
    np.testing.assert_allclose(weights.sum(), 1)


@given(INSIDE)
def test_exact_weights_satisfy_equation_4(target):
    weights = exact_weights(target, SQUARE)
    np.testing.assert_allclose(weights @ SQUARE, target, atol=1e-12)
    np.testing.assert_allclose(weights.sum(), 1)


@pytest.mark.parametrize("rule", [habitual_weights, exact_weights])
def test_target_on_a_template_uses_that_template_alone(rule, template_set):
    points = template_set.points[is_surrounded(template_set.points, template_set.points)]
    reaches = plan(points, template_set, rule)
    np.testing.assert_allclose(reaches.weights.max(axis=-1), 1, atol=1e-12)
    np.testing.assert_allclose(execute(reaches).endpoint, points, atol=1e-9)


def test_surrounding_templates_are_the_corners_of_the_cell(template_set):
    targets = draw_targets(template_set, 100, np.random.default_rng(0))
    corners = template_set.points[surrounding(targets.tolist(), template_set.points)]
    side = np.sign(corners - targets[:, None])
    assert np.all(side == [(1, 1), (-1, 1), (-1, -1), (1, -1)])
    nearer = np.linalg.norm(template_set.points - targets[:, None], axis=-1).min(axis=-1)
    assert np.all(np.linalg.norm(corners - targets[:, None], axis=-1).min(axis=-1) == nearer)


def test_the_nearest_point_in_each_octant_surrounds_a_place_in_space():
    corners = np.stack(np.meshgrid(*[[-1.0, 1.0]] * 3), axis=-1).reshape(-1, 3)
    rows = surrounding(np.zeros((2, 3)), np.vstack([2 * corners, corners]))
    assert np.sort(rows).tolist() == 2 * [list(range(8, 16))]
    with pytest.raises(NoReach, match="not surrounded"):
        surrounding(np.array([3.0, 0, 0]), corners)


def test_plan_excitations_are_a_clipped_weighted_sum(template_set):
    reach = plan([0.15, -0.4], template_set)
    expected = sum(
        w * template_set.excitations[i] for w, i in zip(reach.weights, reach.rows, strict=True)
    )
    np.testing.assert_allclose(reach.excitations, expected, atol=1e-12)
    wild = reach.with_weights(reach.weights * [9, -9, 9, -9])
    assert wild.excitations.min() >= 0
    assert wild.excitations.max() <= 1


def test_a_template_chosen_twice_has_both_weights(template_set):
    twice = plan([0.15, -0.4], template_set, rows=[5, 6, 7, 5])
    expected = twice.weights @ template_set.excitations[[5, 6, 7, 5]].reshape(4, -1)
    np.testing.assert_allclose(twice.excitations.ravel(), expected.clip(0, 1), atol=1e-12)


def test_executing_a_large_batch_in_parts_changes_nothing(template_set):
    targets = draw_targets(template_set, 30, np.random.default_rng(1))
    batch = plan(targets, template_set)
    many = execute(batch.with_weights(np.broadcast_to(batch.weights, (20, 30, 4)))).endpoint
    np.testing.assert_allclose(many[-1], execute(batch).motion.endpoint, atol=1e-12)


def test_draw_targets_refuses_templates_that_cover_too_little(template_set):
    leaning = np.array([[0, 0], [0.1, 0.05], [0.05, 0.1], [0.15, 0.15]])
    few = TemplateSet(leaning, template_set.excitations[:4])
    with pytest.raises(ValueError, match="too few for 50 targets; take templates that cover"):
        draw_targets(few, 50, np.random.default_rng(0))


def test_habitual_error_is_a_few_percent_of_the_reach(template_set):
    targets = draw_targets(template_set, 200, np.random.default_rng(2))
    reach = plan(targets, template_set)
    error = np.linalg.norm(execute(reach).endpoint - targets, axis=1)
    assert execute(reach).bias == pytest.approx(error, abs=1e-12)
    assert np.all(execute(reach).error >= error - 1e-12)
    assert 0.01 < np.mean(error / np.linalg.norm(targets, axis=1)) < 0.05


@settings(max_examples=30)
@given(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5))
def test_least_change_shifts_and_sums_to_zero(x, y):
    change = least_change(SQUARE.T, np.array([x, y]))
    np.testing.assert_allclose(change @ SQUARE, [x, y], atol=1e-12)
    assert abs(change.sum()) < 1e-12


def test_templates_on_a_line_are_refused():
    line = np.array([(0.0, -0.4), (0.1, -0.4), (0.2, -0.4), (0.3, -0.4)])
    with pytest.raises(ValueError, match="one line"):
        exact_weights(np.array([0.15, -0.4]), line)
    with pytest.raises(ValueError, match="one plane"):
        exact_weights(np.array([0.1, -0.4, 0.1]), np.column_stack([SQUARE, np.zeros(4)]))
    with pytest.raises(ValueError, match="around the target"):
        exact_weights(np.array([0.1, -0.4]), line[:1])


@pytest.mark.parametrize("count", [3, 4, 6, 9])
def test_plans_with_other_numbers_of_templates(count, template_set):
    targets = draw_targets(template_set, 50, np.random.default_rng(3))
    chosen = nearest(targets, template_set.points, count)
    distance = np.linalg.norm(template_set.points - targets[:, None], axis=-1)
    distances = np.take_along_axis(distance, chosen, axis=-1)
    np.testing.assert_allclose(distances, np.sort(distance, axis=-1)[:, :count])
    mixed = plan(targets, template_set, rows=chosen)
    np.testing.assert_allclose(mixed.weights.sum(axis=-1), 1)
    with pytest.raises(ValueError, match="cannot choose"):
        nearest(targets, template_set.points, 1 + len(template_set.points))


@pytest.mark.parametrize("rows", [[0, 1, 2, 500], [-1, 0, 1, 2], [], [0.5, 1]])
def test_rows_that_are_no_templates_are_refused(rows, template_set):
    with pytest.raises(ValueError, match=r"rows .* must be of the \d+ templates, 0 to"):
        plan([0.15, -0.4], template_set, rows=rows)


def test_a_movement_is_simulated_once(template_set, monkeypatch):
    movement = execute(plan([0.15, -0.4], template_set))
    first = movement.endpoint
    monkeypatch.setattr(templates, "simulate", lambda *_, **__: pytest.fail("simulated again"))
    np.testing.assert_array_equal(movement.motion.endpoint, first)
    np.testing.assert_array_equal(movement.endpoint, first)


def test_prism_changes_the_seen_endpoint_alone(template_set):
    straight, behind_glass = (execute(plan([0.15, -0.4], template_set), prism=p) for p in (0, 0.1))
    np.testing.assert_array_equal(behind_glass.motion.endpoint, straight.motion.endpoint)
    endpoint = behind_glass.endpoint
    np.testing.assert_allclose(rotate_about_eye(endpoint, -0.1), straight.endpoint)
    assert endpoint[1] > straight.endpoint[1]  # upwards


@pytest.mark.parametrize("rule", [habitual_weights, exact_weights])
def test_ten_thousand_random_targets_are_planned_or_refused(rule, template_set):
    targets = np.random.default_rng(4).uniform([-0.1, -0.6], [0.4, -0.2], (10_000, 2))
    inside = is_surrounded(targets, template_set.points)
    assert 1000 < inside.sum() < 9000
    reaches = plan(targets[inside], template_set, rule)
    assert np.abs(reaches.weights).max() < 1.5
    np.testing.assert_allclose(reaches.weights.sum(axis=-1), 1)
    for target in targets[~inside][:50]:
        with pytest.raises(ValueError, match="not surrounded"):
            plan(target, template_set, rule)


@pytest.mark.parametrize(
    ("target", "complaint"),
    [
        ((0.5, -0.4), "not surrounded"),
        ((0.15, -0.2), "not surrounded"),
        ((np.nan, -0.4), "finite"),
        ((0.15, -0.4, 0.05), "finite positions"),
    ],
)
def test_wrong_targets_are_refused(target, complaint, template_set):
    with pytest.raises(ValueError, match=complaint):
        plan(target, template_set)


def test_a_rule_goes_by_its_name_too(template_set):
    for name, rule in (("habitual", habitual_weights), ("exact", exact_weights)):
        named, given = (plan((0.15, -0.4), template_set, one) for one in (name, rule))
        np.testing.assert_array_equal(named.weights, given.weights)
