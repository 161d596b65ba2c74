#!/usr/bin/python3
"""Cracks at any angle to the lattice, on hexagonal and disordered ones: where they begin to grow, and where they go.

    crack_angles.py [BUILD] [--work DIR] [--angles 0 10 26.565 30 45]

A crack of half-length 10.5 spacings in the middle of a free disc of radius 80, under pressure that is raised to 1.15 of the
critical one, K = p sqrt(pi a) (the rim adds 1.5 % at most). With a turned lattice what fails at the start are the particles within
half a spacing of the crack's line. Under pressure alone no direction is the better one but for the crack's own: how far the
path is from its line is what the lattice does. Ten minutes on one core.
"""

import argparse
import math
import subprocess
from pathlib import Path

import h5py
import numpy as np

HALF, RADIUS, TOUGHNESS, BEYOND, RISE = 10.5, 80, 0.01, 1.15, 800
SCENE = f"""
dimension = 2
domain = {{ lower = [-100, -100], upper = [100, 100] }}
kernel = {{ h_over_dx = 1 }}
[[group]]
name = "rock"
kind = "solid"
lagrangian = "total"
density = 1
bulk_modulus = 0.6666666666666667
shear_modulus = 0.4
viscosity = 0.05
becomes = [{{ group = "melt", toughness = {TOUGHNESS}, keeps = "volume" }}]
[[group]]
name = "melt"
kind = "fluid"
density = 1
sound_speed = 0.7
viscosity = 0.05
[start]
spacing = 1
file = "start.csv"
[[reset]]
lower = [-5, -13]
upper = [5, 13]
pressure = {BEYOND * TOUGHNESS / math.sqrt(math.pi * HALF)}
rise_time = {RISE}
until = {RISE}
[time]
until = {1.5 * RISE}
cfl = 0.8
[output]
snapshot_interval = {RISE / 100}
"""


def lattice(angle, hexagonal=False, jitter=0):
    i, j = (a.ravel().astype(float) for a in np.meshgrid(*2 * [np.arange(-2 * RADIUS, 2 * RADIUS + 1)]))
    s = math.sqrt(2 / math.sqrt(3))
    x = np.stack([(i + j / 2) * s, j * s * math.sqrt(3) / 2] if hexagonal else [i, j], 1)
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    x = x @ np.array([[c, s], [-s, c]])
    x = x[np.hypot(*x.T) < RADIUS]
    return x + np.random.default_rng(1).uniform(-jitter, jitter, x.shape)


def state(path):
    with h5py.File(path) as file:
        p = file["particles"]
        order = np.argsort(p["id"][()])
        return float(file.attrs["time"]), p["position"][()][order], p["group"][()][order]


def run(build, folder, x):
    melt = (np.abs(x[:, 0]) < 0.5 - 1e-9) & (np.abs(x[:, 1]) < HALF)
    folder.mkdir(parents=True, exist_ok=True)
    rows = "".join(f"{k + 1},{a:.12g},{b:.12g},0,0,{m:d},1,0\n" for k, ((a, b), m) in enumerate(zip(x, melt)))
    (folder / "start.csv").write_text("id,x,y,vx,vy,group,rho,m\n" + rows)
    (folder / "crack.toml").write_text(SCENE)
    if not (folder / "out" / "perf.json").is_file():
        subprocess.run([build / "bin/peperite", "run", folder / "crack.toml", "--out", folder / "out"], check=True,
                       stdout=subprocess.DEVNULL)
    first = None
    for path in sorted((folder / "out").glob("snapshot_*.h5")):
        time, _, group = state(path)
        failed = (group == 1) & ~melt
        first = time if first is None and failed.any() else first
    if first is None:
        return "does not grow"
    off, along = np.abs(x[failed, 0]).max(), np.abs(x[failed, 1]).max() - HALF + 1
    return (f"grows at K = {BEYOND * min(first / RISE, 1):.3f} K_Ic, by {failed.sum()} particles and {along:.1f} spacings; "
            f"{off:.1f} off its line, {math.degrees(math.atan(off / along)):.0f} degrees")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", default="build", type=Path)
    parser.add_argument("--work", default="out/crack_angles", type=Path)
    parser.add_argument("--angles", nargs="*", default=[0, 10, 26.565, 30, 45], type=float)
    given = parser.parse_args()
    cases = {f"square, {angle:g} degrees": (f"s{angle:g}", (angle,)) for angle in given.angles}
    cases |= {"hexagonal, between rows": ("h0", (0, True)), "hexagonal, along rows": ("h30", (30, True)),
              "square, 0 degrees, disordered by 0.1": ("j0", (0, False, 0.1))}
    for name, (folder, arguments) in cases.items():
        print(f"{name}: {run(given.build, given.work / folder, lattice(*arguments))}", flush=True)


if __name__ == "__main__":
    main()
