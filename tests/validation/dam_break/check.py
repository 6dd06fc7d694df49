"""The scene configs/dam_break: arrival and plateau of the pressure on the far wall, speed of the front."""

import numpy as np

H, G, RHO = 0.6, 9.81, 1000.0
TIME = np.sqrt(H / G)
SPEED = np.sqrt(G * H)


def wall_force_over_momentum(run, n):
    """What the far wall carries over the flux of momentum that arrives before it, mean over t* = 3 to 4.5."""
    ratios = []
    for s in run.sph.snapshots:
        if not 2.95 < s.time / TIME < 4.55:
            continue
        x, z = s.points[:, 0] / H, s.points[:, 2] / H
        u, p = s["velocity"][:, 0] / SPEED, s["pressure"] / (RHO * G * H)
        before, wall = (x > 4.7) & (x < 4.9), x > 5.366 - 1.01 / n
        flux = np.sum(u[before] ** 2 + p[before]) / n**2 / 0.2
        band = np.floor(z[wall] / 0.05).astype(int)
        ratios.append(0.05 * sum(np.mean(p[wall][band == b]) for b in set(band)) / flux)
    return float(np.mean(ratios))


def check(case):
    rows = []
    for n in (40, 80):
        run = case.run("configs/dam_break", set=[f"scene.constants.n={n}"], name=f"n{n}", solver="sph")
        t = run.sph.gauges["time"] / TIME
        p = run.sph.gauges["sensor.p"] / (RHO * G * H)
        wet = run.sph.gauges["sensor.wet"]
        arrival = float(t[np.argmax(wet > 0.05)])
        plateau = float(np.median(p[(t > 3.2) & (t < 4.8)]))
        spread = float(np.std(p[(t > 3.2) & (t < 4.8)]))
        front = np.array([[s.time, s.points[:, 0].max()] for s in run.sph.snapshots])
        runs = (front[:, 1] > 3.5 * H) & (front[:, 1] < 5.1 * H)
        speed = float(np.polyfit(front[runs, 0], front[runs, 1], 1)[0]) / SPEED
        force = wall_force_over_momentum(run, n)
        rows.append([n, arrival, plateau, spread, speed, force, run.sph.summary["results"].get("kept_out", 0), run.seconds])
        case.metric(f"n={n}: arrival at the sensor, t sqrt(g/H)", arrival, between=(2.5, 3.0))
        case.metric(f"n={n}: median of the plateau, 3.2 < t* < 4.8, over rho g H", plateau, between=(0.45, 0.68))
        case.metric(f"n={n}: force on the far wall over the momentum that arrives", force, between=(0.8, 1.2))
        case.metric(f"n={n}: speed of the front over 1.95 sqrt(gH)", speed / 1.95)
    case.table("Dam break", ["H/dx", "arrival", "plateau", "its deviation", "front/sqrt(gH)", "wall force", "put back", "wall s"], rows)
