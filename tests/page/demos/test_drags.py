"""What the page works out for any place of the reader's hand is what Python works out."""

import re
from functools import cache

import numpy as np
import pytest

from book.figures import aiming, reaching, votes, where
from tests.page.demos.markup import move, numbers, on, polylines, words
from tests.pages import SECOND_FINGER, drag, middle, middles
from vmc_lib import photos
from vmc_lib.arm.dynamics import hand
from vmc_lib.arm.kinematics import inverse_kinematics, to_world
from vmc_lib.arm.model import MUSCLES
from vmc_lib.boxes import iou
from vmc_lib.motor import templates
from vmc_lib.motor.execution import execute
from vmc_lib.motor.planning import plan
from vmc_lib.show import Pad, Slider, Switch, explore
from vmc_lib.show.markup import data_uri

pytestmark = pytest.mark.browser
CUP = np.array([120.0, 90.0, 200.0, 180.0])
XS, YS, WIDE, HIGH = (
    np.arange(120, 201, 4),
    np.arange(91, 180, 4),
    np.arange(40, 121, 4),
    np.arange(40, 121, 4),
)
PAST, MUSCLE = templates.load(spacing=0.06), MUSCLES.index("BIClong")
ACROSS, UP = np.arange(0.015, 0.17, 0.015), np.arange(-0.475, -0.33, 0.015)
SPOTS = [(x, y) for x in ACROSS.tolist() for y in UP.tolist()]
SHOT = photos.load("free", "test")[0]
ACROSS_SHOT, DOWN_SHOT = np.arange(0, 601, 10), np.arange(0, 401, 10)
AROUND, NEURONS = np.linspace(-0.95, 0.95, 20), range(3, 61)

VALUES = "(forms) => forms.map((form) => [...form].map(({ value }) => value))"


@cache
def ends():
    """Where the hand ends, of a reach to each spot."""
    return execute(plan(SPOTS, PAST)).endpoint


def declare():
    image = photos.load("rig", "validation")[0].image
    explore(
        lambda middle, size: where.overlap(image, CUP, middle, size),
        "c",
        lambda middle, size: f"{middle} {size}",
        in_page=where.overlap_in_page(image, CUP),
        middle=Pad(XS, YS, start=(160, 135)),
        size=Pad(WIDE, HIGH, start=(80, 80)),
    )
    explore(
        lambda place: reaching.plan_figures(PAST, MUSCLE, execute(plan(place, PAST))),
        "c",
        lambda place: f"{place}",
        in_page=reaching.plan_in_page(PAST, MUSCLE, ends()),
        place=Pad(ACROSS, UP),
    )
    explore(
        votes.votes_plot,
        "c",
        lambda target, neurons, evenly: f"{target}, {neurons}, {evenly}",
        in_page=votes.votes_in_page(),
        target=Pad(AROUND, AROUND),
        neurons=Slider(NEURONS, "neurons", 4),
        evenly=Switch((False, True), "evenly spread"),
    )
    explore(
        lambda target: aiming.aim_view(SHOT, target),
        "c",
        lambda target: aiming.describe_aim(SHOT, target),
        in_page=aiming.aim_in_page(SHOT),
        target=Pad(ACROSS_SHOT, DOWN_SHOT, start=(300, 200)),
    )


@pytest.mark.parametrize("place", np.random.default_rng(1).integers(0, 20, (20, 4)).tolist())
def test_the_overlap_of_two_boxes_is_drawn_as_in_python(page, place):
    x, y, wide, high = place
    middle, size = (XS[x], YS[y]), (WIDE[wide], HIGH[high])
    [seen], said = move(page, 0, *place)
    drawn = where.overlap(photos.load("rig", "validation")[0].image, CUP, middle, size)
    assert numbers(seen, "rect") == numbers(drawn, "rect")
    assert words(seen) == [text for text in words(drawn) if text]
    colours = re.compile(r'<rect[^>]*stroke="(#\w+)"')
    assert colours.findall(seen) == colours.findall(drawn)
    assert said == where.describe_overlap(CUP, middle, size)


