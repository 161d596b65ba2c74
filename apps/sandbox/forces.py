"""What the contacts carry: force chains, fabric, coordination and the coarse-grained stress."""

import numpy as np


class Contacts:
    """Of one snapshot, seen in the x-z plane."""

    def __init__(self, snapshot):
        contacts = snapshot.contacts
        first, second, force, normal = contacts.first, contacts.second, contacts.force, contacts.normal
        self.count = len(contacts)
        between = second >= 0
        self.coordination = 2 * np.sum(between) / max(1, len(snapshot.id))
        # Normals have no sign: the tensor of their products, whose trace is one.
        n = normal[between]
        self.fabric = n.T @ n / max(1, len(n))
        flat = self.fabric[np.ix_([0, 2], [0, 2])]
        values, vectors = np.linalg.eigh(flat)
        self.anisotropy = 2 * (values[1] - values[0]) / max(values.sum(), 1e-300)
        self.direction = np.degrees(np.arctan2(*vectors[::-1, 1])) % 180  # of most contacts, from the x axis
        size = np.linalg.norm(force[between], axis=1)
        self.mean_force = size.mean() if len(size) else 0.0
        chosen = size > self.mean_force
        self.strength = size[chosen] / max(self.mean_force, 1e-300)
        start = snapshot.position[first[between][chosen]]
        reach = snapshot.radius[first[between]] + snapshot.radius[second[between]]
        end = start + normal[between][chosen] * reach[chosen][:, None]
        self.lines = np.stack([start[:, [0, 2]], end[:, [0, 2]]], axis=1)


def stress_on(grid, snapshot):
    """xx, zz and xz of the stress of the bulk [Pa], compression negative, on the grid; None without contacts. The
    grains' own stresses, weighted with their volume: divided by the volume of the cells, whose share of grains is
    0.6 inside the sand."""
    stress = snapshot.stresses("xx", "zz", "xz")
    if stress is None:
        return None
    place, volume = snapshot.position[:, [0, 2]], snapshot.volume
    weight = grid.deposit(place, volume)
    sand = weight > 0.4 * np.quantile(weight[weight > 0], 0.9)
    out = []
    for component in stress:
        sums = grid.deposit(place, volume * component)
        out.append(np.where(sand, 0.6 * sums / np.where(sand, weight, 1), np.nan))
    return out


def principal(xx, zz, xz):
    """Pressure in the plane, half the difference of the principal values, angle of the greatest compression."""
    half = 0.5 * (xx - zz)
    radius = np.hypot(half, xz)
    return -0.5 * (xx + zz), radius, 0.5 * np.arctan2(xz, half) + np.pi / 2
