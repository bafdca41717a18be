import numpy as np


def delay_signal_by_a_loop(signal, steps):
    return [signal[max(t - steps, 0)] for t in range(len(signal))]


def delay_signal_by_repeat(signal, steps):
    return np.concatenate([np.repeat(signal[:1], steps, axis=0), signal[:-steps]])


def delay_signal_by_slices(signal, steps):
    late = np.empty_like(signal)
    late[:steps] = signal[0]
    late[steps:] = signal[:-steps]
    return late


def delay_signal_by_padding(signal, steps):
    return np.pad(signal, ((steps, 0), (0, 0)), mode="edge")[: len(signal)]


def smith_by_a_loop(report, model, steps):
    return [model[t] + report[t] - model[max(0, t - steps)] for t in range(len(model))]


def smith_by_concatenation(report, model, steps):
    then = np.concatenate([[model[0]] * steps, model[:-steps]])
    return report + (model - then)


def smith_by_a_shift(report, model, steps):
    then = np.roll(model, steps)
    then[:steps] = model[0]
    return model - then + report
