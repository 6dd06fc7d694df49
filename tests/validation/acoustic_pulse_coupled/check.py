"""C9: peak behind the region against BDF2's own damping of the same pulse, and what is reflected.

The pulse crosses 80 dx of grid, 40 dx (a wavelength) of particles and 80 dx of grid. A Fourier component of angular frequency w loses
per step of length dt what BDF2 leaves of exp(-i w dt): the larger root z of 1.5 z^2 - 2 z + 0.5 = -i w dt z^2.
"""

import numpy as np
from lib import coupled

DX, C, A, WIDTH, START, RHO = 0.01, 1.0, 1e-4, 0.4 / np.pi, -1.0, 1000.0


def bdf2_pulse(x, dt, grid_time, free_time):
    """The pulse after `grid_time` of BDF2 steps and `free_time` of exact travel."""
    n, length = 4096, 8.0
    xs = (np.arange(n) - n // 2) * length / n
    k = 2 * np.pi * np.fft.fftfreq(n, length / n)
    a = 1j * k * C * dt
    z = (2 + np.sqrt(1 - 2 * a)) / (3 + 2 * a)
    spectrum = np.fft.fft(np.exp(-((xs - START) / WIDTH) ** 2))
    shape = np.fft.ifft(spectrum * z ** (grid_time / dt) * np.exp(-1j * k * C * free_time)).real
    return np.interp(x, xs, shape)


def check(case):
    rows = []
    for substeps in (1, 2, 5):
        run = case.run(case.folder / "scene", name=f"m{substeps}", set=[f"scene.coupling.substeps={substeps}"])
        last = coupled.Moment(run, -1)
        dt = float(np.median(run.fv.scalars["dt"][1:]))
        p = last.fv.p / (RHO * C**2 * A)
        x = last.fv.x[:, 0]
        behind = last.computed & (x > 0.4)
        expected = bdf2_pulse(np.linspace(0.4, 2, 1601), dt, 1.6 / C, 0.4 / C).max()
        peak = p[behind].max() / expected
        # in front of the region only what came back, if it has left the region: x < -0.4
        reflected = np.abs(p[last.computed & (x < -0.4)]).max()
        rows.append([substeps, dt * C / DX, p[behind].max(), expected, peak, reflected])
        case.metric(f"M={substeps}: peak over BDF2's", peak, between=(0.97 if substeps == 1 else 0.95, 1.05))
        case.metric(f"M={substeps}: reflection", reflected, at_most=0.02 if substeps == 1 else 0.05)
    case.table("Pulse", ["M", "c dt/dx", "peak", "BDF2's peak", "ratio", "reflected"], rows)
