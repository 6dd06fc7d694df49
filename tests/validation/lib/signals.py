"""Measures of signals: periods from zero crossings, decay from peaks, growth of a fluctuation."""

import numpy as np


def up_crossings(time, signal):
    """Times at which the signal rises through its zero (linear between rows)."""
    rises = np.flatnonzero((signal[:-1] < 0) & (signal[1:] >= 0))
    return time[rises] - signal[rises] * (time[rises + 1] - time[rises]) / (signal[rises + 1] - signal[rises])


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
    """(times, values) of the local maxima that are the largest within +-window, by a parabola through each."""
    times, values = [], []
    for i in range(1, len(time) - 1):
        near = np.abs(time - time[i]) <= window
        if signal[i] >= signal[near].max() and time[i] - window >= time[0] and time[i] + window <= time[-1]:
            fit = np.polyfit(time[near] - time[i], signal[near], 2) if near.sum() > 3 and window > 0 else None
            three = np.polyfit(time[i - 1:i + 2] - time[i], signal[i - 1:i + 2], 2)
            a, b, c = three if fit is None or fit[0] >= 0 else three
            shift = -b / (2 * a) if a < 0 else 0.0
            times.append(time[i] + shift)
            values.append(c - b * b / (4 * a) if a < 0 else signal[i])
    return np.array(times), np.array(values)


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
