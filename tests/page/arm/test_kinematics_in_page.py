"""Inverse kinematics and the turn of the trunk, in the page as in Python."""

import numpy as np
import pytest

from vmc_lib import NoReach
from vmc_lib.arm.kinematics import inverse_kinematics, to_world, turn_towards

TARGETS = np.array([[0.12, -0.42], [0.045, -0.345], [0.17, -0.46]])


@pytest.mark.browser
@pytest.mark.parametrize("target", TARGETS, ids=str)
def test_inverse_kinematics(ask, target):
    posture = ask(
        "return vmc['arm/kinematics'].inverseKinematics(given.kinematics, asked);", target.tolist()
    )
    assert np.allclose(posture, inverse_kinematics(target), atol=1e-9)


@pytest.mark.browser
def test_the_trunk_turns_as_in_python(ask):
    """To each place of a grid on the table, or else why not, in the same words."""
    places = np.stack(
        np.meshgrid([-0.1, 0.05, 0.2, 0.35], [-0.43, -0.4], np.linspace(-0.5, 0.3, 9)), -1
    )
    script = """return asked.map((place) => {
      try {
        const { turn, place: [x, y] } = vmc["arm/kinematics"].turnTowards(given.kinematics, place);
        return [turn, x, y, ...vmc["arm/kinematics"].toWorld(given.kinematics, [x, y, 0.1], turn)];
      } catch (error) { return error.message; }
    });"""
    answers = list(zip(places := places.reshape(-1, 3), ask(script, places.tolist()), strict=True))
    for target, answer in answers:
        if isinstance(answer, str):
            why = "needs a turn of" if "turn" in answer else "beyond the arm's reach of"
            assert why in answer
            with pytest.raises(NoReach, match=why):
                turn_towards(target)
            continue
        turn, point = turn_towards(target)
        expected = [turn, *point, *to_world([*point, 0.1], turn)]
        assert np.allclose(answer, expected, atol=1e-9)
    refused = sum(isinstance(answer, str) for _, answer in answers)
    assert 10 < refused < len(answers) - 10
