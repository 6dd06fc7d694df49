"""A program of a running job held up from outside, as by a busy or suspended machine."""

import os
import pathlib
import signal
import threading
import time


class Slowed:
    """Within this block a program's ranks run for a tenth of the time only: stopped, let go, stopped again.

    program  "sph" or "fv"; out: the run's folder, by which its processes are told from others
    for_seconds  of wall time from when the first one is seen; afterwards they run freely
    """

    def __init__(self, program, out, for_seconds, period=0.2):
        self.program, self.out = program, str(pathlib.Path(out).resolve())
        self.seconds, self.period = for_seconds, period
        self.stopped = 0.0  # [s] in all
        self.end = threading.Event()
        self.thread = threading.Thread(target=self._work, daemon=True)

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.end.set()
        self.thread.join()

    def _ranks(self):
        found = []
        for entry in pathlib.Path("/proc").iterdir():
            if not entry.name.isdigit():
                continue
            try:
                words = (entry / "cmdline").read_bytes().decode(errors="replace").split("\0")
            except OSError:
                continue
            if pathlib.Path(words[0]).name == f"{self.program}_solver" and self.out in words:
                found.append(int(entry.name))
        return found

    def _signal(self, ranks, number):
        for pid in ranks:
            try:
                os.kill(pid, number)
            except ProcessLookupError:
                pass

    def _work(self):
        first = None
        while not self.end.is_set():
            ranks = self._ranks()
            if not ranks:
                time.sleep(0.01)
                continue
            first = first or time.monotonic()
            if time.monotonic() - first > self.seconds:
                return
            begin = time.monotonic()
            self._signal(ranks, signal.SIGSTOP)
            self.end.wait(0.9 * self.period)
            self._signal(ranks, signal.SIGCONT)
            self.stopped += time.monotonic() - begin
            self.end.wait(0.1 * self.period)
