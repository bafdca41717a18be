"""An entry of the ledger: a number against its interval, and the verdict of a row."""

import numpy as np
import pytest

from reproduce.ledger import entry
from reproduce.ledger.entry import (
    BEATEN,
    BY_CONSTRUCTION,
    DIFFERS,
    FITTED,
    NOT_COMPARED,
    NULL_PASSES,
    REPRODUCED,
    Quantity,
)


@pytest.mark.parametrize(
    ("claimed", "obtained", "better", "verdict"),
    [
        (0.9, 0.95, 0, REPRODUCED),
        (0.9, 1.05, 0, DIFFERS),
        (0.9, 0.95, 1, REPRODUCED),
        (0.9, 1.05, 1, BEATEN),
        (0.9, 0.50, 1, DIFFERS),
        (0.9, 0.50, -1, BEATEN),
        (0.9, 1.05, -1, DIFFERS),
    ],
)
def test_a_number_is_held_against_its_interval(claimed, obtained, better, verdict):
    ends = {"low": obtained - 0.1, "high": obtained + 0.1}
    assert Quantity("q", claimed, obtained, **ends, better=better).verdict == verdict


@pytest.mark.parametrize(
    ("claimed", "fitted", "verdict"),
    [
        (0.55, False, REPRODUCED),  # in the interval of the mean
        (0.6, False, REPRODUCED),  # one more draw may give it
        (0.75, False, BEATEN),
        (0.25, False, DIFFERS),
        (0.55, True, FITTED),
        (0.75, True, FITTED),  # what was fitted to a number does not beat it
        (0.25, True, DIFFERS),
        (None, False, NOT_COMPARED),
    ],
)
def test_beaten_is_what_no_single_draw_gives(claimed, fitted, verdict):
    draws = 0.5 * np.exp(0.12 * np.array([-1, -1, 0, 0, 1, 1]))
    q = entry.mean_of_draws("q", claimed, draws, better=-1, fitted=fitted)
    half = 2.5706 * np.log(draws).std(ddof=1) * (1 + 1 / 6) ** 0.5
    assert (q.least, q.most) == pytest.approx((0.5 * np.exp(-half), 0.5 * np.exp(half)), rel=1e-4)
    assert (q.verdict, q.sample) == (verdict, "6 draws")


def test_one_odd_draw_widens_the_interval_of_a_ratio_upwards_and_never_below_0():
    draws = [0.016, 0.011, 0.011, 0.005, 0.157, 0.007]
    q, plain = entry.mean_of_draws("q", None, draws), entry.mean("q", None, draws)
    assert plain.low < 0 < q.least < q.low < q.obtained == plain.obtained < plain.high < q.high
    with pytest.raises(ValueError, match="a ratio of 0 has no logarithm"):
        entry.mean_of_draws("q", 1, [0.2, 0, 0.1])


def test_where_the_papers_number_is_a_mean_too_its_own_luck_counts():
    values = np.arange(40) % 4
    alone, both = (entry.mean("q", 1.98, values, "photos", of=of) for of in (None, 40))
    assert (alone.least, both.sample) == (None, "40 photos")
    assert both.most - both.obtained == pytest.approx(2**0.5 * (both.high - both.obtained))


def test_no_interval_of_a_share_leaves_its_limits():
    q = entry.mean_of_trainings("q", 1, [1, 0.9, 1], 10, 10)
    assert (q.high, q.most) == (1, 1)


def test_a_share_is_beaten_only_where_a_count_of_the_papers_size_tells():
    many, few = (entry.share("q", 75 / 79, 397, 400, of, better=1) for of in (79, 9))
    assert (many.verdict, few.verdict) == (BEATEN, REPRODUCED)


def test_a_share_differs_only_where_a_count_of_the_papers_size_tells():
    """The paper saw five of five, or 79 of 79; one exception in many does not refute that."""
    assert entry.share("q", 1, 149, 150, better=1).verdict == DIFFERS, "of all that there are"
    assert entry.share("q", 1, 494, 500, 5, better=1).verdict == REPRODUCED
    assert entry.share("q", 1, 397, 400, 79, better=1).verdict == REPRODUCED
    assert entry.share("q", 1, 60, 100, 79, better=1).verdict == DIFFERS


def test_what_belongs_together_counts_for_less():
    alone, clustered = (entry.share("q", 1, 90, 100, 50, effect=e) for e in (1, 2))
    assert (clustered.low, clustered.high) == entry.wilson(45, 50)
    assert alone.obtained == clustered.obtained
    assert clustered.least < alone.least < alone.low
    trained = entry.mean_of_trainings("q", 1, [0.9, 0.9], 100, 50, effect=2)
    assert (trained.low, trained.least) == (clustered.low, clustered.least)


def test_the_wider_of_two_intervals():
    q = entry.wider_of(entry.mean("q", 0, [1, 2, 3]), (1.9, 5))
    assert q.low < 1.9 < q.high == 5


