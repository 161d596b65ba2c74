#!/usr/bin/python3
"""What the facets of a mesh cost: grains that settle on a plane, and on the same plane of a thousand to a million triangles, alternating,
medians. Prints time per step over that of the plane, memory of a rank, and the time until the first step. Run on a quiet machine.

facets.py BUILD [--steps 400] [--repeats 3] [--ranks 1]
"""
import argparse
import json
import statistics
import tempfile
from pathlib import Path

import numpy as np
import tables
from speed import run

FACETS = (1_000, 30_000, 1_000_000)
WIDTH = 0.1  # [m]
SCENE = """
dimension = 3
[domain]
lower = [0, 0, -0.004]
upper = [{width}, {width}, 0.02]
gravity = [0, 0, -9.81]
leaves = "delete"
[contact]
law = "linear"
[[group]]
name = "sand"
kind = "grain"
density = 2500
diameter = ["0.9 mm", "1.1 mm"]
normal_stiffness = "500 N/m"
restitution = 0.5
friction = 0.4
{wall}
[start]
spacing = "1.15 mm"
jitter = 0.01
lower = [0.005, 0.005, 0.0002]
upper = [{end}, {end}, 0.0037]
[[start.region]]
group = "sand"
[time]
steps = 1
"""
PLANE = '[[wall]]\nname = "floor"\nmaterial = "sand"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n'


def write_plane(path, facets):
    """Binary STL: squares of two triangles."""
    n = max(1, round((facets / 2) ** 0.5))
    x, y = (WIDTH * a.ravel() / n for a in np.meshgrid(np.arange(n), np.arange(n)))
    corner = np.stack([x, y, 0 * x], axis=1)
    step = WIDTH / n * np.eye(3)
    triangles = np.concatenate([np.stack([corner, corner + step[0], corner + step[0] + step[1]], axis=1),
                                np.stack([corner, corner + step[0] + step[1], corner + step[1]], axis=1)])
    rows = np.zeros(len(triangles), dtype=[("numbers", "<f4", 12), ("attribute", "<u2")])
    rows["numbers"][:, 2] = 1
    rows["numbers"][:, 3:] = triangles.reshape(-1, 9)
    with open(path, "wb") as out:
        out.write(b"plane".ljust(80) + np.uint32(len(rows)).tobytes() + rows.tobytes())
    return len(rows)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path)
    arguments.add_argument("--steps", type=int, default=400)
    arguments.add_argument("--repeats", type=int, default=3)
    arguments.add_argument("--ranks", type=int, default=1)
    options = arguments.parse_args()
    with tempfile.TemporaryDirectory() as work:
        cases = {}
        for facets in (0, *FACETS):
            wall = PLANE
            if facets > 0:
                mesh = f"{work}/plane_{facets}.stl"
                count = write_plane(mesh, facets)
                wall = f'[[mesh]]\nname = "floor"\nmaterial = "sand"\nfile = "{mesh}"\n'
            scene = Path(work, f"scene_{facets}.toml")
            scene.write_text(SCENE.format(width=WIDTH, end=WIDTH - 0.005, wall=wall))
            cases[facets] = (scene, f"{count} facets" if facets > 0 else "plane")
        results = {facets: [] for facets in cases}
        for repeat in tables.turns(options.repeats):
            for facets, (scene, _) in cases.items():
                out = Path(work, f"run_{facets}_{repeat}")
                run(["mpirun", "-np", str(options.ranks), options.build / "bin/peperite", "run", scene, "--steps", str(options.steps),
                     "--out", out, "--set", "output.series_interval=1e9", "--set", "output.snapshot_interval=1e9"])
                results[facets].append(json.loads((out / "perf.json").read_text()))
        plane = statistics.median(1 / p["particle_steps_per_second"] for p in results[0])
        print(f"{results[0][0]['particles']} grains, {options.steps} steps, {options.ranks} ranks")
        for facets, (_, name) in cases.items():
            perf = results[facets]
            cost = statistics.median(1 / p["particle_steps_per_second"] for p in perf) / plane
            memory = statistics.median(p["peak_rank_bytes"] for p in perf) / 1e6
            setup = statistics.median(p["setup_seconds"] for p in perf)
            print(f"{name:>15}: {cost:5.2f} of the plane's time, {memory:6.0f} MB a rank, {setup:5.1f} s until the first step")


if __name__ == "__main__":
    main()
