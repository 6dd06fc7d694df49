"""Reads the programs' XDMF + HDF5 series: what ParaView sees, as numpy arrays."""

import pathlib
import xml.etree.ElementTree as xml

import numpy as np

from .errors import UserError


class Snapshot:
    """One moment of a series: a list of pieces (the particles, or one grid block each)."""

    def __init__(self, time, pieces):
        self.time = time
        self.pieces = pieces

    def __getitem__(self, name):
        """A field of all pieces in one array: (n,) or (n, 3)."""
        return np.concatenate([piece.field(name) for piece in self.pieces])

    @property
    def points(self):
        """Particle positions, or cell centres: (n, 3)."""
        return np.concatenate([piece.centres() for piece in self.pieces])

    @property
    def names(self):
        return sorted(self.pieces[0].fields)


class Piece:
    """Points with fields, or a structured block with cell fields; read when asked for."""

    def __init__(self, folder, grid):
        self.folder = folder
        self.name = grid.get("Name", "")
        topology = grid.find("Topology")
        self.geometry = grid.find("Geometry").find("DataItem")
        dims = topology.get("Dimensions") or topology.get("NumberOfElements") or ""
        self.structured = "SMesh" in topology.get("TopologyType", topology.get("Type", ""))
        self.nodes = tuple(int(d) for d in dims.split()) if self.structured else None  # (nk, nj, ni)
        self.fields = {a.get("Name"): a.find("DataItem") for a in grid.findall("Attribute")}

    def _read(self, item):
        import h5py
        text = item.text.strip()
        if item.get("Format", "XML") == "XML":
            return np.array([float(v) for v in text.split()])
        file, _, dataset = text.partition(":")
        with h5py.File(self.folder / file, "r") as h5:
            return h5[dataset][...]

    def coordinates(self):
        """Particle or node coordinates, (n, 3)."""
        return np.asarray(self._read(self.geometry)).reshape(-1, 3)

    def centres(self):
        points = self.coordinates()
        if not self.structured:
            return points
        grid = points.reshape(*self.nodes, 3)
        for axis in range(3):
            if grid.shape[axis] > 1:
                grid = 0.5 * (np.take(grid, range(1, grid.shape[axis]), axis) +
                              np.take(grid, range(grid.shape[axis] - 1), axis))
        return grid.reshape(-1, 3)

    def field(self, name):
        if name not in self.fields:
            from .errors import unknown
            raise unknown(f"field of {self.name}:", name, self.fields)
        values = np.asarray(self._read(self.fields[name]))
        n = len(self.centres())
        if n == 0:  # a region that has run dry
            return values.reshape(0, values.shape[-1]) if values.ndim > 1 else values
        return values.reshape(n) if values.size == n else values.reshape(n, -1)


def open_series(path):
    """Snapshots of an XDMF file, oldest first."""
    path = pathlib.Path(path)
    try:
        root = xml.parse(path).getroot()
    except FileNotFoundError:
        raise UserError(f"{path}: no such file") from None
    except xml.ParseError as problem:
        raise UserError(f"{path}: {problem}") from None
    snapshots = []
    for grid in root.iter("Grid"):
        if grid.find("Time") is None:
            continue
        leaves = [g for g in grid.iter("Grid") if g.find("Geometry") is not None]
        snapshots.append(Snapshot(float(grid.find("Time").get("Value")),
                                  [Piece(path.parent, leaf) for leaf in leaves]))
    return snapshots


def find_series(folder):
    """The water's series in a program's folder: its first .xdmf that is not of bodies; an empty list if it wrote none."""
    files = sorted(p for p in pathlib.Path(folder).glob("*.xdmf") if p.stem != "bodies")
    return open_series(files[0]) if files else []
