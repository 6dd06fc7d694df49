"""Drag of a cylinder without friction under the surface of a stream, against Havelock's wave drag."""

import numpy as np
from littoral_lib import exact

DIAMETER, SPEED, FROUDE = 1.0, 1.0, 1.5  # Fr = U/sqrt(g d); density 1
GRAVITY = (SPEED / FROUDE) ** 2 / DIAMETER
UNDER = 3.5                              # top of the cylinder under the still level
DEPTH = 9.0
RAMP = 20.0                              # [d/U] until the stream has its speed
STANDING = 8 * np.pi * SPEED / GRAVITY   # [d/U] period of the waves whose energy stays beside the cylinder: the start's, which
                                         # fade slowly; means are over one of them


def check(case):
    def run(name, end, ramp, extra=()):
        done = case.run(case.folder.parent / "submerged_cylinder_fv" / "scene", solver="fv", name=name, set=[
            "scene.constants.n=12", f"scene.constants.h={UNDER}", f"scene.constants.Fr={FROUDE}", f"scene.constants.H={DEPTH}",
            "scene.fluid.viscosity=0",
            "fv.rings[0].inner.condition=slip", "fv.time.dt=0.6/n", "fv.dual_time.kappa=0.25",
            f"scene.constants.ramp={ramp}", f"scene.time.end={end}", f"scene.time.field_interval={end}", *extra])
        return done, done.fv.gauges["time"], 2 * done.fv.gauges["cylinder.dynamic_fx"] / (SPEED**2 * DIAMETER)

    depth = UNDER + DIAMETER / 2
    theory = exact.havelock_drag(DIAMETER / 2, depth, SPEED, GRAVITY) / (0.5 * SPEED**2 * DIAMETER)
    done, t, drag = run("surface", RAMP + 3 * STANDING, RAMP)
    last = t > t[-1] - STANDING
    # what the scheme's own dissipation costs: the same grid, full of water under a lid, where drag is 0
    _, t_lid, lid = run("lid", 7, 5, ["scene.initial.surface=-1", "fv.sponges=[]",
                                       "fv.gauges=[{name: cylinder, kind: force, wall: cylinder}]"])
    spurious = lid[t_lid > 6].mean()
    snapshot = done.fv.snapshots[-1]
    x, eta, status = snapshot.points[:, 0], snapshot["elevation"], snapshot["status"]
    length = 2 * np.pi * SPEED**2 / GRAVITY
    train = np.isfinite(eta) & (x > 4) & (x < 4 + length) & (status != 1)
    amplitude = 0.5 * (eta[train].max() - eta[train].min())
    linear = exact.havelock_wave(DIAMETER / 2, depth, SPEED, GRAVITY)
    case.metric("C_D of Havelock's wave drag", theory)
    case.metric("C_D over that", drag[last].mean() / theory, between=(1 / 1.3, 1.3))
    case.metric("C_D less the spurious one over that", (drag[last].mean() - spurious) / theory, between=(1 / 1.3, 1.3))
    case.metric("spurious C_D under a lid over that", spurious / theory)
    case.metric("amplitude of the first wave over the linear one", amplitude / linear)
    case.metric("spread of C_D over the mean's time", np.ptp(drag[last]) / theory)
    volume = done.fv.scalars["water_volume"]
    case.metric("volume's change", volume[-1] / volume[0] - 1)
