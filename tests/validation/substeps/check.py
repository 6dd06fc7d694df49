"""C16 on C12: the error must not grow by more than half from M = 1 to M = 10."""

from lib import wave

PERIODS = 5


def check(case):
    rows, first = [], None
    for substeps in (1, 2, 5, 10):
        run = case.run("configs/standing_wave", name=f"m{substeps}",
                       set=["scene.constants.n=25", f"scene.coupling.substeps={substeps}",
                            f"scene.time.end={PERIODS * 3.5515}"])
        w = wave.measure(run)
        first = first or w
        rows.append([substeps, w.elevation_error, w.energy_error, w.period_error, w.kept, w.noise_growth, run.seconds])
        if substeps > 1:
            case.metric(f"M={substeps}: elevation error over that of M=1", w.elevation_error / first.elevation_error,
                        below=1.5)
            case.metric(f"M={substeps}: energy error over that of M=1", w.energy_error / first.energy_error, below=1.5)
    case.table("Substeps", ["M", "elevation error", "energy error", "period error", "energy kept", "noise growth",
                            "wall s"], rows)
