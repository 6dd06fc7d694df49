"""Measures of a standing-wave run (configs/standing_wave): errors, decay, noise."""

import math

import numpy as np
from littoral_lib import signals
from littoral_lib.compare import StandingWaveRun

from lib import coupled


class Measures:
    """Numbers of one run; errors against the exact initial-value problem."""


def measure(run):
    history = StandingWaveRun(run.out)
    wave, m = history.wave, Measures()
    m.period_error = history.period() / wave.period - 1
    m.kept, m.kept_high = history.energy_kept(), wave.mode_energy_kept
    m.kept_low = math.exp(-4 * wave.nu * wave.k**2 * wave.period0)
    m.mass_error = float(np.abs(history.mass / history.mass[0] - 1).max())
    # rms error of the curves, over the rms of the exact elevation and over the initial energy
    pick = slice(None, None, max(1, len(history.gauge_time) // 400))
    exact = wave.elevation(history.gauge_time[pick])
    m.elevation_error = signals.rms(history.elevation[pick] - exact) / signals.rms(exact)
    pick = slice(None, None, max(1, len(history.time) // 100))
    energy = wave.energy(history.time[pick], history.length)
    m.energy_error = signals.rms(history.energy[pick] / history.kinetic[0] - energy / energy[0])
    m.ledger = coupled.ledger(run) if run.sph.folder.is_dir() else float("nan")
    m.noise, m.noise_growth = acoustic_noise(run, wave.depth)
    return m


def acoustic_noise(run, depth, sound_speed=10.0):
    """(rms over rho g H, growth) of the bottom pressure about its mean over two periods 4H/c of the gravest mode."""
    gauges = run.fv.gauges
    time, pressure = gauges["time"], gauges["bottom.p"] / 1000.0
    step = np.median(np.diff(time))
    even = np.arange(time[0], time[-1], step)
    pressure = np.interp(even, time, pressure)
    width = max(3, int(round(2 * 4 * depth / sound_speed / step)) | 1)
    if len(pressure) < 3 * width:
        return float("nan"), float("nan")
    fluctuation = pressure[width // 2:len(pressure) - width // 2] - np.convolve(pressure, np.ones(width) / width, "valid")
    # what the moving mean leaves of the wave itself: its curvature, out of a second pass
    fluctuation = fluctuation[width // 2:len(fluctuation) - width // 2] - np.convolve(
        fluctuation, np.ones(width) / width, "valid")
    return signals.rms(fluctuation) / depth, signals.growth(fluctuation)
