"""The answers of the bank: one worked example for every question."""

from inspect import signature
from math import atan, e, exp, log, pi, sqrt
from types import SimpleNamespace

import numpy as np
import pytest

from tests.test_bank import TEMPLATES
from vmc_lib.arm.arm26 import forward, muscle_paths
from vmc_lib.arm.model import F0, MUSCLES

BRA = MUSCLES.index("BRA")
Z2 = 1.959964**2  # of Wilson's 95 % interval


def moment_arm(shoulder, elbow, joint, muscle, step=1e-4):
    """How fast a muscle shortens as a joint turns, m: by differences of its length."""
    q = np.radians([shoulder, elbow]) + step * np.array([[1], [-1]]) * (np.arange(2) == joint)
    longer, shorter = (muscle_paths(forward(posture))[0][muscle] for posture in q[::-1])
    return (longer - shorter) / (2 * step)


def reach(target, hand, point, cosine=1.0):
    plan = SimpleNamespace(target=np.array(target), points=np.array([point]))
    return SimpleNamespace(plan=plan, hand=np.array(hand), cosine=cosine, text="")


def around(target, *points):
    return SimpleNamespace(target=np.array(target), points=np.array(points), at="", names="")


OBLIQUE = reach((0.0, -40), (0.0, -43), (4.0, -40), 0.6)  # a triangle of 3, 4 and 5
SQUARE = around((0.5, 0.0), (1.0, 1), (-1, 1), (-1, -1), (1, -1))
CROSS = around((0.0, 0.0), (3.0, 4), (-4, 3), (-5, 0), (0, -5))  # all 5 away
EXAMPLES = {  # name: numbers, and the answer (of a choice, its index) that one works out by hand
    "pixel_column": ((500, 1.0, 0.1), 350),
    "apparent_width": ((500, 1.0, 10), 50),
    "distance_from_width": ((500, 10, 50), 1),
    "field_of_view": ((300,), 90),
    "where_the_ray_lands": ((45, 0.5), 0.5),
    "wrong_height": ((45, 10), 10),
    "one_pixel_on_the_table": ((500, 1.0, 5), 10),
    "turn_of_the_trunk": ((30, 0.4), 0.2),
    "errors_together": ((3, 4, ""), 5),
    "boxes_in_a_picture": ((2, 2), 9),
    "union_of_two": ((((0, 0, 10, 10), (5, 0, 15, 10)),), 150),
    "overlap_of_two": ((((0, 0, 10, 10), (5, 0, 15, 10)),), 1 / 3),
    "smallest_box_around": ((((0, 0, 10, 10), (20, 30, 40, 50)),), 2000),
    "recall_at": ((np.array([0.9, 0.8, 0.7, 0.95]), 0.8), 0.75),
    "average_best_overlap": ((((0, 0, 100, 100), (10, 0, 110, 100)),), 9 / 11),
    "regions_of_a_hierarchy": ((100,), 199),
    "tolerance_of_a_patch": ((100, 50, 2, 0.2), 1),
    "alike_in_colour": ((np.array([0.5, 0.5, 0]), np.array([0.2, 0.4, 0.4])), 0.6),
    "fit_together": ((100, 24), 0.99),
    "shifted_box": ((0.5,), 1 / 3),
    "shift_for_an_overlap": ((0.5, 90), 30),
    "kept_by_suppression": (([0, 50, 100, 150, 200], 0.3), 3),
    "second_box_kept": (([0, 20, 50, 150], 0.5), 1),
    "voted_edge": ((10, 0.1), 10 / (1 + e)),
    "correction_of_a_box": ((10, 1.5, ("", 0)), 0.35),
    "precision_of": ((30, 10, 5), 0.75),
    "recall_of": ((30, 10, 20), 0.6),
    "threshold_of_best_f1": ((np.arange(9, 4, -1) / 10, np.array([1, 0, 1, 1, 0])), 4),
    "how_sure_is_a_share": (((20, 20), "lower"), 20 / (20 + Z2)),
    "hidden_width": ((100, 11), 90),
    "pooled_width": ((100, 11, 4), 22),
    "numbers_to_learn": ((10, 3, 5), 763),
    "unit_in_a_block": ((np.zeros(4), 0), 0.2),
    "pooled_unit": ((np.zeros(4),), 0.8),
    "states_of_a_map": ((2, 2), 25),
    "drive_of_a_unit": ((np.float32([[1, 2], [0, 0]]), np.float32([[3, -1], [5, 5]]), 0.5), 1.5),
    "energy_of_a_pair": ((2.0, 3.0, 1, 0.5), -4.5),
    "ratio_of_probabilities": ((1, 0.5), sqrt(e)),
    "step_of_learning": ((0.5, 0.3, 0.1), 0.02),
    "width_of_a_layer": ((100, 9, "P2"), 19),
    "window_of_a_unit": ((5, 3), 7),
    "window_of_the_second_layer": ((5, 3, 2), 10),
    "weights_of_the_second_layer": ((10, 20, 4), 3200),
    "mean_map": ((np.array([0.1, 0.2, 0.6]),), 0.3),
    "what_the_mean_forgets": ((np.array([0.3, 0.7]), 0.05), 0),
    "numbers_of_a_read_out": ((10, 3, 20, 0), 90),
    "standardised": ((0.1, 0.2, 0.5), 2),
    "steps_between_windows": ((3, 2), 9),
    "chance_of_a_name": ((np.array([1.0, 0, 0]), np.array([2.0, 5, 5]), -2), 0.5),
    "score_of_a_chance": ((0.75,), log(3)),
    "feature_that_tips_it": ((2.0, -1), 0.5),
    "table_without_errors": ((20,), 20 / (20 + Z2)),
    "do_intervals_meet": (((40, 79, 80),), 0),
    "precision_with_cups": ((90, 10), 90),
    "honest_chances": ((0.6, 50), 30),
    "rate_of_rising": ((0, 0.5), 31.25),
    "rate_of_falling": ((0, 0.4), -10),
    "one_step_of_euler": ((0, 0.4, 1), 0.39),
    "silence": ((0.5, 40), 0.5 / e),
    "flicker": ((0.5,), 0.8),
    "excitation_wanted": ((0.4, 34), 0.8),
    "excitation_to_fall": ((0.4, 5), 0.2),
    "force_of_length": ((0.95,), 1),
    "force_of_velocity": ((0,), 1.6 - 1.6 / e),
    "pull_of_a_muscle": ((0, 0.5, 0.95, 0), F0[0] * (0.8 - 0.8 / e + 1.3 * atan(0.1 * 0.73**10))),
    "length_of_a_fibre": ((0, 0.8), pytest.approx(0.8, abs=1e-3)),
    "speed_of_a_fibre": ((BRA, 0.2), pytest.approx(0.2 / 2.5 / 0.0858, rel=1e-3)),
    "when_does_it_pull_hardest": ((np.array([-1, 0, 0.5]),), 2),
    "torque_of_a_muscle": (
        (20, 90, BRA, 100),
        pytest.approx(100 * moment_arm(20, 90, 1, BRA), abs=0.01),
    ),
    "what_a_muscle_does": ((0, 90, MUSCLES.index("TRIlong")), 1),
    "bag_in_the_hand": ((2, 30, 3), 196.2),
    "where_the_wrist_is": ((0, 90, ("in front of", "behind")), 26),
    "distance_of_the_wrist": ((90,), sqrt(30**2 + 26**2)),
    "elbow_for_a_distance": ((60,), 60),
    "shortening_of_a_muscle": ((3, 60), pi),
    "speed_of_the_hand": ((3, 30, 2), 20),
    "motion_that_follows": ((0, 90, "elbow", np.array([1.0, 0])), "by Cramer's rule, below"),
    "two_templates": ((0.25,), 0.75),
    "weight_by_nearness": ((np.array([1.0, 2, 3, 6]), 1), 0.5),
    "weight_with_a_power": ((np.array([1.0, 2, 2]), 2), 2 / 3),
    "miss_of_equation_four": ((CROSS,), 10 * sqrt(6**2 + 2**2) / 4),
    "least_change_of_four": ((5, 10), 0.1),
    "origin_of_the_plane": ((np.array([0.5, 0.3, 0.3, 0.2]), 10), 3),
    "mixture_beyond_the_limits": ((0.5, 0.8, 0.2, 1), 1),
    "nearest_in_its_quadrant": ((SQUARE, np.arange(8)[::-1], 0), 7),
    "share_of_the_way": ((0.25,), 106 / 1024),
    "cosine_of_a_template": ((OBLIQUE,), 0.6),
    "gain_of_a_template": ((reach((0.0, -40), (0.0, -43), (0.0, -32)), 4), 6 / 43),
    "change_of_a_weight": ((OBLIQUE, 0), 1.8 / 43),
    "is_it_used_more": ((OBLIQUE, 0), 0),
    "reaches_that_are_tried": ((10, 20), 220),
    "best_of_the_trials": ((np.array([3.0, 2, 1, 4, 5]),), 2),
    "belief_that_is_too_wide": ((4,), 0.25),
    "capped_step": ((np.array([0.8, 0, 0.6, 0]),), 0.4),
    "surprise_that_is_learned": ((0.5, 10, 15), 10),
    "vote_of_neurons": ((4, 30), 2),
    "numbers_that_g_is_told": ((3, ("", 2)), 11),
    "numbers_that_g_learns": ((3,), 36),
    "corrected_weight": ((0.3, 0.1, -0.05), 0.35),
    "lesson_of_a_miss": ((20, 5), 20.5),
    "granule_cell": ((4, 4), exp(-0.5)),
    "purkinje_sum": ((2.0, [6, 8], np.array([3.0, 2])), 3 + 2 * exp(-0.5)),
    "ridge_of_one_cell": ((4, 0.5, 0.5, 2), 4),
    "lesson_with_caution": ((1.0, 10), 5),
    "behind_a_prism": ((60, 50), 50),
    "after_effect": ((40, 0.5, "left"), 1),
    "moved_unseen": ((1, 100), 10),
    "wanted_acceleration": ((10, 0.2, 0.1, 0.5), 2),
    "force_of_a_curl_field": ((10, 0.5, 0, "y"), -5),
    "fastest_moment": ((40, 0.5), 150),
    "samples_of_a_delay": ((100, 20), 5),
    "period_of_a_tremor": ((125, 4), 2),
    "two_memories": ((0.5, 0.98, 0.2, 0.02, 2), 0.22),
    "which_memory_holds_more": ((0.5, 0.98, 0.2, 0.02, 2), 0),
    "forgetting": ((0.8, 2), 0.64),
    "chain_of_links": ((0.9, 2), 0.81),
    "how_good_each_link": ((0.81, 2), 0.9),
    "unequal_links": ((np.array([0.9, 0.9, 1, 1]),), 0.81),
    "link_to_mend": ((np.array([0.9, 0.8, 0.95, 0.99]),), 1),
    "first_broken_link": ((100, np.array([10, 10, 10, 14])), 0.8),
    "arrivals_with_a_lesion": ((100, 0.5, 0.8), 40),
    "interval_of_arrivals": (((80, 80),), Z2 / (80 + Z2)),
    "median_miss": ((np.array([100.0, 4, 3, 2, 1]),), 3),
    "within_a_centimetre": ((np.repeat([5.0, 20], 4), 2), 0.4),
    "reaches_to_count": ((0.1, 0.5), 97),
    "share_that_is_left": ((8, 2), 0.25),
    "interval_of_six_seeds": ((np.arange(1, 7),), 2.571 * sqrt(3.5 / 6)),
    "changes_together": ((0.5, 0.4), 0.2),
    "templates_in_a_plane": ((24, 6, ("", 2)), 25),
    "twice_as_dense": ((20, 2, ("", 3)), 160),
    "trials_that_are_needed": ((0.1, 5, 0.1), 2),
    "noise_of_a_pull": ((0.1, 600, 0.5), 30 * exp(0.05**2 - 40 * 0.05**4) * (1.6 - 1.6 / e)),
    "luck_of_the_best": ((2, 0.1), 0.19),
    "gain_of_one_report": ((1, 2), 0.2),
    "error_of_two_senses": ((3, 4), 2.4),
    "gain_of_the_last_step": ((1, 2, 2), 1 / 3),
    "seconds_that_grow": ((2, 4, ("", 2)), 32),
    "power_of_growth": ((4, 0.5, 1.0), 0.5),
    "freedom_to_spare": ((4, ("", 3)), 4),
    "muscles_that_are_needed": ((7,), 8),
    "shared_torque": ((5, 10, 20), 0.1),
    "none_below_zero": ((5, 10, 5), 0.5),
    "mixture_of_two_holds": ((2, 4, 0.25), 3.5),
    "memories_in_space": ((2, 3, 4), 24),
    "fall_from_a_posture": ((0.2, 0.4, 2), e),
    "nearness_in_space": ((np.array([1, 2, 2]),), 0.5),
    "weight_by_equation_4": ((3,), 0.3),
    "slow_to_fall": ((0.2, 0.5), 0),
    "step_that_loses_most": ((np.array([200, 150, 75, 70, 69]),), 1),
    "left_to_the_eye": ((np.array([[30, 0], [33, 4], [0, 0]]),), 5),
    "boxes_for_a_recall": ((np.array([[0.1, 0.6, 0.9], [0, 0.2, 0.7]]), 0.5, 1), 4),
    "best_of_three_boxes": ((np.array([100, 100]), np.array([2, 0, 1])), 1),
    "hits_lost": ((np.array([[-0.05, 1], [0.05, 1], [0.15, 0], [0.25, 1]]), 0, 0.2), 1),
    "best_f1_of_four": ((np.array([[0.9, 0.1], [0.5, 0.6], [0.3, 1], [0.7, 0.3]]),), 1),
    "hidden_chance": ((np.zeros(4),), 0.2),
    "drive_from_chances": ((np.ones(4), 0), pytest.approx(1, abs=0.07)),  # from two decimals
    "runs_to_compare": ((np.array([3, 2, 1, 0]), np.arange(4), 0), "B and D"),
    "window_of_three": ((7, 5, 2, np.array([1, 0, 2])), 1),
    "next_width": ((100, 11), 17),
    "read_a_table": ((np.array([[30, 10], [20, 40]]), "precision"), 0.6),
    "honest_or_not": ((-0.5, np.zeros(5)), 0),
    "held_out_of_two": ((0, 1), 0),
    "pull_at_the_mark": ((0.95, 0.5, 600), 300),
    "time_constant_of_a_fall": ((40,), 40),
    "which_smooths_more": ((np.array([60, 30]), 10), 0),
    "torque_at_the_mark": (
        (BRA, 90, 200),
        pytest.approx(200 * moment_arm(0, 90, 1, BRA), abs=0.01),
    ),
    "angles_of_a_posture": ((30, 60), "30 and 60"),
    "which_one_bends": ((("BRA", "TRIlat"), 1), 1),
    "where_it_is_mixed_to": (((SQUARE, np.full(4, 0.25)), np.array([2, 0, 1])), 1),
    "miss_to_report": ((np.array([[7, 6, 8], [5, 9, 4]]),), 9),
    "best_made_again": ((np.arange(21), "without any noise"), "the same"),
    "which_is_shown_to_help": ((np.array([[1, 2], [-3, 1], [3, 2]]),), 2),
    "gain_by_the_direction": ((np.array([20, 10, 5]),), 1 / 3),
    "which_was_practised": ((4, 6, 1, 1), 0),
    "which_teaches_too_far": ((np.array([3, 5]), 8), 1),
    "against_local_fields": ((4, np.array([2, 0, 1])), 1),
    "learnt_behind_a_prism": ((50, 0.6), 0.6),
    "which_memory_is_fast": ((0.5, 0.98, 0.2, 0.02, 1), 1),
    "delay_of_sight": ((20, 200), 200),
    "what_slowed_it": ((80, 60, 120), 1),
    "which_needs_two_memories": ((60, 5, np.array([1, 0, 2])), 1),
    "lesion_not_told_apart": ((np.array([80, 40, 78, 30]),), 1),
    "which_link_was_cut": ((np.array([[0.9, 0.9, 0.9, 0.9], [0.9, 0.9, 0.5, 0.9]]),), 2),
    "median_of_dots": ((np.arange(1, 10),), 5),
    "both_if_independent": ((0.5, 0.4), 20),
    "what_an_ablation_says": (((np.array([100, 50, 40, 20]), 0),), 0),
    "power_on_two_logarithms": ((2, 0.1), 2),
    "which_holds_by_itself": ((np.array([1, -1]),), 1),
    "against_noise_of_the_command": ((0.1, np.array([1, 2, 0])), 2),
    "best_estimate": ((6, 6, 40), 20),
}


def test_every_question_has_a_worked_example():
    assert EXAMPLES.keys() == TEMPLATES.keys()


@pytest.mark.parametrize("name", EXAMPLES)
def test_an_answer_is_that_of_its_worked_example(name):
    numbers, expected = EXAMPLES[name]
    answer = TEMPLATES[name].formula(*numbers)
    answer, words = answer if isinstance(answer, tuple) else (answer, {})
    if name == "motion_that_follows":
        (a, b), (c, d) = words["inertia"]
        expected = -c / (a * d - b * c)
    if isinstance(expected, str):
        template = TEMPLATES[name]
        names = dict(zip(signature(template.formula).parameters, numbers, strict=True))
        answer = template.choices[answer].format_map(names | words)
        assert answer == expected
        return
    approximate = expected if hasattr(expected, "rel") else pytest.approx(expected, rel=1e-3)
    assert answer == approximate
