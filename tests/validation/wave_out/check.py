"""Reflection of a packet of waves from a damping zone of two wavelengths."""

import numpy as np

WAVE, GRAVITY = 0.5, 9.81
OMEGA = np.sqrt(GRAVITY * 2 * np.pi / WAVE)
GROUP = 0.5 * OMEGA * WAVE / (2 * np.pi)
PASSED = (5.0 - 2.5 + 2.25) * WAVE / GROUP  # the packet's tail, three widths behind its middle, is by the gauge


def check(case):
    run = case.run(case.folder / "scene", solver="fv")
    g = run.fv.gauges
    t, eta = g["time"], g["gauge.elevation"]
    before, after = np.abs(eta[t < PASSED]).max(), np.abs(eta[t > PASSED]).max()
    volume = run.fv.scalars["water_volume"]
    case.metric("elevation of the packet at the gauge over that at its start", before / (0.01 * WAVE))
    case.metric("elevation that comes back over that of the packet", after / before, below=0.05)
    case.metric("volume's change", volume[-1] / volume[0] - 1)
