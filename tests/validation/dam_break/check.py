"""The scene configs/dam_break: arrival and plateau of the pressure on the far wall, its force, speed of the front.

The 90 mm disc is read at two heights: its centre .267 H above the floor, and with its upper edge there, as published
computations have it. Beside both: a free jet on a wall (potential flow) as thick and fast as shallow water theory has it.
"""

import numpy as np
from littoral_lib import exact

H, G, RHO = 0.6, 9.81, 1000.0
TIME = np.sqrt(H / G)
SPEED = np.sqrt(G * H)
WALL, DAM, RADIUS = 5.366, 2.0, 0.045 / H
PLATEAU = (3.2, 4.8)


def jet(centre, moments):
    """Mean pressure over the disc, over rho g H, by shallow water theory up to the wall and potential flow at it."""
    values = []
    for t in moments:
        u, depth = exact.ritter(WALL - DAM, t)
        s = (np.arange(16) + 0.5) / 8 - 1
        width = np.sqrt(1 - s**2)
        p = [u**2 * exact.jet_on_wall((centre + RADIUS * a) / depth) for a in s]
        values.append(np.sum(width * p) / np.sum(width))
    return np.array(values)


def arriving(snapshots):
    """Flux of momentum a little before the wall over rho g H^2, mean over t* = 3 to 4.5."""
    flux = []
    for s in snapshots:
        if not 2.95 < s.time / TIME < 4.55:
            continue
        before = (s.points[:, 0] > 4.7 * H) & (s.points[:, 0] < 4.9 * H)
        u, p = s["velocity"][before, 0] / SPEED, s["pressure"][before] / (RHO * G * H)
        volume = s["volume"][before] / H**2
        flux.append(np.sum(volume * (u**2 + p)) / 0.2)
    return float(np.mean(flux))


def check(case):
    rows = []
    for n in (40, 80):
        run = case.run("configs/dam_break", set=[f"scene.constants.n={n}"], name=f"n{n}", solver="sph")
        gauges, scalars = run.sph.gauges, run.sph.scalars
        t = gauges["time"] / TIME
        flat = (t > PLATEAU[0]) & (t < PLATEAU[1])
        arrival = float(t[np.argmax(gauges["sensor_states.wet"] > 0.05)])
        medians = {name: float(np.median(gauges[f"{name}.p"][flat])) / (RHO * G * H)
                   for name in ("sensor", "lower", "sensor_states", "lower_states")}
        front = np.array([[s.time, s.points[:, 0].max()] for s in run.sph.snapshots])
        runs = (front[:, 1] > 3.5 * H) & (front[:, 1] < 5.1 * H)
        speed = float(np.polyfit(front[runs, 0], front[runs, 1], 1)[0]) / SPEED
        late = (scalars["time"] / TIME > 3) & (scalars["time"] / TIME < 4.5)
        force = float(np.mean(scalars["wall.fx"][late])) / (RHO * G * H**2) / arriving(run.sph.snapshots)
        rows.append([n, arrival, *medians.values(), speed, force, run.sph.summary["results"].get("kept_out", 0), run.seconds])
        case.metric(f"n={n}: arrival at the sensor, t sqrt(g/H)", arrival, between=(2.5, 3.0))
        case.metric(f"n={n}: median of the plateau, 3.2 < t* < 4.8, over rho g H", medians["sensor"], between=(0.45, 0.68))
        case.metric(f"n={n}: the same with the disc's upper edge at .267 H", medians["lower"], between=(0.45, 0.68))
        case.metric(f"n={n}: force on the far wall over the momentum that arrives", force, between=(0.8, 1.2))
        case.metric(f"n={n}: speed of the front over 1.95 sqrt(gH)", speed / 1.95)
    moments = np.linspace(*PLATEAU, 33)
    theory = [float(np.median(jet(centre, moments))) for centre in (0.267, 0.267 - RADIUS)]
    for centre, value in zip((".267 H", ".192 H"), theory):
        case.metric(f"jet on a wall: median of the plateau at {centre}", value)
    rows.append(["jet", "-", *theory, "-", "-", 2.0, 1.0, "-", "-"])
    case.table("Dam break", ["H/dx", "arrival", "sensor", "lower", "sensor, states", "lower, states", "front/sqrt(gH)",
                             "wall force", "put back", "wall s"], rows)
