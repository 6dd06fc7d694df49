"""Measures of waves and water that fv_solver's scalars.csv tells."""

import collections

import numpy as np

Swing = collections.namedtuple("Swing", "period amplitude_a_period volume")


def swing(scalars):
    """Period and change of amplitude a period of a standing wave from the times and heights of its kinetic energy's
    maxima, two a period, and the largest
    relative change of the water's volume."""
    t, energy = scalars["time"], scalars["kinetic_energy"]
    inner = np.arange(2, len(energy) - 2)
    around = np.stack([energy[inner + k] for k in (-2, -1, 0, 1, 2)])
    top = inner[(energy[inner] >= around.max(axis=0)) & (energy[inner] > 0.3 * energy.max())]
    low, mid, high = energy[top - 1], energy[top], energy[top + 1]
    offset = 0.5 * (low - high) / (low - 2 * mid + high)
    times = t[top] + offset * (t[top + 1] - t[top])
    heights = mid - 0.25 * (low - high) * offset
    halves = len(times) - 1
    halves -= halves % 2  # whole periods: a steep start swings unevenly within one
    volume = scalars["water_volume"]
    return Swing(period=2 * (times[halves] - times[0]) / halves,
                 amplitude_a_period=(heights[halves] / heights[0]) ** (1 / halves) - 1,
                 volume=np.abs(volume / volume[0] - 1).max())
