"""Dam break of Lobovsky et al. (2014): pressure at 15 mm on the far wall, in 2-D and, with 10^5 particles, in 3-D."""

import numpy as np

H, G, RHO = 0.3, 9.81, 1000.0
TIME = np.sqrt(H / G)
PEAK = (1.77, 2.03)                                                     # between the 2.5% and 97.5% of 100 runs; median 1.871
MEDIANS = {3.0: 0.919, 3.5: 0.617, 4.0: 0.590, 5.0: 0.581, 6.0: 0.843}  # p / rho g H at t sqrt(g/H)
HALF_WINDOW = 0.1                                                       # sound of a period 4H/c = .2 (c = 20) is averaged


def series(run):
    return run.sph.gauges["time"] / TIME, run.sph.gauges["sensor.p"] / (RHO * G * H), run.sph.gauges["sensor.wet"]


def check(case):
    rows = []
    for name, scene, n in (("2-D", "plane", 60), ("3-D", "space", 48)):
        run = case.run(case.folder / scene, set=[f"scene.constants.n={n}"], name=f"{scene}_n{n}", solver="sph")
        t, p, wet = series(run)
        label = f"{name}, n={n}"
        arrival = float(t[np.argmax(wet > 0.5)])
        window = (t > arrival) & (t < 3.0)
        smooth = np.array([np.mean(p[np.abs(t - at) < 0.05]) for at in t[window]])
        peak, when = float(smooth.max()), float(t[window][smooth.argmax()])
        row = [name, n, run.sph.summary["results"]["particles"], arrival, peak, when]
        case.metric(f"{label}: arrival, t sqrt(g/H)", arrival)
        case.metric(f"{label}: peak, mean over .1, over rho g H", peak)
        for at, median in MEDIANS.items():
            if at + HALF_WINDOW > t[-1]:
                row.append("-")
                continue
            value = float(np.median(p[np.abs(t - at) < HALF_WINDOW]))
            row.append(value)
            case.metric(f"{label}: pressure at t* = {at} over the median of the experiments", value / median, between=(0.85, 1.15))
        rows.append(row + [run.sph.summary["results"].get("kept_out", 0), run.seconds])
        if scene == "space":
            case.metric(f"{label}: particles", run.sph.summary["results"]["particles"], at_least=1e5)
    header = ["run", "H/dx", "particles", "arrival", "peak", "at"] + [f"t* {at}" for at in MEDIANS] + ["put back", "wall s"]
    case.table(f"Lobovsky; experiments: peak 1.871, {PEAK[0]} to {PEAK[1]}, at 2.60; {list(MEDIANS.values())}", header, rows)
