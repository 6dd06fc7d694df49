"""C9: peak behind the region against what the grid's own time scheme leaves of the same pulse, and what is reflected.

The pulse crosses 80 dx of grid, 40 dx (a wavelength) of particles and 80 dx of grid. A Fourier component of angular frequency w loses
per step of length dt what the scheme leaves of exp(-i w dt): BDF2, 1.5 q^n+1 - 2 q^n + 0.5 q^n-1 = -i w dt q^n+1, after a first
step of BDF1, q^1 (1 + i w dt) = q^0. That this is what the grid does is checked by the grid alone.
"""

import numpy as np
from lib import coupled

DX, C, A, WIDTH, START, RHO = 0.01, 1.0, 1e-4, 0.4 / np.pi, -1.0, 1000.0


def left_by_the_grid(x, dt, grid_time, free_time, start=True):
    """The pulse after `grid_time` of the grid's steps (rounded to whole ones) and `free_time` of exact travel.

    start=False: as if the first step were one of BDF2 like the others.
    """
    n, length = 4096, 8.0
    xs = (np.arange(n) - n // 2) * length / n
    k = 2 * np.pi * np.fft.fftfreq(n, length / n)
    a = 1j * k * C * dt
    steps = int(round(grid_time / dt))
    before, now = np.ones_like(a), 1 / (1 + a)
    if not start:
        now = (2 + np.sqrt(1 - 2 * a)) / (3 + 2 * a)  # the root that BDF2 keeps
    for _ in range(steps - 1):
        before, now = now, (2 * now - 0.5 * before) / (1.5 + a)
    spectrum = np.fft.fft(np.exp(-((xs - START) / WIDTH) ** 2))
    shape = np.fft.ifft(spectrum * now * np.exp(-1j * k * C * (free_time + grid_time - steps * dt))).real
    return np.interp(x, xs, shape)


def pressure(moment):
    return moment.fv.p / (RHO * C**2 * A)


def check(case):
    rows, x_behind = [], np.linspace(0.4, 2, 1601)
    for substeps in (1, 2, 5, 10):
        run = case.run(case.folder / "scene", name=f"m{substeps}", set=[f"scene.coupling.substeps={substeps}"])
        last = coupled.Moment(run, -1)
        dt = float(np.median(run.fv.scalars["dt"][1:]))
        p, x = pressure(last), last.fv.x[:, 0]
        measured = p[last.computed & (x > 0.4)].max()
        expected = left_by_the_grid(x_behind, dt, 1.6 / C, 0.4 / C).max()
        without_start = left_by_the_grid(x_behind, dt, 1.6 / C, 0.4 / C, start=False).max()
        # in front of the region only what came back, if it has left the region: x < -0.4
        reflected = np.abs(p[last.computed & (x < -0.4)]).max()
        grid = case.run(case.folder / "alone", name=f"alone_m{substeps}", solver="fv", set=[f"fv.time.dt={dt:.15g}"])
        alone = coupled.Moment(grid, -1)
        by_formula = left_by_the_grid(alone.fv.x[:, 0], dt, alone.time, 0.0).max()
        rows.append([substeps, dt * C / DX, measured, expected, measured / expected, measured / without_start, reflected,
                     pressure(alone).max() / by_formula])
        case.metric(f"M={substeps}: grid alone, peak over the formula's", rows[-1][-1], between=(0.99, 1.01))
        case.metric(f"M={substeps}: peak over what the grid leaves", rows[-1][4],
                    between=(0.97 if substeps == 1 else 0.95, 1.05))
        case.metric(f"M={substeps}: reflection", reflected, at_most=0.02 if substeps == 1 else 0.05)
    case.table("Pulse", ["M", "c dt/dx", "peak", "grid leaves", "ratio", "ratio without start", "reflected", "grid alone"],
               rows)