def test_rounding_widens_the_interval():
    assert Quantity("q", 0.595, 0.5954).verdict == DIFFERS
    assert Quantity("q", 0.595, 0.5954, rounding=0.0005).verdict == REPRODUCED


@pytest.mark.parametrize(
    ("obtained", "better", "p", "verdict"),
    [
        (0.8, -1, None, REPRODUCED),
        (0.95, -1, None, DIFFERS),  # the limit lies in the interval
        (0.8, 1, None, DIFFERS),
        (1.2, 1, None, REPRODUCED),
        (1.2, 1, 0.2, DIFFERS),
        (1.2, 1, 0.01, REPRODUCED),
    ],
)
def test_all_of_an_interval_is_beyond_a_limit(obtained, better, p, verdict):
    ends = {"low": obtained - 0.1, "high": obtained + 0.1, "p": p}
    assert Quantity("q", 1, obtained, **ends, better=better, bound=True).verdict == verdict


@pytest.mark.parametrize(
    ("claimed", "limit", "null", "verdict"),
    [
        (0.55, False, 0.6, NULL_PASSES),  # near enough to what is claimed
        (0.55, False, 0.62, REPRODUCED),  # that too, but clearly worse than ours
        (0.55, False, 0.3, NULL_PASSES),  # better than what is claimed
        (0.55, False, 0.8, REPRODUCED),
        (0.75, False, 0.9, BEATEN),
        (0.75, False, 0.58, NULL_PASSES),  # what beats the paper does so by luck
        (0.75, False, 0.7, BEATEN),  # luck beats it too, but not as ours does
        (0.25, False, 0.2, DIFFERS),  # what does not hold needs no null
        (1, True, 0.58, NULL_PASSES),
        (1, True, 0.8, REPRODUCED),
        (0.65, True, 0.58, REPRODUCED),  # as uncertain as ours, it might be above the limit
        (None, False, 0.5, NOT_COMPARED),
    ],
)
def test_a_null_passes_where_it_would_hold_in_the_place_of_ours(claimed, limit, null, verdict):
    ends = {"low": 0.4, "high": 0.6, "better": -1, "bound": limit}
    q = Quantity("q", claimed, 0.5, **ends, nulls={"luck": null, "none": 9.0})
    assert q.verdict == verdict
    assert q.passing_nulls() == ["luck"] or verdict != NULL_PASSES


def test_five_of_five_are_seen_where_a_null_is_right_less_often_too():
    nulls = {"nine of ten": 0.9, "half": 0.5}
    q = entry.share("q", 1, 143, 150, of=5, better=1, nulls=nulls)
    assert (q.least, q.most) == (0.8, 1)
    assert q.passing_nulls() == ["nine of ten"]


def test_what_was_fitted_is_no_better_than_its_null():
    q = Quantity("q", 0.5, 0.5, fitted=True, nulls={"other weights": np.float64(0.5)})
    assert q.verdict == NULL_PASSES
    row = entry.Row("where", "claim", "chapter", lambda: [q, Quantity("r", 1, 2, better=1)])
    measured = entry.measure(row)
    assert measured["verdict"] == NULL_PASSES, "though it is beaten elsewhere"
    assert type(measured["quantities"][0]["nulls"]["other weights"]) is float


def test_what_was_fitted_to_come_near_passes_no_null_that_is_merely_less():
    """As of Table IV, whose spacing is fitted: neither side of the claim is better."""
    ends, luck = {"low": 0.4, "high": 0.6}, {"near": 0.58, "far less": 0.2, "far more": 0.8}
    q = Quantity("q", 0.5, 0.5, **ends, fitted=True, nulls=luck)
    assert q.passing_nulls() == ["near"]


def test_verdict_of_a_row():
    trivial, good = entry.trivial_quantity("q", 1, 1), Quantity("q", 1, 1)
    better, worse = Quantity("q", 1, 2, better=1), Quantity("q", 1, 0)
    fitted, untold = Quantity("q", 1, 1, fitted=True), Quantity("q", None, 1)
    assert entry.verdict([]) == entry.verdict([untold]) == NOT_COMPARED
    assert entry.verdict([trivial, untold]) == BY_CONSTRUCTION
    assert entry.verdict([trivial, fitted]) == FITTED
    assert entry.verdict([trivial, fitted, good]) == REPRODUCED
    assert entry.verdict([trivial, good, better]) == BEATEN
    assert entry.verdict([trivial, better, worse]) == DIFFERS
    assert entry.verdict([entry.trivial_quantity("q", 1, 2), good]) == DIFFERS, "a bug"


def test_the_wider_interval_of_trainings_over_photos_counts():
    alike, unlike = (
        entry.mean_of_trainings("q", 0.5, shares, n)
        for shares, n in (([0.5, 0.5, 0.5], 40), ([0.1, 0.5, 0.9], 10**6))
    )
    assert (alike.low, alike.high) == entry.wilson(20, 40)
    middle, half = entry.t_interval([0.1, 0.5, 0.9])
    assert (unlike.low, unlike.high) == (max(middle - half, 0), min(middle + half, 1))
    assert middle - half < 0
