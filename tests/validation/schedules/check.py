"""All four schedules on the standing wave at M = 1, 2, 5 and 10: which one is the default, and where the others fail.

`serial` and `concurrent` extrapolate the donors; where that feeds the gravest acoustic mode of the column, the noise
grows (above 1). Only the default and `iterated` are gated; the others are recorded, failures included.
"""

from lib import wave

PERIODS = 3


def check(case):
    rows = []
    for schedule in ("serial", "predicted", "iterated", "concurrent"):
        for substeps in (1, 2, 5, 10):
            run = case.run("configs/standing_wave", name=f"{schedule}_m{substeps}", may_fail=True,
                           set=["scene.constants.n=25", f"scene.coupling.schedule={schedule}",
                                f"scene.coupling.substeps={substeps}", f"scene.time.end={PERIODS * 3.5515}"])
            if run.status != 0:
                rows.append([schedule, substeps, "failed", "", "", "", "", run.seconds])
                if schedule in ("predicted", "iterated"):
                    case.holds(f"{schedule} M={substeps} runs to its end", False)
                continue
            w = wave.measure(run)
            rows.append([schedule, substeps, w.elevation_error, w.energy_error, w.kept, w.noise, w.noise_growth,
                         run.seconds])
            if schedule in ("predicted", "iterated"):
                case.metric(f"{schedule} M={substeps}: noise growth", w.noise_growth, below=1.5)
                case.metric(f"{schedule} M={substeps}: elevation error", w.elevation_error, below=0.15)
    case.table("Schedules", ["schedule", "M", "elevation error", "energy error", "energy kept", "pressure noise",
                             "noise growth", "wall s"], rows)
