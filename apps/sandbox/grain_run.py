"""Runs of the sandbox or the shear box."""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
import peperite  # noqa: E402


class Snapshot(peperite.Snapshot):
    """The grains at one time."""

    def stresses(self, *wanted):
        """These components ("xx", ...) of the grains' stress; None where the scene did not ask for contacts."""
        return [self.component("stress", name) for name in wanted] if "stress" in self else None

    @property
    def volume(self):
        return 4 / 3 * np.pi * self.radius**3


class Run(peperite.Run):
    """The folder of a run of grains."""

    snapshot_type = Snapshot

    def __init__(self, folder):
        super().__init__(folder)
        if not self.files:
            raise peperite.Error(f"{folder}: no snapshot_*.h5 in it")
        sizes = [g["diameter"] for g in self.scene["group"] if "diameter" in g]
        self.diameter = float(np.mean(sizes[0]))
        lower, upper = self.scene["domain"]["lower"], self.scene["domain"]["upper"]
        self.width = upper[1] - lower[1]

    def wall(self, name):
        for wall in self.scene.get("wall", []):
            if wall["name"] == name:
                return wall
        raise peperite.Error(f"{self.folder}: its scene has no wall \"{name}\"")

    def drive(self, name):
        """When a stage sets the wall moving, and its velocity."""
        for stage in self.scene.get("stage", []):
            for change in stage["wall"]:
                if change["name"] == name and any(change.get("velocity", [])):
                    return stage["begin"], np.array(change["velocity"])
        raise peperite.Error(f"{self.folder}: no stage of its scene moves the wall \"{name}\"")
