"""Buoyant cylinder of the paper: rise after 1 s, and its budget of energy, in three materials."""

import tomllib

import h5py
import numpy as np
from scipy.spatial import cKDTree

SCENE = "../../apps/buoyant_cylinder/fluid_fine.toml"
SIZES = (1, 2, 4)  # particles a metre
ERROR = "energy unaccounted for / largest kinetic energy"
DELTA = 0.1

# The melt is sped up (c = 245 m/s), the others have their own moduli: a solid's and a foam's waves are their physics.
FORMULATIONS = {
    "fluid": (),
    "fluid, mixed": ("precision=mixed",),
    "elastic": ("group.cylinder.kind=solid", "group.cylinder.bulk_modulus=1e10", "group.cylinder.poisson_ratio=0.25"),
    "bubbly": ("group.cylinder.eos=bubbly", "group.cylinder.bulk_modulus=1e10", "group.cylinder.gas_content=0.001",
               "group.cylinder.gas_rt=5e5", "group.cylinder.solubility_pressure=1e9"),
}


def settings(n):
    wall = 3 / n
    return (f"start.spacing={1 / n}", f"start.lower={[1.5 - wall, 1.5 - wall]}", f"start.upper={[46.5 + wall, 64]}",
            "output.snapshot_interval=0.025", "time.until=1")


def bubbly_pressure(density, group):
    """p of a bubbly fluid, as in libsph/src/laws/bubbly.cpp with solubility exponent 1, from a table of rho(p)."""
    rho0, k, m, rt, ps = (group[key] for key in ("density", "bulk_modulus", "gas_content", "gas_rt",
                                                 "solubility_pressure"))
    p = np.concatenate([np.geomspace(1e3, 0.999 * m * ps, 4000), np.linspace(m * ps, 20 * m * ps, 4000)])
    free = np.maximum(m - p / ps, 0) / (1 + m)
    liquid = rho0 * (1 + p / k)
    return np.interp(density, liquid / (1 + free * (liquid * rt / p - 1)), p)


def compression(density, group, surface):
    """Integral of (p - p_surface) / rho^2 from rho_0: energy of compression a mass against the atmosphere."""
    rho0 = group["density"]
    if group["eos"] == "linear":
        return (group["bulk_modulus"] / rho0 * (np.log(density / rho0) + rho0 / density - 1)
                + surface * (1 / density - 1 / rho0))
    table = np.linspace(density.min(), max(density.max(), rho0) * 1.0001, 200001)
    rate = (bubbly_pressure(table, group) - surface) / table**2
    sums = np.concatenate([[0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(table))])
    return np.interp(density, table, sums) - np.interp(rho0, table, sums)


