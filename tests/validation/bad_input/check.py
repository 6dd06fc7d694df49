"""What users get wrong. Each must end by itself, with a status other than 0 and a message that names the cause."""

import os
import re
import shutil
import subprocess

SECONDS = 20.0  # two programs start, read and compare in about one; the rest is a slow machine's

# name: (settings, what the message must contain)
SETTINGS = {
    "misspelt key of the scene": (["scene.fluid.densty=1000"],
                                  r"unknown key 'fluid\.densty'\. Did you mean 'fluid\.density'\?"),
    "misspelt key of the particles": (["sph.spacng=0.04"], r"unknown key 'spacng'\. Did you mean 'spacing'\?"),
    "misspelt key of the grid": (["fv.dual_time.drp=0.1"],
                                 r"unknown key 'dual_time\.drp'\. Did you mean 'dual_time\.drop'\?"),
    "mistakes in both files": (["scene.fluid.densty=1000", "sph.spacng=0.04"],
                               r"(?=.*unknown key 'fluid\.densty')(?=.*unknown key 'spacng')"),
    "window longer than the run": (["scene.coupling.dt=50"], r"coupling\.dt.* 50 s is longer than the whole run"),
    "gauge outside the domain": (["sph.gauges[0].position=[-3, 0, 0]"],
                                 r"gauge 'antinode': x = -3 m is outside the domain"),
    "negative spacing": (["sph.spacing=-0.04"], "spacing.*-0.04"),
    "wrong type": (["scene.time.end=long"], "time.end.*long"),
    "bad formula": (["scene.initial.u=cso(x)"], "cso"),
    "region outside the domain": (["scene.regions[0].lower=[0, 0, -3]"], "region.*outside|outside.*domain"),
    "region outside the grid": (["fv.blocks[0].upper=[L, 0, -0.6]", "fv.blocks[0].cells=[50, 1, 10]"],
                                "grid|donor|cover|block"),
    "grid that ends short of the domain": (["fv.blocks[0].lower=[0, 0, -0.9]"],
                                           r"the domain begins at z = -1 m, the grid at -0\.9 m"),
    "fringe of one cell": (["scene.coupling.fringe_layers=1"], r"fringe_layers.*is 1; expected a value >= 2"),
    "formula that loses its value": (["fv.blocks[0].faces.z_lower.condition=wall",
                                      "fv.blocks[0].faces.z_lower.u=0*sqrt(0.05-t)"],
                                     r"z_lower', u: the formula '0\*sqrt\(0\.05-t\)' is .*nan at .* t = 0\.05"),
    "region thinner than its layers": (["scene.regions[0].lower=[0, 0, 0.1]"], "thin|layers"),
    "no particles": (["scene.initial.surface=z + 2"], "particle|dry|water"),
    "fields that are no numbers": (["scene.initial.p=1/0"], "finite|nan|NaN|inf|number"),
}
# the same of a scene whose grid holds the surface
SURFACE_SETTINGS = {
    "gauge of elevation beside the grid": (["fv.gauges[0].at=[5, 0, 0]"], "gauge 'antinode'.*meets no block"),
    "gauge of elevation without a surface": (["scene.initial.surface=z-10"], "gauge 'antinode'.*elevation"),
    "band of no cells": (["fv.level_set.layers=0"], "level_set.layers.*0"),
    "velocity continued less far than the band": (["fv.level_set.extension_layers=2"], "extension_layers"),
    "misspelt correction": (["fv.level_set.volume_correction=locl"], "locl.*Did you mean 'local'"),
    "surface that loses its value": (["scene.initial.surface=sqrt(x-0.5)"], "initial.surface.*nan"),
}


def judge(case, name, status, text, seconds, pattern):
    case.metric(f"{name}: seconds", seconds, below=SECONDS, unit="s")
    case.holds(f"{name}: status is not 0", status not in (0, 124))
    case.holds(f"{name}: says why", re.search(pattern, text, re.IGNORECASE | re.DOTALL) is not None)


def copy(case, scene, name):
    folder = case.out / "scenes" / name
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(case.folder.parents[2] / "configs" / scene, folder)
    return folder


def check(case):
    base = ["scene.constants.n=25", "scene.time.end=0.1"]
    for name, (settings, pattern) in SETTINGS.items():
        run = case.run("configs/standing_wave", name=re.sub(r"\W", "_", name), set=base + settings, may_fail=True)
        judge(case, name, run.status, run.screen, run.seconds, pattern)

    for name, (settings, pattern) in SURFACE_SETTINGS.items():
        run = case.run("configs/wave_tank", solver="fv", name=re.sub(r"\W", "_", name), set=["scene.constants.n=32", *settings], may_fail=True)
        judge(case, name, run.status, run.screen, run.seconds, pattern)

    # a missing file
    folder = copy(case, "standing_wave", "missing")
    (folder / "fv.yaml").write_text("scene: nowhere.yaml\n")
    run = case.run(folder, name="missing_file", may_fail=True)
    judge(case, "missing file", run.status, run.screen, run.seconds, "nowhere.yaml")

    # a partner that read another scene
    folder = copy(case, "standing_wave", "gravity")
    other = (folder / "scene.yaml").read_text().replace("gravity: [0, 0, -g]", "gravity: [0, 0, -2*g]")
    (folder / "other.yaml").write_text(other)
    (folder / "fv.yaml").write_text((folder / "fv.yaml").read_text().replace("scene.yaml", "other.yaml"))
    run = case.run(folder, name="other_gravity", set=base, may_fail=True)
    judge(case, "partner with another gravity", run.status, run.screen, run.seconds, r"gravity.*-1.*-2|gravity.*-2.*-1")
    problems, _ = case.check(folder, base)
    case.holds("partner with another gravity: littoral check finds it", any("gravity" in p for p in problems))

    full_disk(case)

    # a checkpoint of another scene
    short = ["scene.constants.n=25", "scene.time.end=0.05", "scene.time.checkpoint_interval=0.02"]
    first = case.run("configs/standing_wave", name="checkpointed", set=short)
    run = case.run("configs/standing_wave", name="restart_of_another", may_fail=True, restart="latest",
                   restart_from=first, set=short + ["scene.fluid.viscosity=0.01", "scene.time.end=0.1"])
    judge(case, "restart from another scene", run.status, run.screen, run.seconds, "scene|checkpoint")


def full_disk(case):
    """Results on a file system of 200 kB; needs the right to mount one (root), otherwise left out with a note."""
    if os.geteuid() != 0:
        case.metric("disk full: not tried, needs root", 0)
        return
    out = case.out / "full"
    subprocess.run(["umount", out], capture_output=True, check=False)
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=200k", "tmpfs", out], capture_output=True,
                      check=False).returncode != 0:
        case.metric("disk full: not tried, mounting was refused", 0)
        return
    try:
        run = case.run("configs/standing_wave", name="full", keep=True, may_fail=True,
                       set=["scene.constants.n=25", "scene.time.end=0.5", "scene.time.field_interval=0.01"])
        text, status, seconds = "\n".join(run.summary["lines"]), run.status, run.seconds
    finally:
        subprocess.run(["umount", out], check=False)
    judge(case, "disk full", status, text, seconds, "no space|disk|full")
