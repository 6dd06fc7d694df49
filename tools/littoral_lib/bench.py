"""littoral bench: runs the benchmark programs and prints their tables."""

import pathlib
import subprocess

from . import launch, programs
from .errors import UserError, unknown
from .scene import ROOT

KNOWN = {"coupler": 2, "sph": 1, "fv": 1}  # name: ranks of its job


def command(args):
    names = args.names or list(KNOWN)
    for name in names:
        if name not in KNOWN:
            raise unknown("benchmark", name, KNOWN)
    status = 0
    for name in names:
        try:
            program = programs.find(f"{name}_bench", args.bin)
        except UserError:
            if args.names:
                raise
            print(f"{name}_bench: not built")
            continue
        line = ["mpirun"] + (["--bind-to", "none", "--oversubscribe"] if launch.is_open_mpi() else [])
        line += ["-n", str(KNOWN[name]), program]
        print("$", " ".join(line), flush=True)
        folder = pathlib.Path(args.out or ROOT / "out" / "bench" / name)
        folder.mkdir(parents=True, exist_ok=True)
        done = subprocess.run(line, env=programs.environment(args.threads or 1), cwd=folder, check=False)
        status = status or done.returncode
    return status
