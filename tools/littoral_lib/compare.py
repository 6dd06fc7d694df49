"""A finished run against its exact solution, as the scene's reference.yaml names it."""

import pathlib

import numpy as np

from . import exact, signals, tables
from .collect import read_json
from .errors import UserError, unknown


class StandingWaveRun:
    """History of a standing wave: elevation at the antinode and energy, with the exact curves beside them."""

    def __init__(self, out):
        out = pathlib.Path(out)
        summary = read_json(out / "summary.json") or {}
        self.reference = summary.get("reference")
        if not self.reference:
            raise UserError(f"{out}: summary.json names no reference solution")
        if self.reference["solution"] != "standing_wave":
            raise unknown("reference solution", self.reference["solution"], ["standing_wave"])
        r = self.reference
        self.length = r["length"]
        self.wave = exact.StandingWave(r["amplitude"], r["wavenumber"], r["depth"], r["gravity"], r["viscosity"],
                                       r["density"])
        scalars = tables.read_csv(out / "scalars.csv")
        self.time, self.mass = scalars["time"], scalars["mass"]
        self.kinetic = scalars["kinetic_energy"]
        gauges = next((tables.read_csv(p) for p in (out / "sph" / "gauges.csv", out / "fv" / "gauges.csv")
                       if p.is_file() and any(n.startswith("antinode.") for n in tables.read_csv(p).names)), None)
        if gauges is None:
            raise UserError(f"{out}: no gauge 'antinode' in gauges.csv")
        column = next(n for n in gauges.names if n.startswith("antinode."))
        known = np.isfinite(gauges[column])
        self.gauge_time, self.elevation = gauges["time"][known], gauges[column][known]
        self.potential = scalars["potential_energy"] - self.rest(scalars["potential_energy"])
        self.energy = self.kinetic + self.potential

    def rest(self, potential):
        """Potential energy of the water at rest: what the measured elevation does not explain, meaned over a period.

        Of the thousand joules that the water's weight holds the wave has one. A settling of 1e-4 of the depth, as
        particles do when they leave their lattice, would hide it if the start were taken as the level for good.
        """
        eta = np.interp(self.time, self.gauge_time, self.elevation - self.level())
        raised = 0.25 * self.wave.rho * self.wave.g * self.length * eta**2
        return signals.moving_mean(self.time, potential - raised, self.wave.period0)

    def period(self):
        return signals.mean_period(self.gauge_time, self.elevation - self.level())

    def level(self):
        """Mean elevation: where the water settles (0 if it keeps its volume exactly)."""
        return 0.5 * (self.elevation.max() + self.elevation.min()) if len(self.elevation) < 3 else float(
            np.trapz(self.elevation, self.gauge_time) / (self.gauge_time[-1] - self.gauge_time[0]))

    def energy_kept(self):
        """Factor on the energy in one inviscid period, from the peaks of the kinetic energy (two a period)."""
        period = self.wave.period0
        times, values = signals.peaks(self.time, self.kinetic, 0.2 * period)
        return signals.kept_per(times, values, period)

    def periods(self):
        return (self.time[-1] - self.time[0]) / self.wave.period0

    def measures(self):
        """[(name, measured, exact, unit)] for the screen."""
        wave = self.wave
        return [("periods run", self.periods(), None, "inviscid periods"),
                ("period", self.period(), wave.period, "s"),
                ("energy kept a period", self.energy_kept(), wave.mode_energy_kept, "-"),
                ("largest elevation", self.elevation.max(),
                 wave.elevation(np.linspace(0, 0.5 * wave.period, 200)[1:]).max(), "m"),
                ("mass change", self.mass[-1] / self.mass[0] - 1, 0.0, "-")]


def table(measures):
    lines = [f"{'':<24}{'measured':>12}{'exact':>12}{'error':>10}"]
    for name, measured, right, unit in measures:
        if not np.isfinite(measured):
            lines.append(f"{name:<24}{'-':>12}{right:>12.5g}{'':>10}  {unit} (the run is too short)")
            continue
        error = "" if right is None else (f"{100 * (measured / right - 1):+.2f} %" if right else f"{measured:+.1e}")
        lines.append(f"{name:<24}{measured:>12.5g}{'' if right is None else format(right, '>12.5g'):>12}{error:>10}"
                     f"  {unit}")
    return "\n".join(lines)
