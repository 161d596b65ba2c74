"""The files of a run of the sandbox or the shear box: snapshots of grains, contacts, time series."""

import tomllib
from pathlib import Path

import h5py
import numpy as np

WALL = np.uint64(1) << np.uint64(63)  # partners of contacts at or above it are walls


class BadInput(Exception):
    """What is wrong with the arguments or with a file, in one line."""


class Snapshot:
    """The grains at one time, by ascending id."""

    def __init__(self, path):
        self.path = Path(path)
        try:
            with h5py.File(path) as file:
                self.time = float(file.attrs["time"])
                self.step = int(file.attrs["step"])
                self.scene = tomllib.loads(file.attrs["scene"])
                particles = file["particles"]
                self.id, self.position, self.radius = (particles[k][()] for k in ("id", "position", "radius"))
        except (OSError, KeyError, ValueError) as error:
            raise BadInput(f"{path}: not a snapshot of grains: {error}") from None
        order = np.argsort(self.id, kind="stable")  # above output.sort_limit rows are in the order of their owners
        self.order = order
        self.id, self.position, self.radius = self.id[order], self.position[order], self.radius[order]

    def field(self, name):
        """Of the grains; None where the scene did not ask for it."""
        with h5py.File(self.path) as file:
            return file["particles"][name][()][self.order] if name in file["particles"] else None

    @property
    def volume(self):
        return 4 / 3 * np.pi * self.radius**3

    def contacts(self):
        """Rows of both grains (-1: a wall), force on the first [N] and the unit vector towards the second."""
        with h5py.File(self.path) as file:
            if "contacts" not in file:
                raise BadInput(f"{self.path}: no contacts in it: run with output.contacts = true")
            first, second, force, point = (file["contacts"][k][()] for k in ("id", "partner", "force", "point"))
        a = np.searchsorted(self.id, first)
        b = np.where(second >= WALL, -1, np.searchsorted(self.id, np.minimum(second, self.id[-1])))
        target = np.where(b[:, None] < 0, point, self.position[b])
        way = target - self.position[a]
        for axis, periodic in enumerate(self.scene["domain"]["periodic"]):
            if periodic:
                length = self.scene["domain"]["upper"][axis] - self.scene["domain"]["lower"][axis]
                way[:, axis] -= length * np.round(way[:, axis] / length)
        return a, b, force, way / np.linalg.norm(way, axis=1)[:, None]


class Run:
    """A folder of snapshots and its time series."""

    def __init__(self, folder):
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise BadInput(f"{folder}: no such folder")
        self.snapshots = sorted((Snapshot(p) for p in self.folder.glob("snapshot_*.h5")), key=lambda s: s.step)
        if not self.snapshots:
            raise BadInput(f"{folder}: no snapshot_*.h5 in it")
        self.scene = self.snapshots[-1].scene
        self.title = self.scene.get("title", self.folder.name)
        sizes = [g["diameter"] for g in self.scene["group"] if "diameter" in g]
        self.diameter = float(np.mean(sizes[0]))
        lower, upper = self.scene["domain"]["lower"], self.scene["domain"]["upper"]
        self.width = upper[1] - lower[1]

    def wall(self, name):
        for wall in self.scene.get("wall", []):
            if wall["name"] == name:
                return wall
        raise BadInput(f"{self.folder}: its scene has no wall \"{name}\"")

    def drive(self, name):
        """When a stage sets the wall moving, and its velocity."""
        for stage in self.scene.get("stage", []):
            for change in stage["wall"]:
                if change["name"] == name and any(change.get("velocity", [])):
                    return stage["begin"], np.array(change["velocity"])
        raise BadInput(f"{self.folder}: no stage of its scene moves the wall \"{name}\"")

    def series(self, *needed):
        """Columns by name. A last line that is not complete is left out: the run may still be writing."""
        path = self.folder / "series.csv"
        try:
            lines = path.read_text().rpartition("\n")[0].splitlines()
            names = lines[0].split(",") if lines else []
            rows = [[float(value) for value in line.split(",")] for line in lines[1:]]
            if not rows or any(len(row) != len(names) for row in rows):
                raise ValueError("no whole lines in it")
        except (OSError, ValueError) as error:
            raise BadInput(f"{path}: cannot read it: {error}") from None
        table = dict(zip(names, np.array(rows).T))
        for name in needed:
            if name not in table:
                raise BadInput(f"{path}: no column {name}: the scene lacks its [[monitor]]")
        return table
