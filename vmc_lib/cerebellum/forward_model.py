"""Forward models: predict the arm's acceleration from its state and the muscles' activations.

`ForwardModel` learns it by feeling its own arm move: granule cells sense the posture, its speed and
the muscles' torque, and Purkinje cells sum them to the acceleration. The teacher is what the senses
report later. `arm_copy` is the true equations, or true but for the strength of the muscles.
"""

from collections.abc import Callable
from functools import partial
from typing import Self

import numpy as np

from vmc_lib.arm.dynamics import interpolated_paths
from vmc_lib.arm.engines import muscle_acceleration, muscle_torque
from vmc_lib.arm.model import STEP
from vmc_lib.arm.simulate import Motion
from vmc_lib.cerebellum.online import GranuleCells
from vmc_lib.checks import as_numbers, check_kind

FAST, STRONG = 5.0, 8.0  # rad/s and N m: they bring what the cells sense to about one
BETWEEN = 20  # steps between the samples that are learned


def arm_copy(strength: float = 1.0) -> Callable[..., np.ndarray]:
    """A forward model that knows the arm, but believes its muscles `strength` times as strong.

    One strength, or one for each movement of a batch (B, 1). ValueError when one is negative.
    """
    if not np.all(as_numbers("strength", strength) >= 0):
        raise ValueError(f"muscles {strength} times as strong? give 0 or more")

    return partial(muscle_acceleration, strength=strength)


class ForwardModel:
    """Granule cells that learn which acceleration (…, 2) follows; called as `arm_copy()` is."""

    def __init__(self) -> None:
        self.cells = GranuleCells(width=1.0, cells=300, ridge=1e-3)

    def update(self, motion: Motion) -> Self:
        """Learn from a batch of movements, one sample every `BETWEEN` steps.

        It is told what the muscles really did, motor noise included: lessons come afterwards.
        """
        check_kind("motion", motion, Motion, "a batch, as execute(plans).motion")
        if np.ndim(motion.q) != 3:
            raise ValueError(f"{motion} is of one movement: give a batch, q (B, T + 1, 2)")
        q, velocity, activation = (
            x[:, BETWEEN:-1:BETWEEN].reshape(-1, x.shape[-1])
            for x in (motion.q, motion.velocity, motion.activation)
        )
        felt = np.diff(motion.velocity, axis=1)[:, BETWEEN::BETWEEN].reshape(-1, 2) / STEP
        self.cells.partial_fit(state_inputs(q, velocity, activation), felt)
        return self

    def __call__(self, q: np.ndarray, velocity: np.ndarray, activation: np.ndarray) -> np.ndarray:
        """The acceleration (B, 2) expected in rad/s²."""
        return self.cells.predict(state_inputs(q, velocity, activation))


def state_inputs(q: np.ndarray, velocity: np.ndarray, activation: np.ndarray) -> np.ndarray:
    """The mossy fibres' input: posture, speed, muscles' torque, (B, 6)."""
    q, velocity = as_numbers("q", q), as_numbers("velocity", velocity)
    if velocity.shape != q.shape:
        raise ValueError(f"velocity {velocity.shape} of q {q.shape}: give one for each joint")
    lengths, arms = interpolated_paths(q)
    torque = muscle_torque(as_numbers("activation", activation), lengths, arms, velocity)
    return np.concatenate([q, velocity / FAST, torque / STRONG], axis=-1)
