"""The files of a run with melts: cells as arrays over their grid, grains among them, a plane through both, series."""

import functools

import numpy as np

from ..errors import Error
from ..run import Run as AnyRun
from ..snapshot import Snapshot as AnySnapshot

CLOCK = (("yr", 365.25 * 86400, 3), ("d", 86400, 3), ("h", 3600, 3), ("min", 60, 10))  # and from how many on


def clock(longest):
    """Name and size of the unit in which `longest` seconds are said; of a short while None."""
    return next(((name, size) for name, size, least in CLOCK if longest >= least * size), None)


class Grid:
    """The cells of a resolved scene. Arrays over them have the slowest axis first: [z][y][x], in 2D [y][x]."""

    def __init__(self, scene):
        self.cells = scene["melt"]["cells"]
        self.dim = len(self.cells)
        self.low, self.high = (np.array(scene["domain"][k], dtype=float) for k in ("lower", "upper"))
        self.edge = (self.high - self.low) / self.cells
        self.periodic = scene["domain"].get("periodic", [False] * self.dim)
        self.up = self.dim - 1

    def centres(self, axis):
        return self.low[axis] + self.edge[axis] * (np.arange(self.cells[axis]) + 0.5)

    def faces(self, axis):
        return np.linspace(self.low[axis], self.high[axis], self.cells[axis] + 1)

    def over_height(self, field):
        """Means of the horizontal layers, from the floor upwards."""
        return field.reshape(self.cells[self.up], -1).mean(axis=1)

    def at_centres(self, velocity, axis):
        """A component of what is stored on the lower faces of the cells; nothing passes the walls."""
        lower, along = velocity[..., axis], self.dim - 1 - axis
        upper = np.roll(lower, -1, axis=along)
        if not self.periodic[axis]:
            np.moveaxis(upper, along, 0)[-1] = 0
        return 0.5 * (lower + upper)


class Snapshot(AnySnapshot):
    """Cells and grains at one time."""

    def __init__(self, path):
        super().__init__(path)
        try:
            self.grid = Grid(self.scene)
        except KeyError as error:
            raise Error(f"{path}: not a snapshot of melts: {error}") from None

    @functools.cached_property
    def _cells(self):
        """Rows; in the order of their ids cells run through the grid."""
        rows = np.flatnonzero(self.where(kind="melt"))
        if len(rows) != np.prod(self.grid.cells):
            raise Error(f"{self.path}: {len(rows)} cells, its scene has {np.prod(self.grid.cells)}")
        return rows

    @functools.cached_property
    def _grains(self):
        return np.flatnonzero(self.where(kind="grain"))

    def cell(self, field):
        values = self[field][self._cells]
        return values.reshape(*self.grid.cells[::-1], *values.shape[1:])

    def grain(self, field):
        return self[field][self._grains]

    @property
    def grain_count(self):
        return len(self._grains)


class Plane:
    """A vertical plane of cells: all of a two-dimensional grid; in 3D along the longer horizontal axis, that layer of
    cells across it whose centre is nearest to the middle."""

    def __init__(self, grid):
        self.grid = grid
        self.up, self.along, self.depth = grid.up, 0, None
        if grid.dim == 3:
            self.along, self.depth = sorted((0, 1), key=lambda axis: grid.low[axis] - grid.high[axis])
            self.layer = grid.cells[self.depth] // 2
            self.place = grid.centres(self.depth)[self.layer]
        self.axes = [self.along, self.up]
        self.low, self.high = grid.low[self.axes], grid.high[self.axes]

    def of(self, field):
        """Of a field of cells: [up][along]."""
        return field if self.depth is None else np.take(field, self.layer, axis=self.grid.dim - 1 - self.depth)

    def velocity(self, snapshot):
        """Of the flow at the centres of the cells, along and up."""
        faces = snapshot.cell("velocity")
        return [self.of(self.grid.at_centres(faces, axis)) for axis in self.axes]

    def discs(self, snapshot):
        """Places, diameters and groups of the circles in which grains cross the plane."""
        if not snapshot.grain_count:
            return np.zeros((0, 2)), np.zeros(0), np.zeros(0, dtype=int)
        position, radius, group = (snapshot.grain(k) for k in ("position", "radius", "group"))
        away = 0 if self.depth is None else position[:, self.depth] - self.place
        square = radius**2 - away**2
        cut = square > 0
        return position[cut][:, self.axes], 2 * np.sqrt(square[cut]), group[cut]

    def title(self):
        return "" if self.depth is None else f", slice at {'xyz'[self.depth]} = {self.place:.4g} m"


class Run(AnyRun):
    """The folder of a run with melts."""

    snapshot_type = Snapshot

    def __init__(self, folder):
        super().__init__(folder)
        last = self[-1]
        self.grid, self.plane = last.grid, Plane(last.grid)
        self.heated, self.mixed = "temperature" in last, "composition" in last
        self.melts = [group["name"] for group in self.scene["group"] if group["kind"] == "melt"]
        self.grains = [k for k, group in enumerate(self.scene["group"]) if group["kind"] == "grain"]
        self.clock = clock(last.time)

    def monitor(self):
        """Name of the scene's monitor of melts, or None."""
        return next((m["name"] for m in self.scene.get("monitor", []) if m["kind"] == "melt"), None)

    def heat(self, table):
        """Of each side that lets heat pass: how the curve is called, values; then the name of the quantity. Between two
        sides that have temperatures it is the Nusselt number."""
        name, melt, up = self.monitor(), self.scene["melt"], self.grid.up
        sides = {side["side"]: side for side in melt.get("side", [])}
        columns = {side: table[f"{name}_heat_{side}"] for side in sides if f"{name}_heat_{side}" in table}
        ends = [sides.get(f"{'xyz'[up]}{end}", {}).get("temperature") for end in (0, 1)]
        if None in ends or ends[0] == ends[1]:
            return [(f"in through {side}", values) for side, values in columns.items()], "heat in (K m/s)"
        by_conduction = melt["diffusivity"] * (ends[0] - ends[1]) / (self.grid.high[up] - self.grid.low[up])
        words = {f"{'xyz'[up]}0": ("in at the bottom", 1), f"{'xyz'[up]}1": ("out at the top", -1)}
        return [(words.get(side, (f"in through {side}", 1))[0], words.get(side, ("", 1))[1] * values / by_conduction)
                for side, values in columns.items()], "heat over conduction, Nu"
