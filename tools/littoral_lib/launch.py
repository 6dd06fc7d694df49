"""The mpirun line of a job, and the job itself."""

import collections
import os
import re
import signal
import subprocess
import time

from . import programs
from .errors import ENDING, Ended
from .settings import route

OPEN_MPI_OWN = re.compile(r"\[[^\]\s]+:\d+\] ")  # "[node:pid] ...": what its parts say of themselves
GRACE = 5.0  # [s] a job may take to end after it was asked to, before it is killed


def mpi_line(scene, out, ranks, restart_files=None, extra=None, bin_dir=None):
    """Command of the job: one program, or an MPMD line with SPH first. `ranks` = {program: n}."""
    dealt = route(scene.settings, scene.programs)
    total = sum(ranks[p] for p in scene.programs)
    line = ["mpirun"]
    if is_open_mpi():
        line += ["--bind-to", "none"] + (["--oversubscribe"] if total > 1 else [])
    for index, program in enumerate(scene.programs):
        part = [":"] if index else []
        part += ["-n", str(ranks[program]), programs.find(f"{program}_solver", bin_dir),
                 "--config", str(scene.folder / f"{program}.yaml"), "--out", str(out)]
        for setting in dealt[program]:
            part += ["--set", setting]
        if restart_files:
            part += ["--restart", str(restart_files[program])]
        line += part + list((extra or {}).get(program, []))
    return line


def is_open_mpi():
    try:
        text = subprocess.run(["mpirun", "--version"], capture_output=True, text=True, check=False).stdout
    except FileNotFoundError:
        from .errors import UserError
        raise UserError("mpirun not found; run tools/setup, which installs Open MPI") from None
    return "Open MPI" in text or "OpenRTE" in text


Result = collections.namedtuple("Result", "status seconds lines interrupted")


def execute(line, env, on_line=None, timeout=None, cwd=None):
    """Runs a job; gives each line of its output to `on_line`. Signals (errors.Ended) and the timeout end all its processes.

    Returns status (0: success; 128 + signal; 124: timeout), wall seconds, the last lines, and the Ended or None.
    """
    begin = time.monotonic()
    last = collections.deque(maxlen=2000)
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, ENDING)  # nothing may come between the job and its try
    job = subprocess.Popen(line, env=env, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                           errors="replace", start_new_session=True, cwd=cwd,
                           preexec_fn=lambda: signal.pthread_sigmask(signal.SIG_SETMASK, mask))
    expired, interrupted = [], None
    timer = None
    if timeout:
        import threading
        timer = threading.Timer(timeout, lambda: (expired.append(True), end(job)))
        timer.daemon = True
        timer.start()
    try:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        for text in job.stdout:
            last.append(text.rstrip("\n"))
            if on_line:
                on_line(last[-1])
        status = job.wait()
    except Ended as signal_caught:
        interrupted = signal_caught
        end(job)
        status = signal_caught.status
    finally:
        if timer:
            timer.cancel()
    if expired:
        status = 124
    return Result(status, time.monotonic() - begin, list(last), interrupted)


def end(job):
    """Ends the job's process group: politely, then for good, with any child that stayed behind."""
    for kind in (signal.SIGINT, signal.SIGTERM):
        try:
            os.killpg(job.pid, kind)
            job.wait(timeout=GRACE)
            break
        except ProcessLookupError:
            break
        except subprocess.TimeoutExpired:
            continue
    try:
        os.killpg(job.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


def killed(lines, ranks):
    """Who was ended by a signal, as mpirun reports it: sentences. `ranks`: [(program, its number of ranks)] in order.

    A process that is killed (out of memory, a time limit, a crash) has no last words of its own.
    """
    text, found = " ".join(line.strip() for line in lines), []
    for rank, number, signal_name in re.findall(r"process rank (\d+) with PID \d+ on node \S+ exited on\s+signal (\d+)"
                                                r"(?: \(([^)]*)\))?", text):
        first = 0
        for program, count in ranks:
            if first <= int(rank) < first + count:
                found.append(f"{program}_solver (its rank {int(rank) - first}) was ended by signal {number}"
                             + (f" ({signal_name})" if signal_name else "")
                             + {"9": ": killed from outside; did the machine run out of memory?"}.get(number, ""))
            first += count
    return found


def own_words(lines):
    """The programs' own lines: without blank ones, mpirun's boxes between rows of dashes and Open MPI's own."""
    kept, in_box = [], False
    for text in lines:
        if re.fullmatch(r"-{20,}", text.strip()):
            in_box = not in_box
        elif not in_box and text.strip() and not OPEN_MPI_OWN.match(text):
            kept.append(text)
    return kept
