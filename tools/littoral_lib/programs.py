"""Where the programs are, and the environment they run in."""

import os
import pathlib
import shutil

from .errors import UserError
from .scene import ROOT

BUILDS = ("release", "portable", "debug")


def find(name, bin_dir=None):
    """Path of a program: --bin, LITTORAL_BIN, the build folders or where it was installed, then PATH."""
    named = bin_dir or os.environ.get("LITTORAL_BIN")
    folders = [pathlib.Path(named)] if named else own_folders(ROOT)
    for folder in folders:
        if os.access(folder / name, os.X_OK):
            return str((folder / name).absolute())
    on_path = None if named else shutil.which(name)
    if on_path:
        return on_path
    raise UserError(f"{name} not found in {', '.join(map(str, folders))}"
                    f"{'' if named else ' or on PATH'}. Build it: cmake --preset release && "
                    f"cmake --build build/release")


def own_folders(root):
    """Of a clone its build folders; of an installation (PREFIX/share/littoral) PREFIX/bin."""
    if (root / "CMakeLists.txt").is_file():
        return [root / "build" / build / "bin" for build in BUILDS]
    return [root.parents[1] / "bin"]


def environment(threads, ranks=1):
    """Environment of a job: polite waiting, and Open MPI's consent to run as root. A rank that waits for a message spins
    for it, hundreds of times a step: where all cores are taken it must let others have its core."""
    env = dict(os.environ, OMP_NUM_THREADS=str(threads), OMP_WAIT_POLICY="passive")
    if ranks > 1 and ranks * threads >= cores():
        env.setdefault("OMPI_MCA_mpi_yield_when_idle", "1")
    env.setdefault("OMP_PROC_BIND", "false")
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        env.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    return env


def cores():
    return len(os.sched_getaffinity(0))


def default_threads(ranks, concurrent):
    """Threads a rank. Programs that take turns may both use all cores; concurrent ones share them."""
    busy = sum(ranks) if concurrent else max(ranks)
    return max(1, cores() // max(1, busy))
