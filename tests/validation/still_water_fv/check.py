"""Still water whose start is not at rest for the pressure it is given: what is left of the sound and the roll that makes."""

import numpy as np


def check(case):
    rows = []
    for shift in (0.0, 0.25, 0.5, 0.75):
        n, depth = 32, 0.5 + shift / 32
        done = case.run("configs/wave_tank", solver="fv", name=f"level_{shift}", set=[
            f"scene.constants.n={n}", f"scene.constants.H={depth!r}", f"scene.constants.air={0.25 - shift / n!r}",
            "scene.constants.amplitude=0", "scene.initial.p=-0.9*1000*9.81*z", "scene.time.end=8", "scene.time.field_interval=0"])
        s = done.fv.scalars
        speed = np.sqrt(2 * s["kinetic_energy"] / s["mass"]) / np.sqrt(9.81 * depth)
        volume = float(np.abs(s["volume_error"]).max() / s["water_volume"][0])
        rows.append([shift, speed.max(), speed[-1], volume])
        case.metric(f"still level {shift} in the cell: rms speed / sqrt(gH), largest", float(speed.max()), below=1e-3)
        case.metric(f"still level {shift} in the cell: the same at the end", float(speed[-1]), below=1e-4)
        case.metric(f"still level {shift} in the cell: volume of the water, largest change", volume, below=1e-5)
    case.table("Still water, p 10% off at the start, 32 cells, t = 8 s", ["still level in its cell", "rms speed / sqrt(gH)", "at the end", "volume"], rows)
