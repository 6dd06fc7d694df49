"""C12 against the exact viscous standing wave, at two resolutions; profiles across the interface."""

from lib import coupled, wave


def check(case):
    rows = []
    for n in (25, 50):
        run = case.run("configs/standing_wave", set=[f"scene.constants.n={n}"], name=f"n{n}")
        w = wave.measure(run)
        jump = coupled.jumps(run, below=2.0)
        rows.append([n, w.period_error, w.kept, w.mass_error, w.elevation_error, jump["p"], jump["u"], w.ledger,
                     run.seconds])
        case.metric(f"n={n}: period error", w.period_error, between=(-0.015, 0.015))
        # within 8% of the normal mode; at the coarser one, of the range down to the irrotational decay
        low = w.kept_high if n >= 50 else w.kept_low
        case.metric(f"n={n}: energy kept a period", w.kept, between=(0.92 * low, 1.08 * w.kept_high))
        case.metric(f"n={n}: mass error", w.mass_error, between=(-1e-3, 1e-3))
        case.metric(f"n={n}: ledger / mass", w.ledger, below=1e-11)
        # a kink is a difference between the two sides where both describe the same water
        case.metric(f"n={n}: pressure jump / (rho g a)", jump["p"], below=0.1)
        case.metric(f"n={n}: velocity jump / (a omega)", jump["u"], below=0.05)
    case.table("Standing wave", ["H/dx", "period error", "energy kept", "mass error", "elevation error", "p jump",
                                 "u jump", "ledger", "wall s"], rows)
