"""The files of a run: snapshots and time series of two-dimensional scenes."""

import sys
import tomllib
from pathlib import Path

import h5py
import numpy as np

sys.path.append(str(Path(__file__).resolve().parent.parent / "plotting"))
from at_rest import height_of, pressure_at_rest  # noqa: E402
from figures import time_text  # noqa: E402
from run_folder import BadInput, RunFolder  # noqa: E402


class Snapshot:
    """The particles at one time."""

    def __init__(self, path):
        self.path, self.remark = path, ""
        try:
            with h5py.File(path) as file:
                self.time = float(file.attrs["time"])
                self.step = int(file.attrs["step"])
                self.scene = tomllib.loads(file.attrs["scene"])
        except (OSError, KeyError, ValueError) as error:
            raise BadInput(f"{path}: not a snapshot: {error}") from None

    def __getattr__(self, field):
        """Fields are read when they are first looked at; None where the scene does not have them."""
        if field.startswith("_"):
            raise AttributeError(field)
        try:
            with h5py.File(self.path) as file:
                values = file["particles"][field][()] if field in file["particles"] else None
        except (OSError, KeyError) as error:
            raise BadInput(f"{self.path}: cannot read {field}: {error}") from None
        setattr(self, field, values)
        return values

    def averaged(self, over):
        """The same with velocity and pressure averaged over "time" or "space" (None: unchanged)."""
        if over is None:
            return self
        suffix, key = {"time": ("mean", "average_time"), "space": ("smooth", "average_space")}[over]
        other = Snapshot(self.path)
        for field in ("velocity", "pressure"):
            values = getattr(self, f"{field}_{suffix}")
            if values is None:
                raise BadInput(f"{self.path}: no averages over {over} in it: run with output.{key}")
            setattr(other, field, values)
        window = f"{self.scene['output']['average_time']:g} s" if over == "time" else "neighbours"
        other.remark = f"; velocity and pressure averaged over {window}"
        return other

    @property
    def diameter(self):
        """Of a circle inside the square that holds the particle's mass: it swells as density falls."""
        return np.sqrt(self.mass / self.density)

    def principal_stresses(self, at_rest=None):
        """Greater and smaller principal value (tension > 0), less the pressure at rest if that is given, and the angle
        of the greater one's axis."""
        zero = np.zeros(len(self.pressure))
        xx, yy, xy = self.stress.T if self.stress is not None else (zero, zero, zero)
        pressure = self.pressure
        if self.scene.get("formulation") == "ida" and self.stress is not None:
            pressure = zero  # already part of the stress
        if at_rest is not None:
            pressure = pressure - at_rest
        centre, half = (xx + yy) / 2 - pressure, (xx - yy) / 2
        radius = np.hypot(half, xy)
        return centre + radius, centre - radius, np.arctan2(xy, half) / 2


class Run(RunFolder):
    """The folder of a run of a two-dimensional scene."""

    def __init__(self, folder):
        super().__init__(folder, Snapshot)
        if self.scene["dimension"] != 2:
            raise BadInput(f"{folder}: the scene has {self.scene['dimension']} dimensions, this draws 2: take apps/plot.py")
        self.kinds = [g["kind"] for g in self.scene["group"]]
        self.names = [g["name"] for g in self.scene["group"]]
        self.sprays = {row["group"] for g in self.scene["group"] for row in g.get("becomes", [])
                       if "void_fraction_above" in row}
        self.spacing = self.scene["start"]["spacing"]

    def nearest(self, time):
        if time is None:
            return self.snapshots[-1]
        return min(self.snapshots, key=lambda s: abs(s.time - time))

    def is_wall(self, snapshot):
        return np.array([kind == "wall" for kind in self.kinds])[snapshot.group]

    def at_rest(self, snapshot):
        """Pressure of the layers at rest at the particles' places, or None. Without layers in the scene the surface is
        that of the first snapshot."""
        height = height_of(self.scene, self.snapshots[0].position)
        if height is None:
            return None
        surface = height[~self.is_wall(self.snapshots[0])].max() + self.spacing / 2
        return pressure_at_rest(self.scene, snapshot.position, surface)

    def heading(self, snapshot):
        return f"{self.title}, t = {time_text(snapshot.time)}{snapshot.remark}"

    def tracked(self):
        """Name of the first monitor that follows a particle."""
        return next((m["name"] for m in self.scene.get("monitor", []) if m["kind"] == "particle"), None)

    def fragmentation(self, table):
        """When the first particle fragmented; None if none did or the scene does not count them."""
        for monitor in self.scene.get("monitor", []):
            if monitor.get("group") in self.sprays and f"{monitor['name']}_n" in table:
                when = table["t"][table[f"{monitor['name']}_n"] > 0]
                return when[0] if when.size else None
        return None
