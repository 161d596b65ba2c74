"""Shear strain from the displacements of grains between two snapshots, and the straight faults in it."""

import numpy as np

WINDOW = 1.0  # standard deviation of the Gaussian that smooths displacements, in diameters
BAND = 5.0    # half the width of a shear band, in diameters


def smooth(values, sigma):
    """Convolution of a grid with a Gaussian of `sigma` cells along both axes."""
    half = int(np.ceil(3 * sigma))
    kernel = np.exp(-0.5 * (np.arange(-half, half + 1) / sigma) ** 2)
    kernel /= kernel.sum()
    for axis in (0, 1):
        values = np.apply_along_axis(np.convolve, axis, values, kernel, mode="same")
    return values


class Grid:
    """Square cells of half a diameter over the x-z plane."""

    def __init__(self, lower, upper, diameter):
        self.cell = 0.5 * diameter
        self.lower = np.array(lower)
        self.shape = tuple(np.ceil((np.array(upper) - self.lower) / self.cell).astype(int))
        self.sigma = WINDOW * diameter / self.cell

    def centres(self, axis):
        return self.lower[axis] + (np.arange(self.shape[axis]) + 0.5) * self.cell

    def index(self, place):
        k = np.floor((place - self.lower) / self.cell).astype(int)
        return np.clip(k[:, 0], 0, self.shape[0] - 1), np.clip(k[:, 1], 0, self.shape[1] - 1)

    def deposit(self, place, weight):
        """Smoothed sum of the weights."""
        total = np.zeros(self.shape)
        np.add.at(total, self.index(place), weight)
        return smooth(total, self.sigma)

    def corners(self):
        high = self.lower + np.array(self.shape) * self.cell
        return (self.lower[0], high[0], self.lower[1], high[1])


def shear_strain(before, after, grid):
    """Largest engineering shear strain in the x-z plane, on the grid in the state after; NaN outside the sand."""
    place = after.position[:, [0, 2]]
    way = place - before.position[:, [0, 2]]
    volume = after.volume
    weight = grid.deposit(place, volume)
    sand = weight > 0.4 * np.quantile(weight[weight > 0], 0.9)
    safe = np.where(weight > 0, weight, 1)
    u, w = (grid.deposit(place, volume * way[:, k]) / safe for k in (0, 1))
    ux, uz = np.gradient(u, grid.cell)
    wx, wz = np.gradient(w, grid.cell)
    gamma = np.hypot(ux - wz, uz + wx)
    inner = sand.copy()  # differences across the edge of the sand mean nothing
    for axis in (0, 1):
        for step in (1, -1):
            inner &= np.roll(sand, step, axis)
    return np.where(inner, gamma, np.nan)


class Fault:
    """A straight band from the floor to the surface. dip > 0: a forward thrust, which rises away from the wall."""

    def __init__(self, root, dip, top, strain):
        self.root, self.dip, self.top, self.strain = root, dip, top, strain

    @property
    def ends(self):
        x = self.root + self.top / np.tan(np.radians(self.dip))
        return (self.root, x), (0.0, self.top)


def find_faults(gamma, grid, surface, wall, diameter, most=6):
    """The lines along which the mean shear strain is largest, one after the other: what lies within BAND of a
    line is left out of the search for the next. Lines on which strain is below half the first one's, or 2.5 times
    the mean of the sand, are no faults."""
    strain = np.nan_to_num(gamma)
    mean = np.nanmean(gamma)
    dips = np.concatenate([np.arange(12.0, 66.0), -np.arange(12.0, 66.0)])
    xs, zs = grid.centres(0), grid.centres(1)
    mesh_x, mesh_z = np.meshgrid(xs, zs, indexing="ij")
    found = []
    for _ in range(most):
        best = None
        for dip in dips:
            tangent = np.tan(np.radians(dip))
            roots = np.arange(wall, xs[-1], diameter)
            # Points along each line, as many for all, from a diameter above the floor to one below the surface.
            share = np.linspace(0, 1, 40)
            top = surface.at(roots)
            for _ in range(3):  # where the line meets the surface
                top = surface.at(roots + top / tangent)
            ends = roots + top / tangent
            z = diameter + share[None, :] * np.maximum(top - 2 * diameter, diameter)[:, None]
            x = roots[:, None] + z / tangent
            i = np.clip(((x - grid.lower[0]) / grid.cell).astype(int), 0, grid.shape[0] - 1)
            k = np.clip(((z - grid.lower[1]) / grid.cell).astype(int), 0, grid.shape[1] - 1)
            values = strain[i, k]
            # Half of it the mean, half the weaker quarter: a band must go all the way through.
            score = 0.5 * values.mean(axis=1) + 0.5 * np.quantile(values, 0.25, axis=1)
            score[(ends < wall) | (ends > xs[-1])] = 0
            at = int(np.argmax(score))
            if best is None or score[at] > best.strain:
                best = Fault(float(roots[at]), float(dip), float(top[at]), float(score[at]))
        if best.strain < 2.5 * mean or (found and best.strain < 0.5 * found[0].strain):
            break
        found.append(best)
        angle = np.radians(best.dip)
        distance = np.abs((mesh_x - best.root) * np.sin(angle) - mesh_z * np.cos(angle))
        strain = np.where(distance < BAND * diameter, 0, strain)
    return found
