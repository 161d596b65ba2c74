"""Shear strain from the displacements of grains between two snapshots, and the straight faults in it."""

import numpy as np

WINDOW = 1.0  # standard deviation of the Gaussian that smooths displacements, in diameters
BAND = 5.0    # half the width of a shear band, in diameters
DIPS = np.arange(12.0, 66.0)


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


def along(strain, grid, surface, diameter, dip, roots):
    """Strain at forty points of each line from the floor, a diameter above it, to a diameter below the surface; the
    height and x at which lines meet the surface."""
    tangent = np.tan(np.radians(dip))
    top = surface.at(roots)
    for _ in range(3):
        top = surface.at(roots + top / tangent)
    z = diameter + np.linspace(0, 1, 40)[None, :] * np.maximum(top - 2 * diameter, diameter)[:, None]
    i, k = grid.index(np.stack([(roots[:, None] + z / tangent).ravel(), z.ravel()], axis=1))
    return strain[i, k].reshape(z.shape), top, roots + top / tangent


def best_of_dip(strain, grid, surface, wall, diameter, dip):
    """The line of that dip with the most strain."""
    roots = np.arange(wall, grid.centres(0)[-1], diameter)
    values, top, ends = along(strain, grid, surface, diameter, dip, roots)
    # Half of it the mean, half the weaker quarter: a band must go all the way through.
    score = 0.5 * values.mean(axis=1) + 0.5 * np.quantile(values, 0.25, axis=1)
    score[(ends < wall) | (ends > grid.centres(0)[-1])] = 0
    at = int(np.argmax(score))
    return Fault(float(roots[at]), float(dip), float(top[at]), float(score[at]))


def stands_out(blurred, grid, surface, wall, diameter, fault):
    """Strain on the line is half as large again as on the lines beside the band, on both sides of it."""
    aside = 1.6 * BAND * diameter / abs(np.sin(np.radians(fault.dip)))
    roots = fault.root + np.array([-aside, aside])
    values, _, ends = along(blurred, grid, surface, diameter, fault.dip, roots)
    inside = (roots > wall) & (ends > wall)
    return fault.strain > 1.5 * np.max(values.mean(axis=1), where=inside, initial=0)


def find_faults(gamma, grid, surface, wall, diameter, most=6):
    """The lines along which the mean shear strain is largest, one after the other: what lies within BAND of a
    line is left out of the search for more lines of its sense. Lines on which strain is below half the first
    one's, or 2.5 times the mean of the sand, or not much above that on both sides, are no faults."""
    blurred = smooth(np.nan_to_num(gamma), 1.5 * diameter / grid.cell)  # lines go through the middle of wide bands
    strain = {1: blurred, -1: blurred.copy()}
    mean = np.nanmean(gamma)
    mesh_x, mesh_z = np.meshgrid(grid.centres(0), grid.centres(1), indexing="ij")

    def best(sense):
        lines = (best_of_dip(strain[sense], grid, surface, wall, diameter, sense * dip) for dip in DIPS)
        return max(lines, key=lambda line: line.strain)

    found, next_one, strongest = [], {sense: best(sense) for sense in strain}, 0.0
    for _ in range(2 * most):
        sense = max(next_one, key=lambda s: next_one[s].strain)
        fault = next_one[sense]
        strongest = max(strongest, fault.strain)
        if fault.strain < max(2.5 * mean, 0.5 * strongest) or len(found) == most:
            break
        if stands_out(blurred, grid, surface, wall, diameter, fault):
            found.append(fault)
        angle = np.radians(fault.dip)
        distance = np.abs((mesh_x - fault.root) * np.sin(angle) - mesh_z * np.cos(angle))
        strain[sense] = np.where(distance < BAND * diameter, 0, strain[sense])
        next_one[sense] = best(sense)
    return found
