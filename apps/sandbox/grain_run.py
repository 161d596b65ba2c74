"""The files of a run of the sandbox or the shear box: snapshots of grains, contacts, time series."""

import sys
import tomllib
from pathlib import Path

import h5py
import numpy as np

sys.path.append(str(Path(__file__).resolve().parent.parent / "plotting"))
from run_folder import BadInput, RunFolder  # noqa: E402

WALL = np.uint64(1) << np.uint64(63)  # partners of contacts at or above it are walls


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

    def stress(self, *wanted):
        """These components ("xx", ...) of the grains' stress; None where the scene did not ask for contacts."""
        with h5py.File(self.path) as file:
            if "stress" not in file["particles"]:
                return None
            stress = file["particles/stress"]
            names = stress.attrs.get("components", "xx yy zz xy xz yz").split()  # earlier versions named none
            return [stress[:, names.index(name)][self.order] for name in wanted]

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


class Run(RunFolder):
    """The folder of a run of grains."""

    def __init__(self, folder):
        super().__init__(folder, Snapshot)
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
