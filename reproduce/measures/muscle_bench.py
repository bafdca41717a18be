"""A muscle on the bench: its force when held still (isometric), its speed under a load (isotonic).

Laws are `Muscle`s. Lengths are in optimal fibre lengths l₀, speeds in l₀/s, lengthening positive.
The muscle is the brachialis.
"""

import numpy as np

from vmc_lib.arm import muscle
from vmc_lib.arm.engines import activations
from vmc_lib.arm.model import F0, L0, MUSCLES

BRA = MUSCLES.index("BRA")
FIBRE, STRENGTH = L0[BRA], F0[BRA]  # l₀ in m, F₀ in N
GRAVITY = 9.81  # m/s²
DAMPING = 0.1  # F₀ per l₀/s, beside a fibre on a tendon that stretches
TIME = np.arange(600)  # ms
EXCITATIONS = {  # (600,) from 0 to 1; how many ms a pulse lasts, or a swing of the tremor
    "pulse": lambda ms: 1.0 * ((TIME >= 100) & (TIME < 100 + ms)),
    "pulse on half": lambda ms: np.where((TIME >= 100) & (TIME < 100 + ms), 1, 0.5),
    "tremor": lambda ms: 0.5 + 0.5 * np.sin(2 * np.pi * TIME / ms),
}


def normalised_force(law, activation, length, speed):
    """The force as a share of F₀."""
    return law.force(activation, length, np.asarray(speed) / muscle.MAX_VELOCITY, 1.0)


def active_force(law, length, speed):
    """What full activation adds to the passive force, as a share of F₀."""
    return normalised_force(law, 1.0, length, speed) - normalised_force(law, 0.0, length, speed)


def fastest_shortening(law):
    """The speed (l₀/s, positive) at which a fully active muscle of length l₀ has no force left."""
    speed = np.linspace(-12, 0, 12001)
    return -speed[active_force(law, 1, speed) > 1e-9][0]


def follow(excitation, law=muscle.PAPER):
    """The activation (T,) that follows an excitation (T,), one value a ms."""
    return activations(excitation[None, :, None], excitation[None, :1], law)[0, 1:, 0]


def isometric(law, pulses, length=1.0, tendon=0.0, damping=DAMPING):
    """The force (600, …) in N, one value a ms, under so many pulses of 3 ms a second.

    `pulses` and the fibre's `length` broadcast; a `tendon` of length 0 (in l₀) is rigid. On one
    that is not, a damper (F₀ per l₀/s) works beside the fibre.
    """
    pulses, length = np.broadcast_arrays(pulses, np.asarray(length, float))
    activation = np.transpose([follow(_pulse_train(rate), law) for rate in pulses.flat])
    activation = activation.reshape(-1, *pulses.shape)
    if not tendon:
        return STRENGTH * normalised_force(law, activation, length, 0)
    return STRENGTH * _pull_on_tendon(law, activation, length, tendon, damping)


def _pulse_train(rate):
    return 1.0 * (-TIME % (1000 / rate) < 3) * (TIME > 0)


def time_to_peak(law, tendon=0.0, damping=DAMPING):
    """How many ms after a pulse of 3 ms began the force peaks, at the best length."""
    return isometric(law, 3, 1.0, tendon, damping).argmax() - _pulse_train(3).argmax() + 1


TENDON_STIFFNESS = 33.93669377311689


def tendon_force(strain):
    """The pull of a stretched tendon, a share of F₀: 1 at a strain of 5 %.

    De Groote et al. (2016), Ann. Biomed. Eng. 44:2922, with SymPy's constants.
    """
    return 0.2 * np.exp(TENDON_STIFFNESS * (strain + 0.005)) - 0.25


def tendon_strain(force):
    """The strain at which a tendon pulls so hard, a share of F₀: `tendon_force` solved for it."""
    return np.log((force + 0.25) / 0.2) / TENDON_STIFFNESS - 0.005


def _pull_on_tendon(law, activation, length, tendon, damping=DAMPING, steps=2):
    """The force (T, …), a share of F₀, of fibres in series with a tendon, the whole held still.

    At each of so many steps a ms the fibre moves as fast as makes its force, and a damper's beside
    it (F₀ per l₀/s), equal to the tendon's: the damped equilibrium of Millard et al. (2013),
    J. Biomech. Eng. 135:021005. It begins at rest at `length`.
    """
    whole = length + tendon * tendon_strain(normalised_force(law, 0.0, length, 0))
    pulls = []
    for active in np.repeat(activation, steps, axis=0):
        pull = tendon_force((whole - length) / tendon)
        speed = _balanced_speed(law, active, length, pull, damping)
        pulls.append(pull)
        length = length + speed * 1e-3 / steps
    return np.array(pulls[::steps])


def _balanced_speed(law, active, length, pull, damping, parts=128):
    """The speed at which fibre and damper pull as hard as the tendon, from −12 to 12.

    They pull the harder the faster they lengthen: twice, the range becomes one of its parts.
    """
    share = np.linspace(0, 1, parts + 1).reshape(-1, *(1,) * np.ndim(length))
    low, high = np.full_like(length, -12.0), np.full_like(length, 12.0)
    for _ in range(2):
        speed = low + share * (high - low)
        force = normalised_force(law, active, length, speed) + damping * speed
        weaker = np.sum(force < pull, axis=0, keepdims=True).clip(1, parts)
        low, high = (np.take_along_axis(speed, weaker - k, 0)[0] for k in (1, 0))
    return (low + high) / 2


def ripple(force):
    """(highest − lowest) / mean of a force (T,), over its last 350 ms."""
    late = force[-350:]
    return np.ptp(late) / late.mean()


def isotonic(law, loads, per_speed=1 / muscle.MAX_VELOCITY, duration=300):
    """Lengths and speeds (ms, n) of the half-active muscle from when loads (n,) in kg are released.

    `per_speed` turns a speed into the v of Eq. 11; `duration` is in ms, of ten steps each.
    """
    step = 1e-4  # s
    loads = np.asarray(loads, float)
    length, speed, path = np.ones_like(loads), np.zeros_like(loads), []
    for _ in range(round(duration / 1000 / step)):
        path.append((length, speed))
        force = law.force(0.5, length, per_speed * speed, STRENGTH)
        speed = speed + step * (GRAVITY - force / loads) / FIBRE
        length = length + step * speed
    return np.swapaxes(path[::10], 0, 1)