def test_a_box_is_moved_by_its_middle_and_stretched_by_its_corner(page):
    box = page.locator(".vmc-demo").nth(0)
    move(page, 0, 10, 11, 10, 10)
    box.scroll_into_view_if_needed()
    twins, handles = box.locator("input").all(), box.locator(".vmc-handle")
    for number, moved in enumerate(([True, True, False, False], [False, False, True, True])):
        before, places = [twin.input_value() for twin in twins], middles(handles)
        drag(page, places[number], 20, 15)
        now = [twin.input_value() for twin in twins]
        assert [a != b for a, b in zip(before, now, strict=True)] == moved
        far = np.subtract(middles(handles), places)
        assert np.abs(far[-1] - [20, 15]).max() < 4  # the corner comes along, to the grid


def test_the_right_button_drags_nothing(page):
    box = page.locator(".vmc-demo").nth(0)
    box.scroll_into_view_if_needed()
    before = box.locator("form").evaluate_all(VALUES)
    drag(page, middles(box.locator(".vmc-handle"))[0], 20, 15, "right")
    assert box.locator("form").evaluate_all(VALUES) == before


def test_a_second_finger_drags_nothing(page):
    box = page.locator(".vmc-demo").nth(0)
    box.scroll_into_view_if_needed()
    before = box.locator("form").evaluate_all(VALUES)
    page.mouse.move(*middles(box.locator(".vmc-handle"))[0])
    page.mouse.down()
    box.locator(".vmc-pictures").evaluate(SECOND_FINGER)
    page.mouse.up()
    assert box.locator("form").evaluate_all(VALUES) == before


def test_overlap_of_any_two_boxes(page):
    rng = np.random.default_rng(4)
    corners = rng.integers(0, 12, (2, 60, 2, 2))
    a, b = np.concatenate([corners.min(2), corners.max(2) + 1], axis=-1).tolist()
    seen = page.evaluate("([a, b]) => a.map((box, i) => vmc['eye/boxes'].iou(box, b[i]))", [a, b])
    assert np.allclose(seen, np.diag(iou(a, b)), atol=1e-12)
    assert 0 in seen


@pytest.mark.parametrize("place", [(0, 0), (10, 9), (5, 4), (7, 2), (3, 3), (2, 8)])
def test_a_plan_is_drawn_as_python_plans_it(page, place):
    spot = place[0] * len(UP) + place[1]
    one = plan(SPOTS[spot], PAST)
    (in_plane, over_time), said = move(page, 1, *place)
    miss = f"{1000 * np.linalg.norm(ends()[spot] - one.target):.1f} mm"
    labels = words(in_plane)[-5:]
    assert labels == [*(f"{w:.2f}" for w in one.weights), f"the hand misses by {miss}"]
    assert f"the hand ends {miss} away" in said

    marks = [mark[:2] for mark in numbers(in_plane, "circle")]
    expected = on(in_plane, [*one.points, one.target, ends()[spot]])
    assert np.abs(np.array(marks) - expected).max() < 0.1
    curves = np.array(polylines(over_time))
    parts = one.weights[:, None] * PAST.excitations[one.rows, ::20, MUSCLE]
    time = np.arange(parts.shape[1]) * 0.02
    wanted = [on(over_time, np.stack([time, part], -1)) for part in [*parts, parts.sum(0)]]
    assert np.abs(curves - wanted).max() < 0.2


@pytest.mark.parametrize("place", [(0, 0, 1, 0), (19, 3, 9, 0), (15, 15, 1, 1), (9, 10, 57, 1)])
def test_neurons_vote_as_in_python(page, place):
    x, y, many, evenly = place
    target, neurons = AROUND[[x, y]], NEURONS[many]
    [seen], said = move(page, 2, *place)
    off = f"{votes.lean(target, neurons, evenly):.0f}° off"
    assert words(seen)[-3:] == ["the reach", "the sum", off]
    assert said.endswith(f"their sum is {off}.")
    arrows = polylines(seen)
    tips = np.array([line[1] for line in arrows])
    cast = votes.votes(target, votes.preferred_directions(neurons, evenly))
    wanted = [*cast, target, votes.population_vector(target, neurons, evenly)]
    assert np.abs(tips - on(seen, wanted)).max() < 0.1
    for line in arrows:
        if np.linalg.norm(line[1] - line[0]) > 12:  # pixels; a shorter one is rounded
            assert half_angles(line) == pytest.approx([0.45, -0.45], abs=0.1)


