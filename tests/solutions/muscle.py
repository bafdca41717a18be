import numpy as np

from vmc_lib.arm.muscle import force_length as f1
from vmc_lib.arm.muscle import force_velocity as f2
from vmc_lib.arm.muscle import passive_force as f3


def activation_rates_by_a_mask(u, a, rise, fall):
    rates, up = (u - a) / fall, u > a
    rates[up] = (u[up] - a[up]) * (u[up] / rise + (1 - u[up]) / fall)
    return rates


def activation_rates_by_haste(u, a, rise, fall):
    return (u - a) * (1 / fall + (u >= a) * u * (1 / rise - 1 / fall))


def activation_rates_by_a_loop(u, a, rise, fall):
    rates = []
    for to, now in zip(u, a, strict=True):
        mixture = to / rise + (1 - to) / fall if to >= now else 1 / fall
        rates.append((to - now) * mixture)
    return rates


def activation_to_hold_by_minimum(mass, length, strongest):
    left = mass * 9.81 - strongest * f3(length)
    return np.minimum(1, np.maximum(0, left / (strongest * f1(length) * f2(0))))


def activation_to_hold_by_where(mass, length, strongest):
    a = (mass * 9.81 / strongest - f3(length)) / f1(length) / f2(0.0)
    return np.where(a > 1, 1, np.where(a < 0, 0, a))


def activation_to_hold_by_a_loop(mass, length, strongest):
    active = [
        (9.81 * m - f3(x) * strongest) / (f1(x) * f2(0) * strongest)
        for m, x in zip(mass, length, strict=True)
    ]
    return [min(max(a, 0), 1) for a in active]