class State:
    """All particles of a snapshot with their energy and what viscosity and density diffusion take from it."""

    def __init__(self, path):
        with h5py.File(path) as file:
            self.time = float(file.attrs["time"])
            self.scene = tomllib.loads(file.attrs["scene"])
            data = {name: file["particles"][name][()] for name in
                    ("position", "velocity", "density", "pressure", "mass", "group")}
            self.stress = file["particles/stress"][()] if "stress" in file["particles"] else None
        self.x, self.v, self.rho, self.p, self.m, self.group = data.values()
        self.groups = self.scene["group"]
        self.wall = np.array([g["kind"] == "wall" for g in self.groups])[self.group]
        self.volume = self.m / self.rho

    def of_groups(self, key):
        return np.array([g.get(key, 0.0) for g in self.groups])[self.group]

    def energy(self):
        mover = ~self.wall
        total = np.sum(self.m[mover] * (0.5 * np.sum(self.v[mover]**2, axis=1) + 9.8 * self.x[mover, 1]))
        for k, group in enumerate(self.groups):
            own = mover & (self.group == k)
            if not own.any():
                continue
            total += np.sum(self.m[own] * compression(self.rho[own], group, self.scene["domain"]["surface_pressure"]))
            if group["kind"] == "solid":
                s = self.stress[own]
                zz = s[:, 0] + s[:, 1]  # plane strain
                total += np.sum(self.volume[own] * (s[:, 0]**2 + s[:, 1]**2 + zz**2 + 2 * s[:, 2]**2)
                                / (4 * group["shear_modulus"]))
        return total

    def kinetic(self):
        return 0.5 * np.sum((self.m * np.sum(self.v**2, axis=1))[~self.wall])

    def power(self):
        """Of viscous forces and of density diffusion, from the same sums as the step's [W]."""
        h = self.scene["kernel"]["smoothing_length"]
        i, j = cKDTree(self.x).query_pairs(3 * h, output_type="ndarray").T
        apart = self.x[j] - self.x[i]
        r = np.linalg.norm(apart, axis=1)
        q = r / h
        alpha = 7 / (478 * np.pi * h**2)
        bells = [(np.clip(reach - q, 0, None), factor) for reach, factor in ((3, 1), (2, -6), (1, 15))]
        w = alpha * sum(factor * b**5 for b, factor in bells)
        slope = -5 * alpha / h * sum(factor * b**4 for b, factor in bells) / r

        v = self.v.copy()  # walls mirror the mean velocity near them
        weight, mean = np.zeros(len(v)), np.zeros_like(v)
        for a, b in ((i, j), (j, i)):
            near = self.wall[a] & ~self.wall[b]
            np.add.at(weight, a[near], w[near])
            np.add.at(mean, a[near], w[near, None] * self.v[b[near]])
        wet = weight > 0
        v[wet] = -mean[wet] / weight[wet, None]

        eta = self.of_groups("viscosity")
        mean_eta = 2 * eta[i] * eta[j] / np.maximum(eta[i] + eta[j], 1e-30)
        force = (2 * mean_eta * self.volume[i] * self.volume[j] * slope)[:, None] * (v[i] - v[j])
        viscous = np.sum(force[~self.wall[i]] * v[i][~self.wall[i]]) - np.sum(
            force[~self.wall[j]] * v[j][~self.wall[j]])

        fluid = np.array([g["kind"] == "fluid" for g in self.groups])[self.group]
        same = (self.group[i] == self.group[j]) & fluid[i]
        i, j, apart, slope = i[same], j[same], apart[same], slope[same]
        c = self.sound_speed()
        excess = self.p[i] - self.p[j] - 0.5 * (self.rho[i] + self.rho[j]) * 9.8 * apart[:, 1]
        rate = 2 * DELTA * h * excess / np.maximum(c[i], c[j]) * slope
        gained = np.zeros(len(v))
        np.add.at(gained, i, self.volume[j] * rate)
        np.add.at(gained, j, -self.volume[i] * rate)
        return viscous, np.sum(self.m * self.p / self.rho**2 * gained)

    def sound_speed(self):
        c = np.sqrt(self.of_groups("bulk_modulus") / self.of_groups("density"))
        for k, group in enumerate(self.groups):
            if group["eos"] == "bubbly":
                own = self.group == k
                d = 1e-5 * self.rho[own]
                c[own] = np.sqrt((bubbly_pressure(self.rho[own] + d, group)
                                  - bubbly_pressure(self.rho[own] - d, group)) / (2 * d))
        return c


def measure(run):
    states = sorted((State(path) for path in run.folder.glob("snapshot_*.h5")), key=lambda s: s.time)
    time = np.array([s.time for s in states])
    energy = np.array([s.energy() for s in states])
    kinetic = max(s.kinetic() for s in states)
    power = np.array([s.power() for s in states])
    lost = np.concatenate([[0], np.cumsum(0.5 * np.diff(time) * (power[1:] + power[:-1]).sum(axis=1))])
    series = run.series()
    moved = series["cylinder_y"] - series["cylinder_y"][0]
    viscous, diffusion = (0.5 * np.sum(np.diff(time)[:, None] * (power[1:] + power[:-1]), axis=0)) / kinetic
    return {"rise at 1 s [m]": np.interp(1, series["t"], moved),
            "energy unaccounted for / largest kinetic energy": np.max(np.abs(energy - energy[0] - lost)) / kinetic,
            "viscous": viscous, "density diffusion": diffusion}
