"""Surface, taper and what the theory of the critical taper expects of them (cohesionless, flat floor; Dahlen 1984)."""

import numpy as np


def back_friction_angle(phi, phi_b):
    """psi_b: angle between the largest stress and the floor where the wedge slides. All angles in degrees."""
    ratio = min(1.0, np.sin(np.radians(phi_b)) / np.sin(np.radians(phi)))
    return 0.5 * np.degrees(np.arcsin(ratio)) - 0.5 * phi_b


def critical_taper(phi, phi_b):
    """Least stable slope of the surface: the root of alpha = psi_b - psi_0(alpha), by bisection."""
    def excess(alpha):
        ratio = np.sin(np.radians(alpha)) / np.sin(np.radians(phi))
        return alpha - back_friction_angle(phi, phi_b) + 0.5 * np.degrees(np.arcsin(min(1.0, ratio))) - 0.5 * alpha
    low, high = 0.0, phi
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) < 0 else (low, middle)
    return low


def thrust_dips(phi, phi_b):
    """Of forward and back thrusts in a wedge at yield."""
    psi = back_friction_angle(phi, phi_b)
    return 45 - phi / 2 - psi, 45 - phi / 2 + psi


class Surface:
    """Height along x: the highest grain of each bin two diameters wide, lone grains on top left out."""

    def __init__(self, snapshot, diameter, left, right):
        edges = np.arange(left, right + 1e-9, 2 * diameter)
        top = snapshot.position[:, 2] + snapshot.radius
        bins = np.digitize(snapshot.position[:, 0], edges) - 1
        height = np.zeros(len(edges) - 1)
        for k in range(len(height)):
            inside = np.sort(top[bins == k])
            height[k] = inside[-3:].mean() if len(inside) else 0.0  # a grain alone does not make a surface
        self.left = left
        padded = np.pad(height, 1, mode="edge")
        self.x = 0.5 * (edges[:-1] + edges[1:])
        self.height = np.median([padded[:-2], padded[1:-1], padded[2:]], axis=0)

    def at(self, x):
        return np.interp(x, self.x, self.height)

    def front(self, rest, rise):
        """Where the deformation ends: the last bin that has risen by more than `rise` above the surface at rest."""
        risen = np.flatnonzero(self.height > rest + rise)
        return self.x[risen[-1]] if len(risen) else self.x[0]

    def taper(self, rest, diameter):
        """Slope in degrees of the triangle with the same base, from the wall to the front, and the same area above
        the surface at rest. A line through the surface itself would follow the side of a single thrust sheet."""
        base = self.front(rest, 1.5 * diameter) - self.left
        if base < 2 * rest:
            return np.nan
        risen = np.sum((self.height - rest)[self.x < self.left + base]) * (self.x[1] - self.x[0])
        return np.degrees(np.arctan(2 * risen / base**2))
