"""Runs of the bulk cases, several at a time, one rank each; what has come to its end in the work folder stays."""

import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py
import numpy as np

here = Path(__file__).resolve().parent
source = here.parent.parent
sys.path[:0] = [str(source / folder) for folder in ("apps/sandbox", "apps/python", "cmake", "benchmarks")]
from grain_run import Snapshot  # noqa: E402
from peperite import Series  # noqa: E402, F401
from speed import log_of, run_scene  # noqa: E402


class Runner:
    def __init__(self, build, work, jobs):
        self.program = build / "bin/peperite"
        self.work = work
        self.pool = ThreadPoolExecutor(jobs)
        self.asked = {}  # folders and their scenes

    def start(self, name, scene, *settings):
        """A future of the run's folder."""
        self.asked[self.work / name] = here / scene
        return self.pool.submit(self.folder, name, scene, settings)

    def run(self, name, scene, *settings):
        return self.start(name, scene, *settings).result()

    def folder(self, name, scene, settings):
        folder = self.work / name
        code = run_scene(self.program, here / scene, folder, settings)
        if code != 0:
            raise RuntimeError(f"{name}: exit code {code}\n{log_of(folder).read_text()[-2000:]}")
        return folder


def snapshots(folder):
    return sorted((Snapshot(path) for path in folder.glob("snapshot_*.h5")), key=lambda s: s.step)


def write_start(path, position, radius, group, velocity=None):
    """A start file; ids in the order of the rows."""
    n = len(radius)
    zero = np.zeros((n, 3))
    with h5py.File(path, "w") as file:
        file["id"] = np.arange(1, n + 1, dtype=np.uint64)
        file["x"], file["v"], file["spin"] = position, zero if velocity is None else velocity, zero
        file["radius"], file["group"] = radius, np.asarray(group, dtype=np.uint32)


def exponent(x, y):
    """Of y ~ x^n by least squares in the logarithms, and the prefactor."""
    n, c = np.polyfit(np.log(x), np.log(y), 1)
    return n, np.exp(c)
