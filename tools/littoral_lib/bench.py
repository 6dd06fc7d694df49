"""littoral bench: runs the benchmark programs and prints their tables."""

import pathlib
import subprocess

from . import launch, programs, scaling
from .errors import UserError, unknown
from .scene import ROOT

# name: arguments of each program of its job, one rank each
KNOWN = {"coupler": (["sph"], ["fv"]), "sph": ([],), "fv": ([],)}
SCALING = ("sph_scaling", "fv_scaling")


def command(args):
    names = args.names or list(KNOWN)
    for name in names:
        if name not in KNOWN and name not in SCALING:
            raise unknown("benchmark", name, [*KNOWN, *SCALING])
    status = 0
    for name in names:
        if name in SCALING:
            status = status or scaling.command(args, name.removesuffix("_scaling"))
            continue
        try:
            program = programs.find(f"{name}_bench", args.bin)
        except UserError:
            if args.names:
                raise
            print(f"{name}_bench: not built")
            continue
        line = ["mpirun"] + (["--bind-to", "none", "--oversubscribe"] if launch.is_open_mpi() else [])
        for index, arguments in enumerate(KNOWN[name]):
            line += ([":"] if index else []) + ["-n", "1", program, *arguments]
        print("$", " ".join(line), flush=True)
        folder = pathlib.Path(args.out or ROOT / "out" / "bench" / name)
        folder.mkdir(parents=True, exist_ok=True)
        done = subprocess.run(line, env=programs.environment(args.threads or 1), cwd=folder, check=False)
        status = status or done.returncode
    return status
