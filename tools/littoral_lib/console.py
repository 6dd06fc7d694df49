"""The screen while a job runs: one line a program, rewritten in place on a terminal."""

import re
import shutil
import sys
import time

from .launch import OPEN_MPI_OWN

PLAIN_INTERVAL = 10.0  # [s] between two lines of a program where the output is no terminal


class Console:
    """Takes the job's lines; keeps the newest of each program in view and lets warnings stand."""

    def __init__(self, programs, log_path, quiet=False, stream=sys.stderr):
        self.programs = list(programs)
        self.stream = stream
        self.quiet = quiet
        self.live = stream.isatty() and not quiet
        self.latest = {}
        self.shown = {}
        self.drawn = 0
        self.log = open(log_path, "w", encoding="utf-8")

    def line(self, text):
        self._keep(text)
        match = re.match(r"\W*(sph|fv)(_solver)?\b", text)
        program = match.group(1) if match else None
        if OPEN_MPI_OWN.match(text):
            return
        if re.search(r"\b(warn(ing)?|error)\b", text, re.IGNORECASE):
            self._stand(text)
        elif program in self.programs:
            self.latest[program] = text
            self._refresh(program)

    def _keep(self, text):
        try:
            self.log.write(text + "\n")
            self.log.flush()
        except OSError:  # disk full: the job will say so itself; its screen must go on
            pass

    def _stand(self, text):
        if self.quiet:
            return
        self._erase()
        print(text, file=self.stream)
        self._draw()

    def _refresh(self, program):
        if self.live:
            self._erase()
            self._draw()
        elif not self.quiet and time.monotonic() - self.shown.get(program, -1e9) > PLAIN_INTERVAL:
            self.shown[program] = time.monotonic()
            print(self.latest[program], file=self.stream, flush=True)

    def _erase(self):
        if self.live and self.drawn:
            self.stream.write(f"\x1b[{self.drawn}A\x1b[J")
            self.drawn = 0

    def _draw(self):
        if not self.live:
            return
        width = shutil.get_terminal_size().columns - 1
        for program in self.programs:
            if program in self.latest:
                self.stream.write(self.latest[program][:width] + "\n")
                self.drawn += 1
        self.stream.flush()

    def close(self):
        try:
            self.log.close()
        except OSError:
            pass
