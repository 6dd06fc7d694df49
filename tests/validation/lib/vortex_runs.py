"""Runs of tests/validation/vortex_coupled/scene: coupled, or either solver alone; its constants as Python numbers."""

from lib import vortex

L, U, V = 1.0, 1.0, 1.0
HALF, START, NU = 3.0, -7.0, 1.0 / 200
BASE = 10  # spacings over the core's radius
EXACT = vortex.Taylor({"l": L, "U": U, "V": V, "nu": NU, "start": START})
# The centre of the vortex, whose radius is 1, before and behind the face that it crosses.
ENTRY, EXIT = (-HALF - 2.5, -HALF + 2.5), (HALF - 2.5, HALF + 2.5)
WHOLE = (ENTRY[0], EXIT[1])
ALONE = ["scene.coupling.kind=none", "scene.regions=[]"]
SQUARE = "scene.domain.upper=[start+5*l, 0, 5*l]"  # the stream carries the vortex round it
PERIOD_OF_SQUARE = 10.0


def coupled(case, name, n=BASE, ratio=1, settings=()):
    """ratio: of the cell's width over the particles' spacing."""
    cells = [f"fv.blocks[0].cells=[{round(18 * n / ratio)}, 1, {round(10 * n / ratio)}]"]
    run = case.run(scene(case), set=[f"scene.constants.n={n}", *cells, *settings], name=name)
    return vortex.History(run, EXACT, L / n, HALF, cell=ratio * L / n, fit=3 * ratio * L / n)


def cells_alone(case, name, dt, n=BASE):
    square = [SQUARE, "fv.blocks[0].upper=[start+5*l, 0, 5*l]", f"fv.blocks[0].cells=[{round(10 * n)}, 1, {round(10 * n)}]"]
    run = case.run(scene(case), set=[f"scene.constants.n={n:g}", *ALONE, *square, f"fv.time.dt={dt:.12g}"], name=name,
                   solver="fv")
    return vortex.History(run, EXACT, L / n, period=PERIOD_OF_SQUARE)


def particles_alone(case, name, n=BASE, settings=()):
    """From a relaxed distribution: a vortex strains the lattice of the start, which in the coupled run is gone."""
    run = case.run(scene(case), set=[f"scene.constants.n={n}", *ALONE, SQUARE, "sph.initial_distribution=relaxed", *settings],
                   name=name, solver="sph")
    return vortex.History(run, EXACT, L / n, period=PERIOD_OF_SQUARE)


def scene(case):
    return case.folder.parent / "vortex_coupled" / "scene"
