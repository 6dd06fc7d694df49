"""The one error a user sees: a sentence that says where, what was found and what to do."""

import difflib


class UserError(Exception):
    """Something the user can mend; shown without a traceback."""


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
