"""Front speed and volume of a dam break with a level set."""

import numpy as np


def check(case):
    rows = []
    for n in (20, 40):
        run = case.run(case.folder / "scene", solver="fv", name=f"n{n}", set=[f"scene.constants.n={n}"])
        s = run.fv.scalars
        unit = (0.6 / 9.81) ** 0.5
        dry = s["time"] < 2.4 * unit  # the front reaches the wall later than 2.5
        volume = s["water_volume"] / s["water_volume"][0] - 1
        times, fronts = [], []
        for moment in run.fv.snapshots:
            wet = moment["level_set"].ravel() < 0.0
            times.append(moment.time / unit)
            fronts.append(moment.points[wet, 0].max() / 0.6)
        times, fronts = np.array(times), np.array(fronts)
        fast = (times > 0.9) & (times < 2.1)
        speed = np.polyfit(times[fast], fronts[fast], 1)[0]
        rows.append([n, speed, abs(volume[dry]).max(), run.fv.summary["results"]["inner_cycles_per_step"],
                     run.fv.summary["results"]["unconverged_steps"]])
        case.metric(f"H/{n}: front speed over sqrt(gH)", speed, between=(1.6, 2.1))
        case.metric(f"H/{n}: volume before the wall", abs(volume[dry]).max(), below=5e-3)
    case.table("Until the wall", ["cells over H", "speed", "volume", "cycles a step", "unconverged"], rows)
