"""littoral bench sph_scaling: sph_solver on 1 to 4 ranks, and a model, from the messages measured, of many more.
fv_scaling: the same of fv_solver."""

import json
import os
import pathlib
import subprocess

from . import launch, programs
from .errors import UserError
from .scene import ROOT

BLOCKS = {"sph": 4, "fv": 2}  # of the strong table
REACH = 3.0     # of the halo in spacings: R = 2.7 dx and a skin of .3 dx (lists choose it, up to .4)
# A cluster to be assumed: a message's latency [s], a rank's share of the network [B/s], a sum over all ranks [s] per
# doubling of their number.
LATENCY, BANDWIDTH, HOP = 2e-6, 3e9, 2e-6
SPEED = 1.2e5   # particle-steps/s of a rank, if less was measured: fast computing is the harder case for messages
SUMS_A_STEP = 7  # one a stage (lists outdated?), two more before and after, two to agree on the step's length


def measure(program, folder, ranks, blocks, threads, solver="sph"):
    scene = ROOT / "tests" / "benchmarks" / f"{solver}_scaling" / f"{solver}.yaml"
    out = folder / f"ranks{ranks}_blocks{blocks}"
    line = ["mpirun"] + (["--bind-to", "none", "--oversubscribe"] if launch.is_open_mpi() else [])
    line += ["-n", str(ranks), program, "--config", str(scene), "--out", str(out), "--set", f"scene.constants.blocks={blocks}"]
    environment = programs.environment(threads, ranks)
    done = subprocess.run(line, env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise UserError(f"{solver}_solver failed:\n" + done.stdout + done.stderr)
    with open(out / solver / "summary.json", encoding="utf-8") as file:
        summary = json.load(file)
    return summary["results"], summary["wall_time"]


def table(title, rows):
    print(f"\n{title}\n\n| ranks | particles | particle-steps/s | of ideal | halo / owned | in the halo's exchange | kB a step and rank |")
    print("|---|---|---|---|---|---|---|")
    one = rows[0][1]["particle_steps_per_second"]
    for ranks, results, wall in rows:
        speed, steps = results["particle_steps_per_second"], results["steps"]
        owned = results.get("rank_particles_most", results["particles"])
        print(f"| {ranks} | {results['particles']:.0f} | {speed:.3g} | {speed / one / ranks:.0%} "
              f"| {results.get('halo_particles_most', 0) / owned:.2f} | {results.get('halo_seconds_most', 0) / wall:.0%} "
              f"| {results.get('halo_bytes_most', 0) / steps / 1e3:.0f} |")


def step_seconds(particles, ranks, speed, bytes_a_copy, refreshes):
    """Wall time of a step of a rank amid others, the water being a cube of cubes."""
    side = particles ** (1 / 3)
    copies = (side + 2 * REACH) ** 3 - side ** 3
    compute = particles / speed
    halo = refreshes * 26 * LATENCY + copies * bytes_a_copy / BANDWIDTH
    sums = SUMS_A_STEP * HOP * (ranks - 1).bit_length()
    return compute, halo, sums, copies


def model(results, one):
    """From a run on several ranks: bytes a copy and step, refreshes a step; from one rank: the speed of computing.
    Ranks are taken to be equally loaded, and nothing of a message to hide behind computing."""
    speed = max(SPEED, one["particle_steps_per_second"])
    refreshes = results["halo_refreshes"] / results["steps"]
    bytes_a_copy = results["halo_bytes_most"] / results["steps"] / results["halo_particles_most"]
    print(f"\nModel: {bytes_a_copy:.0f} B a copy and step in {refreshes:.1f} refreshes (measured); "
          f"assumed: {speed:.3g} particle-steps/s a rank, 26 neighbours, {LATENCY * 1e6:.0f} us a message, {BANDWIDTH / 1e9:.0f} GB/s a rank, {SUMS_A_STEP} sums a step of "
          f"{HOP * 1e6:.0f} us a doubling\n")
    print("| ranks | particles a rank | copies / owned | compute ms | halo ms | sums ms | efficiency |")
    print("|---|---|---|---|---|---|---|")
    for ranks in (8, 100, 1000, 10000):
        for particles in (1e4, 1e5, 1e6):
            compute, halo, sums, copies = step_seconds(particles, ranks, speed, bytes_a_copy, refreshes)
            print(f"| {ranks} | {particles:.0e} | {copies / particles:.2f} | {compute * 1e3:.1f} | {halo * 1e3:.2f} | {sums * 1e3:.2f} "
                  f"| {compute / (compute + halo + sums):.1%} |")


def fv_table(title, rows, weak):
    print(f"\n{title}\n\n| ranks | cells | cycles a step | us a cell and step | s a step | of ideal |")
    print("|---|---|---|---|---|---|")
    first = None
    for ranks, results, _ in rows:
        step = results["microseconds_per_cell_and_step"] * results["cells"] * 1e-6
        first = first or step
        print(f"| {ranks} | {results['cells']:.0f} | {results['inner_cycles_per_step']:.1f} "
              f"| {results['microseconds_per_cell_and_step']:.2f} | {step:.2f} "
              f"| {first / step if weak else first / step / ranks:.0%} |")


def fv_model(results, one):
    """From the run on two ranks, which meet at two faces of a cube's side: messages a neighbour, bytes a face cell, sums a
    step; from one rank the speed of computing. Ranks are cubes of cells, equally loaded, nothing hidden behind computing."""
    steps, side = results["steps"], (results["cells"] / 2) ** (1 / 3)
    messages, sums = results["halo_messages_most"] / steps, results["sums_over_ranks"] / steps
    bytes_a_face_cell = results["halo_bytes_most"] / steps / (2 * side ** 2)
    compute_one = one["microseconds_per_cell_and_step"] * 1e-6
    print(f"\nModel: {messages:.0f} messages a neighbour, {bytes_a_face_cell:.0f} B a face cell, {sums:.0f} sums a step (measured, all levels); "
          f"{compute_one * 1e6:.2f} us a cell and step; assumed: 26 neighbours, {LATENCY * 1e6:.0f} us a message, {BANDWIDTH / 1e9:.0f} GB/s a rank, "
          f"{HOP * 1e6:.0f} us a sum and doubling\n")
    print("| ranks | cells a rank | compute ms | halo ms | sums ms | efficiency |")
    print("|---|---|---|---|---|---|")
    for ranks in (8, 100, 1000, 10000):
        for cells in (1e4, 1e5, 1e6):
            compute = cells * compute_one
            halo = 26 * messages * LATENCY + 6 * cells ** (2 / 3) * bytes_a_face_cell / BANDWIDTH
            agree = sums * HOP * (ranks - 1).bit_length()
            print(f"| {ranks} | {cells:.0e} | {compute * 1e3:.0f} | {halo * 1e3:.1f} | {agree * 1e3:.2f} "
                  f"| {compute / (compute + halo + agree):.1%} |")


def command(args, solver="sph"):
    program = programs.find(f"{solver}_solver", args.bin)
    folder = pathlib.Path(args.out or ROOT / "out" / "bench" / f"{solver}_scaling")
    threads = args.threads or 1
    cores = os.cpu_count() or 1
    print(f"{cores} cores, {threads} thread(s) a rank; ranks beyond the cores share them and show correctness only")
    blocks = BLOCKS[solver]
    strong = [(ranks, *measure(program, folder, ranks, blocks, threads, solver)) for ranks in (1, 2, 3, 4)]
    weak = [(ranks, *measure(program, folder, ranks, ranks, threads, solver)) for ranks in (1, 2, 3, 4)]
    if solver == "fv":
        fv_table("Strong: the same water", strong, weak=False)
        fv_table("Weak: a block a rank", weak, weak=True)
        fv_model(strong[1][1], strong[0][1])
        return 0
    table("Strong: the same water", strong)
    table("Weak: a block a rank", weak)
    model(strong[1][1], strong[0][1])
    return 0
