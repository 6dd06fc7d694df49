"""precision: mixed and time.integrator: midpoint beside the defaults, on the scenes of three cases of exact solutions."""

import cmath
import math

import numpy as np
from littoral_lib.compare import StandingWaveRun

CHOICES = {"double, rk4": [], "mixed, rk4": ["sph.precision=mixed"],
           "double, midpoint": ["sph.time.integrator=midpoint"],
           "mixed, midpoint": ["sph.precision=mixed", "sph.time.integrator=midpoint"]}


def sound(run):
    """Loss of amplitude over one wavelength of 40 dx."""
    first, last = (np.mean(m["pressure"].ravel() * np.exp(-2j * math.pi * m.points[:, 0]))
                   for m in (run.sph.snapshots[0], run.sph.snapshots[-1]))
    return 1 - abs(last / first)


def sound_speed(run):
    first, last = (np.mean(m["pressure"].ravel() * np.exp(-2j * math.pi * m.points[:, 0]))
                   for m in (run.sph.snapshots[0], run.sph.snapshots[-1]))
    return -cmath.phase(last / first) / (2 * math.pi)


def vortices(run):
    """Error of E(1)."""
    energy = run.sph.scalars["kinetic_energy"]
    return energy[-1] / energy[0] / math.exp(-16 * math.pi**2 / 100) - 1


def wave_period(run):
    history = StandingWaveRun(run.out)
    return history.period() / history.wave.period - 1


def wave_energy(run):
    """Energy kept in an inviscid period, over the exact value, less one."""
    history = StandingWaveRun(run.out)
    return history.energy_kept() / history.wave.mode_energy_kept - 1


SCENES = [("acoustic_pulse", 40, [("sound, 40 dx: loss", sound), ("sound, 40 dx: speed", sound_speed)]),
          ("taylor_green_sph", 50, [("Taylor-Green, L/dx = 50: E(1)", vortices)]),
          ("standing_wave_sph", 25, [("wave, H/dx = 25: period", wave_period), ("wave, H/dx = 25: energy kept", wave_energy)])]


def check(case):
    rows = []
    for folder, n, measures in SCENES:
        errors = {}
        for choice, settings in CHOICES.items():
            run = case.run(case.folder.parent / folder / "scene", set=[f"scene.constants.n={n}", *settings],
                           name=f"{folder}_{choice.replace(', ', '_')}", solver="sph")
            errors[choice] = [measure(run) for _, measure in measures] + [run.seconds]
        for k, (name, _) in enumerate(measures):
            rows.append([name, *(errors[choice][k] for choice in CHOICES)])
            # rounding may not be seen beside what the method itself is off by
            off = abs(errors["double, rk4"][k])
            case.metric(f"{name}: mixed less double, of the error of double",
                        abs(errors["mixed, rk4"][k] - errors["double, rk4"][k]) / off, at_most=0.1)
            case.metric(f"{name}: midpoint less rk4, of the error of rk4",
                        (errors["double, midpoint"][k] - errors["double, rk4"][k]) / off)
        rows.append([f"{folder}: wall s", *(errors[choice][-1] for choice in CHOICES)])
    case.table("Errors against the exact solutions", ["", *CHOICES], rows)