WORDS = """([name, given, values]) => {
  const plot = { mark: () => "", head: [0, 0] };
  return vmc[`demos/${name}`][name](given, values, [plot, plot])[0];
}"""


def test_nothing_has_a_minus(page):
    """What rounds to zero is 0, in the page and in Python."""
    target = np.array([-0.001, 0.5])
    said = page.evaluate(WORDS, ["votes", {}, [*target.tolist(), 4, False]])
    assert said == votes.votes_in_words(target, 4, False)
    assert "to 0.00, 0.50;" in said
    ahead = hand(inverse_kinematics([0.2, SHOT.target[1]]))
    spot = to_world(ahead, np.radians(-0.2))
    pixel = SHOT.camera.project(spot[None])[0]
    said = page.evaluate(WORDS, ["aim", aiming.aim_in_page(SHOT)[2], pixel.tolist()])
    assert said == f"{aiming.describe_aim(SHOT, pixel)}."
    assert "turns 0°" in said


def half_angles(arrow):
    """The angles at an arrow's tip, from its shaft to both sides of its head."""
    tail, tip, *head = arrow @ [1, 1j]
    assert head[1] == tip
    return np.angle((np.array(head[::2]) - tip) / (tail - tip))


@pytest.mark.parametrize("place", [(30, 20), (21, 5), (40, 10), (33, 38), (0, 0), (60, 1)])
def test_a_dragged_target_is_where_the_camera_says(page, place):
    pixel = np.array([ACROSS_SHOT[place[0]], DOWN_SHOT[place[1]]])
    (photo, table), said = move(page, 3, *place)
    spot = aiming.target_place(SHOT, pixel)
    assert said == f"{aiming.describe_aim(SHOT, pixel)}."
    assert words(table)[-1] == aiming.distance_and_turn(SHOT, pixel)
    rings = numbers(photo, "circle")
    assert rings == numbers(aiming.aim_view(SHOT, pixel)[0], "circle")
    x, z = spot[[0, 2]]
    assert np.abs(numbers(table, "circle")[-1][:2] - on(table, [z, x])).max() < 0.1
    turn, lines = aiming.trunk_turn(spot), re.findall(r'<polyline points="([^"]*)"', table)
    assert (len(lines) == 3) == (turn is not None)
    if turn is not None:
        tip = np.float64(lines[-1].split()[-1].split(","))
        x, _, z = to_world(aiming.AHEAD, turn)[1]
        assert np.abs(tip - on(table, [z, x])).max() < 1


def test_a_place_is_dragged_in_either_picture(page):
    move(page, 3, 30, 20)
    box = page.locator(".vmc-demo").nth(3)
    box.scroll_into_view_if_needed()
    twins = box.locator("input").all()
    for handle, way in ((0, (40, -20)), (1, (-15, 25))):
        before = [twin.input_value() for twin in twins]
        grip = box.locator(".vmc-handle").nth(handle)
        place = middle(grip)
        drag(page, place, *way)
        assert [twin.input_value() for twin in twins] != before
        off = np.subtract(middle(grip), place) - way
        assert np.abs(off).max() < 8  # to the nearest place of the grid


def test_the_camera_is_that_of_python(page):
    rng = np.random.default_rng(2)
    pixels = rng.uniform([0, 0], [600, 400], (20, 2))
    points = SHOT.camera.back_project(pixels, -0.4)
    given = aiming.aim_in_page(SHOT)[2]
    seen, back = page.evaluate(
        """([camera, pixels, points]) => [
          pixels.map((pixel) => vmc["eye/camera"].backProject(camera, pixel, -0.4)),
          points.map((point) => vmc["eye/camera"].project(camera, point))]""",
        [given["camera"], pixels.tolist(), points.tolist()],
    )
    assert np.allclose(seen, points, atol=1e-9)
    assert np.allclose(back, pixels, atol=1e-6)


def test_a_photo_lies_below(page):
    [seen], _ = move(page, 0, 1, 1, 1, 1)
    assert data_uri(photos.load("rig", "validation")[0].image) in seen
