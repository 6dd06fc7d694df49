"""A stream with a linear wave on it enters a box of particles by one vertical face and leaves by the other.

Water comes in under a level that moves: rows of particles must follow it without steps. Judged when the start has left.
"""

import numpy as np
from lib import coupled
from littoral_lib import signals
from scipy.spatial import cKDTree

H, G, N = 1.0, 1.0, 32
DX, U, K = H / N, 0.5, np.pi
S = np.sqrt(G * K * np.tanh(K * H))
W = S + U * K
PERIOD = 2 * np.pi / W
START_LEFT = 40 * DX / U  # [s] the box with its layers is 40 dx long


def row_steps(x, surface, eta):
    """Greatest change of the height over the exact surface between surface particles next to one another [dx]."""
    top = surface & (x[:, 2] > -0.25 * H)
    order = np.argsort(x[top, 0])
    along = x[top, 0][order]
    height = (x[top, 2] - eta(x[top, 0]))[order]
    beside = np.diff(along) < 1.6 * DX
    return np.abs(np.diff(height)[beside]).max() / DX, height / DX + 0.5


def measure(run, a):
    rows = []
    b = a * G * K / (S * np.cosh(K * H))
    for s in run.sph.snapshots[1:]:
        x, t = s.points, s.time
        inside, surface = np.ravel(s["zone"]) == 0, np.ravel(s["surface"]) == 2
        phase = K * x[:, 0] - W * t
        u = np.column_stack([U + b * np.cosh(K * (x[:, 2] + H)) * np.cos(phase), 0 * phase,
                             b * np.sinh(K * (x[:, 2] + H)) * np.sin(phase)])
        p = 1000 * (-G * x[:, 2] + a * G * np.cosh(K * (x[:, 2] + H)) / np.cosh(K * H) * np.cos(phase))
        deep = inside & (x[:, 2] < -3 * DX)  # linear theory's pressure is not meant for the crest
        step, level = row_steps(x, surface, lambda at: a * np.cos(K * at - W * t))
        rows.append([t / PERIOD, signals.rms(np.linalg.norm(s["velocity"] - u, axis=1)[inside]) / (max(a, 1e-9) * W),
                     signals.rms((np.ravel(s["pressure"]) - p)[deep]) / (1000 * G * DX), step, level.mean(),
                     np.abs(level).max(), cKDTree(x).query(x, k=2)[0][:, 1].min() / DX, len(x)])
    return np.array(rows)


def check(case):
    run = case.run(case.folder, solver="sph")
    rows = measure(run, 0.02 * H)
    case.table("A stream with waves", ["t / T", "u rms / (a w)", "p rms / (rho g dx)", "row step / dx", "level / dx",
                                       "worst level / dx", "spacing / dx", "particles"], rows.tolist())
    late = rows[rows[:, 0] * PERIOD > 1.2 * START_LEFT]
    case.metric("largest row step / dx, start gone", late[:, 3].max(), below=0.1)
    case.metric("smallest spacing / dx", rows[:, 6].min(), above=0.5)
    case.metric("rms error of u / (a omega), start gone", late[:, 1].max(), below=0.1)
    case.metric("rms error of p under 3 dx / (rho g dx), start gone", late[:, 2].max(), below=0.3)  # as C8
    case.metric("mean error of the level / dx, start gone", np.abs(late[:, 4]).max(), below=0.25)
    n = run.sph.scalars["n_particles"]
    case.metric("largest change of the number of particles", np.abs(n / n[0] - 1).max(), below=0.04)  # a column is .025
    case.metric("ledger / mass", coupled.ledger(run), below=1e-12)
