"""Dam break of Lobovsky et al. (2014): pressure at 15 mm on the far wall, in 2-D and, with 10^5 particles, in 3-D.

Beside the experiments: a free jet on the wall (potential flow), as thick and fast as shallow water theory has it.
"""

import numpy as np
from littoral_lib import exact

H, G, RHO = 0.3, 9.81, 1000.0
TIME = np.sqrt(H / G)
PEAK = (1.77, 2.03)                                                     # between the 2.5% and 97.5% of 100 runs; median 1.871
MEDIANS = {3.0: 0.919, 3.5: 0.617, 4.0: 0.590, 5.0: 0.581, 6.0: 0.843}  # p / rho g H at t sqrt(g/H)
HALF_WINDOW = 0.1                                                       # sound of a period 4H/c = .2 (c = 20) is averaged
WALL, DAM, SENSOR = 1.61 / H, 2.0, 0.05


def jet(time):
    """Pressure at the sensor over rho g H: of the jet, and the head of its surface over the sensor."""
    u, depth = exact.ritter(WALL - DAM, time)
    return u**2 * exact.jet_on_wall(SENSOR / depth) + depth - SENSOR


def at_times(t, p):
    return ["-" if at + HALF_WINDOW > t[-1] else float(np.median(p[np.abs(t - at) < HALF_WINDOW])) for at in MEDIANS]


def check(case):
    rows = []
    for name, scene, n in (("2-D", "plane", 60), ("3-D", "space", 48)):
        run = case.run(case.folder / scene, set=[f"scene.constants.n={n}"], name=f"{scene}_n{n}", solver="sph")
        gauges = run.sph.gauges
        t, p, states = (gauges["time"] / TIME, gauges["sensor.p"] / (RHO * G * H), gauges["sensor_states.p"] / (RHO * G * H))
        label = f"{name}, n={n}"
        arrival = float(t[np.argmax(gauges["sensor_states.wet"] > 0.5)])
        window = (t > arrival) & (t < 3.0)
        smooth = np.array([np.mean(p[np.abs(t - at) < 0.05]) for at in t[window]])
        peak, when = float(smooth.max()), float(t[window][smooth.argmax()])
        case.metric(f"{label}: arrival, t sqrt(g/H)", arrival)
        case.metric(f"{label}: peak, mean over .1, over rho g H", peak)
        values = at_times(t, p)
        for (at, median), value in zip(MEDIANS.items(), values):
            if value == "-":
                continue
            case.metric(f"{label}: pressure at t* = {at} over the median of the experiments", value / median, between=(0.85, 1.15))
            if at < 4.5:  # later what ran up comes back
                case.metric(f"{label}: the same over the jet on a wall", value / jet(at))
        kept = run.sph.summary["results"].get("kept_out", 0)
        particles = run.sph.summary["results"]["particles"]
        rows.append([name, n, particles, arrival, peak, when, *values, kept, run.seconds])
        rows.append([f"{name}, states", n, "", "", "", "", *at_times(t, states), "", ""])
        if scene == "space":
            case.metric(f"{label}: particles", particles, at_least=1e5)
    rows.append(["jet on a wall", "", "", "", "", "", *(jet(at) if at < 4.5 else "-" for at in MEDIANS), "", ""])
    header = ["run", "H/dx", "particles", "arrival", "peak", "at"] + [f"t* {at}" for at in MEDIANS] + ["put back", "wall s"]
    case.table(f"Lobovsky; experiments: peak 1.871, {PEAK[0]} to {PEAK[1]}, at 2.60; {list(MEDIANS.values())}", header, rows)
