"""A progressive wave of linear theory enters a box of particles by one vertical face and leaves by the other.

Particles start at rest relative to nothing: the formula is theirs too at the start. Judged over the last period.
"""

import numpy as np
from lib import coupled
from littoral_lib import signals
from scipy.spatial import cKDTree

DX, A, K, L = 0.04, 0.02, np.pi, 24 * 0.04
W = np.sqrt(K * np.tanh(K))
PERIOD = 2 * np.pi / W
B = A * K / (W * np.cosh(K))


def check(case):
    run = case.run(case.folder, solver="sph")
    following = case.run(case.folder, set=["sph.coupling.rows=level"], name="level", solver="sph")
    case.metric("smallest spacing / dx, rows: level", min(coupled.smallest_spacing(s.points) for s in
                                                          following.sph.snapshots) / DX)
    u_rms, p_rms, level, spacing = [], [], [], np.inf
    for s in run.sph.snapshots[1:]:
        x, t = s.points, s.time
        inside = np.ravel(s["zone"]) == 0
        phase = K * x[:, 0] - W * t
        u = B * np.column_stack([np.cosh(K * (x[:, 2] + 1)) * np.cos(phase), 0 * phase,
                                 np.sinh(K * (x[:, 2] + 1)) * np.sin(phase)])
        p = 1000 * (-x[:, 2] + A * np.cosh(K * (x[:, 2] + 1)) / np.cosh(K) * np.cos(phase))
        deep = inside & (x[:, 2] < -3 * DX)  # linear theory's pressure is not meant for the crest
        u_rms.append(signals.rms(np.linalg.norm(s["velocity"] - u, axis=1)[inside]) / (A * W))
        p_rms.append(signals.rms((np.ravel(s["pressure"]) - p)[deep]) / (1000 * A))
        columns = np.floor(x[:, 0] / DX + 1e-6).astype(int)
        eta = [x[columns == c, 2].max() + DX / 2 - A * np.cos(K * (c + 0.5) * DX - W * t) for c in range(24)]
        level.append([np.mean(eta) / DX, signals.rms(np.array(eta)) / DX])
        spacing = min(spacing, cKDTree(x).query(x, k=2)[0][:, 1].min() / DX)
    level = np.array(level)
    case.metric("rms error of u / (a omega), last period", max(u_rms[-8:]), below=0.1)
    case.metric("rms error of p under 3 dx / (rho g a), last period", max(p_rms[-8:]), below=0.1)
    case.metric("mean error of the level / dx, last period", np.abs(level[-8:, 0]).max(), below=0.25)
    case.metric("rms error of the level / dx, last period", level[-8:, 1].max(), below=0.5)
    case.metric("smallest spacing / dx", spacing, above=0.6)
    n = run.sph.scalars["n_particles"]
    case.metric("largest change of the number of particles", np.abs(n / n[0] - 1).max(), below=0.01)
    case.metric("ledger / mass", coupled.ledger(run), below=1e-12)
