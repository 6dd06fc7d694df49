"""sum V W of the particles on a grid: 1 in the water, 0 in the air, 1/2 on the surface."""

import numpy as np

MARGIN = 1.25  # kernel radii of air around the water


class Grid:
    """values[i, k] or values[i, j, k] at origin + index * step."""

    def __init__(self, origin, step, values):
        self.origin, self.step, self.values = origin, step, values


def kernel(r, radius, dimension):
    """Wendland C2 of compact radius R."""
    s = np.clip(r / radius, 0.0, 1.0)
    norm = 7 / (np.pi * radius**2) if dimension == 2 else 21 / (2 * np.pi * radius**3)
    return norm * (1 - s) ** 4 * (1 + 4 * s)


def plane(points, volume, radius, step, anchor=None):
    """Of the particles (n, 2); grid points lie whole steps from the anchor."""
    return _on_grid(np.asarray(points), np.asarray(volume), radius, step, anchor)


def space(points, volume, radius, step, anchor=None):
    """Of the particles (n, 3); as plane()."""
    return _on_grid(np.asarray(points), np.asarray(volume), radius, step, anchor)


def _on_grid(points, volume, radius, step, anchor):
    """Adds each particle to the grid points within its kernel: one pass for every offset from its own point."""
    dimension = points.shape[1]
    margin = MARGIN * radius
    origin = points.min(axis=0) - margin
    if anchor is not None:
        origin = anchor + step * np.floor((origin - anchor) / step)
    shape = np.ceil((points.max(axis=0) + margin - origin) / step).astype(int) + 1
    values = np.zeros(shape)
    home = np.rint((points - origin) / step).astype(int)
    away = points - origin - home * step
    reach = int(np.ceil(radius / step)) + 1
    strides = np.array([int(np.prod(shape[d + 1:])) for d in range(dimension)])
    flat, place = values.reshape(-1), home @ strides
    for offset in np.ndindex(*[2 * reach + 1] * dimension):
        offset = np.array(offset) - reach
        if np.linalg.norm(offset) > reach + np.sqrt(dimension) / 2:
            continue
        r = np.sqrt(((offset * step - away) ** 2).sum(axis=1))
        flat += np.bincount(place + offset @ strides, volume * kernel(r, radius, dimension), minlength=flat.size)
    return Grid(origin, step, values)
