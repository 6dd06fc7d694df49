"""What the particles of a snapshot form together: moments, and holes in the water (2-D)."""

import numpy as np
from littoral_lib import coverage


class Body:
    """Mass, momentum and shape of one snapshot that has the fields velocity, volume and density."""

    def __init__(self, snapshot):
        self.time = snapshot.time
        self.mass = snapshot["volume"] * snapshot["density"]
        self.volume = snapshot["volume"]
        self.x, self.u = snapshot.points, snapshot["velocity"]

    @property
    def momentum(self):
        """(x, z) [kg/s m]."""
        return (self.mass[:, None] * self.u).sum(axis=0)[[0, 2]]

    @property
    def angular_momentum(self):
        """About the origin, positive from z to x."""
        return (self.mass * (self.x[:, 2] * self.u[:, 0] - self.x[:, 0] * self.u[:, 2])).sum()

    def semi_axis(self, direction):
        """Of the ellipse with the same second moment: a^2/4 = mean of x^2."""
        return 2 * np.sqrt((self.mass * self.x[:, direction] ** 2).sum() / self.mass.sum())

    def area(self):
        return self.volume.sum()


def holes(snapshot, spacing, radius, level=0.5):
    """Areas [m^2] of the air enclosed by water, where sum V W is below `level`; largest first."""
    from scipy import ndimage
    grid = coverage.plane(snapshot.points[:, [0, 2]], snapshot["volume"], radius, 0.5 * spacing)
    air, count = ndimage.label(grid.values < level)
    outside = air[0, 0]
    sizes = ndimage.sum_labels(np.ones(air.shape), air, range(1, count + 1)) * (0.5 * spacing) ** 2
    return sorted((s for label, s in enumerate(sizes, 1) if label != outside), reverse=True)
