"""How a command ends before its time: an error a user sees (a sentence that says where, what was found and what to
do), or a signal."""

import difflib
import signal


class UserError(Exception):
    """Something the user can mend; shown without a traceback."""


ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)  # by which shells, batch systems and `timeout` end a program


class Ended(KeyboardInterrupt):
    """The user or the machine asked us to end (SIGINT, SIGTERM, SIGHUP): whoever runs a job ends it first."""

    def __init__(self, signal_number):
        super().__init__(signal_number)
        self.status = 128 + signal_number
        self.name = signal.Signals(signal_number).name


def end_on_signals():
    """Lets these signals reach the program as Ended."""
    def end(number, _):
        raise Ended(number)

    for number in ENDING:
        if signal.getsignal(number) is not signal.SIG_IGN:  # nohup
            signal.signal(number, end)


def nearest(word, known):
    """The known name closest to `word`, or None when nothing is close."""
    found = difflib.get_close_matches(word, list(known), n=1, cutoff=0.4)
    return found[0] if found else None


def unknown(kind, word, known):
    """UserError for a name nobody knows, with the nearest known one and the list."""
    known = sorted(known)
    guess = nearest(word, known)
    hint = f" Did you mean '{guess}'?" if guess else ""
    return UserError(f"unknown {kind} '{word}'.{hint} Known: {', '.join(known) if known else '(none)'}.")
