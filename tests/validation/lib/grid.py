"""Fields of a structured block at the last output, as arrays indexed like the grid."""

import numpy as np


class Planar:
    """One planar block: x, z of the cell centres and u, w, p, each (nk, ni)."""

    def __init__(self, snapshot):
        piece = snapshot.pieces[0]
        nk, _, ni = piece.nodes
        shape = (nk - 1, ni - 1)
        centres = piece.centres()
        velocity = piece.field("velocity")
        self.x, self.z = centres[:, 0].reshape(shape), centres[:, 2].reshape(shape)
        self.u, self.w = velocity[:, 0].reshape(shape), velocity[:, 2].reshape(shape)
        self.p = piece.field("pressure").reshape(shape)


def middle(values, axis):
    """Values on the line halfway through the block: the mean of the two lines beside it, or the middle one."""
    n = values.shape[axis]
    return 0.5 * (np.take(values, (n - 1) // 2, axis) + np.take(values, n // 2, axis))


def extremum(position, values, sign):
    """(value, position) of the largest sign*value, by a parabola through three points."""
    i = int(np.clip(np.argmax(sign * values), 1, len(values) - 2))
    a, b, c = np.polyfit(position[i - 1:i + 2] - position[i], values[i - 1:i + 2], 2)
    return c - b * b / (4 * a), position[i] - b / (2 * a)


def order(errors, ratio=2.0):
    """Orders between neighbouring levels, coarse to fine."""
    return [float(np.log(a / b) / np.log(ratio)) for a, b in zip(errors, errors[1:])]
