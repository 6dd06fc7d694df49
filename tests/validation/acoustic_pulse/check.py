"""Speed and loss of a travelling sound wave over one wavelength, with every reconstruction."""

import cmath
import math

import numpy as np


def travelled(case, n, reconstruction):
    """(loss of amplitude, error of speed) over one wavelength, from the first harmonic of the pressure."""
    run = case.run(case.folder / "scene", set=[f"scene.constants.n={n}", f"sph.reconstruction={reconstruction}"],
                   name=f"{reconstruction}_{n}", solver="sph")
    first, last = (harmonic(moment) for moment in (run.sph.snapshots[0], run.sph.snapshots[-1]))
    ratio = last / first
    return 1 - abs(ratio), -cmath.phase(ratio) / (2 * math.pi)


def harmonic(moment):
    return complex(np.mean(moment["pressure"].ravel() * np.exp(-2j * math.pi * moment.points[:, 0])))


def check(case):
    rows, loss = [], {}
    for reconstruction in ("unlimited", "van_leer", "minmod", "first_order"):
        for n in (20, 40, 80):
            loss[reconstruction, n], speed = travelled(case, n, reconstruction)
            rows.append([reconstruction, n, loss[reconstruction, n], speed])
            if reconstruction == "unlimited" and n == 40:
                case.metric("loss over a wavelength of 40dx", loss[reconstruction, n], below=0.05)
                case.metric("error of speed at 40dx", speed, between=(-0.01, 0.01))
    case.metric("order of the loss, unlimited", math.log2(loss["unlimited", 40] / loss["unlimited", 80]), at_least=1.5)
    case.metric("loss without reconstruction over loss with", loss["first_order", 40] / loss["unlimited", 40], above=4)
    case.table("Sound wave", ["reconstruction", "dx in a wavelength", "loss", "speed error"], rows)
