"""Reflection of a packet of waves from a damping zone of two wavelengths before a wall, and before an outflow."""

import numpy as np

WAVE, GRAVITY, LEVEL = 0.5, 9.81, 0.3
OMEGA = np.sqrt(GRAVITY * 2 * np.pi / WAVE)
GROUP = 0.5 * OMEGA * WAVE / (2 * np.pi)
WALLS = [f"fv.blocks[0].faces.{side}={{condition: slip}}" for side in ("x_lower", "x_upper")]


def check(case):
    for name, stream, closed in (("into a wall", 0.0, WALLS), ("with a stream of 0.2 m/s into an outflow", 0.2, [])):
        run = case.run(case.folder / "scene", solver="fv", name=name.replace(" ", "_"),
                       set=[f"scene.constants.stream={stream}", *closed])
        g = run.fv.gauges
        t, eta = g["time"], g["gauge.elevation"] - LEVEL
        # the packet's tail, three widths behind its middle, is by the gauge
        passed = (5.0 - 2.5 + 2.25) * WAVE / (GROUP + stream)
        before, after = np.abs(eta[t < passed]).max(), np.abs(eta[t > passed]).max()
        volume = run.fv.scalars["water_volume"]
        case.metric(f"{name}: elevation of the packet at the gauge over that at its start", before / (0.01 * WAVE))
        case.metric(f"{name}: elevation that comes back over that of the packet", after / before, below=0.05)
        case.metric(f"{name}: volume's change", volume[-1] / volume[0] - 1)
