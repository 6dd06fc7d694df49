"""Measures of signals: periods from zero crossings, decay from peaks, growth of a fluctuation."""

import numpy as np


def up_crossings(time, signal):
    """Times at which the signal rises through its zero (linear between rows)."""
    rises = np.flatnonzero((signal[:-1] < 0) & (signal[1:] >= 0))
    return time[rises] - signal[rises] * (time[rises + 1] - time[rises]) / (signal[rises + 1] - signal[rises])


def shedding(time, drag, lift, start):
    """Over the whole periods of the lift after `start`: mean drag, amplitude and mean of the lift, frequency."""
    late = time > start
    time, drag, lift = time[late], drag[late], lift[late]
    rises = up_crossings(time, lift)
    if len(rises) < 2:
        raise ValueError(f"the lift has no whole period after t = {start:g}")
    whole = (time >= rises[0]) & (time < rises[-1])
    return {"drag": drag[whole].mean(), "amplitude": 0.5 * (lift[whole].max() - lift[whole].min()),
            "lift": lift[whole].mean(), "frequency": (len(rises) - 1) / (rises[-1] - rises[0])}


def zero_crossings(time, signal):
    """Times of all zero crossings, rising and falling."""
    return np.sort(np.concatenate([up_crossings(time, signal), up_crossings(time, -signal)]))


def mean_period(time, signal):
    """Twice the mean distance of neighbouring zero crossings, by a straight line through all of them."""
    crossings = zero_crossings(time, signal)
    if len(crossings) < 3:
        return float("nan")
    return 2.0 * np.polyfit(np.arange(len(crossings)), crossings, 1)[0]


def peaks(time, signal, window):
    """(times, values) of the maxima that are the largest within +-window; a parabola through +-window/3 places them.

    Maxima closer than `window` to either end of the record are left out.
    """
    times, values = [], []
    for i in range(1, len(time) - 1):
        if time[i] - window < time[0] or time[i] + window > time[-1]:
            continue
        if signal[i] < signal[np.abs(time - time[i]) <= window].max() or signal[i] == signal[i - 1]:
            continue
        near = np.abs(time - time[i]) <= window / 3
        near[i - 1:i + 2] = True
        a, b, c = np.polyfit(time[near] - time[i], signal[near], 2)
        if a < 0:
            times.append(time[i] - b / (2 * a))
            values.append(c - b * b / (4 * a))
    return np.array(times), np.array(values)


def moving_mean(time, signal, width):
    """Mean over +-width/2 about each time, over what there is of it at the ends."""
    sums = np.concatenate([[0.0], np.cumsum(0.5 * (signal[1:] + signal[:-1]) * np.diff(time))])
    left, right = np.maximum(time - width / 2, time[0]), np.minimum(time + width / 2, time[-1])
    return (np.interp(right, time, sums) - np.interp(left, time, sums)) / (right - left)


def kept_per(time, values, interval):
    """Factor by which positive values fall in one interval: a straight line through their logarithms."""
    if len(time) < 2:
        return float("nan")
    return float(np.exp(np.polyfit(time, np.log(values), 1)[0] * interval))


def rms(signal):
    return float(np.sqrt(np.mean(np.square(signal)))) if len(signal) else float("nan")


def growth(signal, parts=5):
    """Rms of the last part over the rms of the first (of `parts` equal ones); 1: neither grows nor decays."""
    n = len(signal) // parts
    return rms(signal[-n:]) / rms(signal[:n]) if n else float("nan")
