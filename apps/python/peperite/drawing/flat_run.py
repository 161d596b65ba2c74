"""Runs of two-dimensional scenes, as they are drawn."""

import functools

import numpy as np

from ..errors import Error
from ..run import Run as AnyRun
from ..snapshot import Snapshot as AnySnapshot
from .at_rest import height_of, pressure_at_rest
from .style import time_text


class Snapshot(AnySnapshot):
    """... whose velocity and pressure may be averages."""

    remark = ""

    def averaged(self, over):
        """The same with velocity and pressure averaged over "time" or "space" (None: unchanged)."""
        if over is None:
            return self
        suffix, key = {"time": ("mean", "average_time"), "space": ("smooth", "average_space")}[over]
        other = Snapshot(self.path)
        for field in ("velocity", "pressure"):
            if f"{field}_{suffix}" not in self:
                raise Error(f"{self.path}: no averages over {over} in it: run with output.{key}")
            other._kept[field] = self[f"{field}_{suffix}"]
        window = f"{self.scene['output']['average_time']:g} s" if over == "time" else "neighbours"
        other.remark = f"; velocity and pressure averaged over {window}"
        return other

    @property
    def diameter(self):
        """Of a circle inside the square that holds the particle's mass: it swells as density falls."""
        return np.sqrt(self["mass"] / self["density"])

    def principal_stresses(self, at_rest=None):
        """Greater and smaller principal value (tension > 0), less the pressure at rest if that is given, and the angle
        of the greater one's axis."""
        pressure, stressed = self["pressure"], "stress" in self
        zero = np.zeros(len(pressure))
        xx, yy, xy = self["stress"].T if stressed else (zero, zero, zero)
        if self.scene.get("formulation") == "ida" and stressed:
            pressure = zero  # already part of the stress
        if at_rest is not None:
            pressure = pressure - at_rest
        centre, half = (xx + yy) / 2 - pressure, (xx - yy) / 2
        radius = np.hypot(half, xy)
        return centre + radius, centre - radius, np.arctan2(xy, half) / 2


class Run(AnyRun):
    snapshot_type = Snapshot

    def __init__(self, folder):
        super().__init__(folder)
        if self.scene["dimension"] != 2:
            raise Error(f"{folder}: the scene has {self.scene['dimension']} dimensions, this draws 2: take apps/plot.py")
        self.kinds = [g["kind"] for g in self.scene["group"]]
        self.names = [g["name"] for g in self.scene["group"]]
        self.sprays = {row["group"] for g in self.scene["group"] for row in g.get("becomes", [])
                       if "void_fraction_above" in row}
        self.spacing = self.scene["start"]["spacing"]

    @functools.cached_property
    def first(self):
        return self[0]

    def at_rest(self, snapshot):
        """Pressure of the layers at rest at the particles' places, or None. Without layers in the scene the surface is
        that of the first snapshot."""
        height = height_of(self.scene, self.first["position"])
        if height is None:
            return None
        matter = ~self.first.where(kind="wall")
        if not matter.any():
            return None
        surface, filling = height[matter].max() + self.spacing / 2, np.bincount(self.first["group"][matter]).argmax()
        return pressure_at_rest(self.scene, snapshot["position"], surface, filling)

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
