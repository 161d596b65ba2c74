"""Beds of grains as columns: a loose packing, its copies side by side, files for LAMMPS, LIGGGHTS and Peperite."""
import random
from dataclasses import dataclass

import h5py
import numpy as np

DENSITY = 2500  # kg/m^3
PERIOD, HEIGHT = 20 * 1.1e-3, 0.06  # of a tile [m]
LARGEST_DIAMETER = 1.05e-3


@dataclass
class Bed:
    diameter: np.ndarray
    x: np.ndarray
    v: np.ndarray  # nothing spins
    size: tuple  # upper corner of the box, whose lower corner is the origin

    def __len__(self):
        return len(self.diameter)


def loose_tile():
    """12,800 spheres of 1 mm +- 5 % near the points of a lattice."""
    random.seed(12345)
    n, layers, spacing = 20, 32, 1.1e-3
    diameter, x = [], []
    for k in range(layers):
        for j in range(n):
            for i in range(n):
                diameter.append(1e-3 * random.uniform(0.95, 1.05))
                x.append([(c + 0.5) * spacing + 1e-3 * random.uniform(-0.024, 0.024) for c in (i, j, k)])
    return Bed(np.array(diameter), np.array(x), np.zeros((len(x), 3)), (PERIOD, PERIOD, HEIGHT))


def read_data(path):
    """A tile that LAMMPS wrote, by ascending id, inside its box."""
    section, rows = "", {"Atoms": [], "Velocities": []}
    for line in path.read_text().splitlines():
        words = line.split("#")[0].split()
        if len(words) == 1:
            section = words[0]
        elif words and section in rows:
            rows[section].append([float(word) for word in words])
    atoms, velocities = (np.array(sorted(rows[name])) for name in ("Atoms", "Velocities"))
    x = atoms[:, 4:7]
    x[:, :2] %= PERIOD
    return Bed(atoms[:, 2], x, velocities[:, 1:4], (PERIOD, PERIOD, HEIGHT))


def repeated(tile, nx, ny):
    shifts = [(i * PERIOD, j * PERIOD, 0) for i in range(nx) for j in range(ny)]
    return Bed(np.tile(tile.diameter, nx * ny), np.concatenate([tile.x + shift for shift in shifts]),
               np.tile(tile.v, (nx * ny, 1)), (nx * PERIOD, ny * PERIOD, HEIGHT))


def pushed(bed, speed):
    """At rest but for a shear: `speed` in x at the top, 0 at the floor."""
    v = np.zeros_like(bed.x)
    v[:, 0] = speed * bed.x[:, 2] / bed.x[:, 2].max()
    return Bed(bed.diameter, bed.x, v, bed.size)


def drifted(bed, time):
    return Bed(bed.diameter, bed.x + time * bed.v, bed.v, bed.size)


def write_data(bed, path, lower=(0, 0, 0), types=1):
    number = np.arange(1, len(bed) + 1)
    one = np.ones(len(bed))
    with open(path, "w") as out:
        out.write(f"bed\n\n{len(bed)} atoms\n{types} atom types\n\n")
        for axis, low, high in zip("xyz", lower, bed.size):
            out.write(f"{low:.17g} {high:.17g} {axis}lo {axis}hi\n")
        out.write("\nAtoms\n\n")
        np.savetxt(out, np.column_stack([number, one, bed.diameter, DENSITY * one, bed.x]), "%d %d" + " %.17g" * 5)
        out.write("\nVelocities\n\n")
        np.savetxt(out, np.column_stack([number, bed.v, 0 * bed.v]), "%d" + " %.17g" * 3 + " %g" * 3)


def write_start(bed, path):
    with h5py.File(path, "w") as file:
        file["id"] = np.arange(1, len(bed) + 1, dtype=np.uint64)
        file["x"], file["v"], file["spin"] = bed.x, bed.v, np.zeros_like(bed.v)
        file["radius"] = bed.diameter / 2
        file["group"] = np.zeros(len(bed), dtype=np.uint32)
