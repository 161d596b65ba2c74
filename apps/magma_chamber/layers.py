"""Grains against height in runs with melts: their share of the volume, the interface, and the layer that it traps."""

import numpy as np

STRAGGLERS = 0.02  # share of the volume, at the densest place


def volumes_below(heights, place, radius):
    """Of spheres at these places, below each of the heights, summed."""
    total = np.zeros(len(heights))
    for k, height in enumerate(heights):
        s = np.clip(height - place, -radius, radius)
        total[k] = np.sum(np.pi * (2 / 3 * radius**3 + radius**2 * s - s**3 / 3))
    return total


def grain_fractions(snapshot):
    """Share of the volume of each layer of cells that grains take, from the floor upwards."""
    grid = snapshot.grid
    edges, across = grid.faces(grid.up), np.prod((grid.high - grid.low)[: grid.up])
    if not snapshot.grain_count:
        return np.zeros(len(edges) - 1)
    below = volumes_below(edges, snapshot.grain("position")[:, grid.up], snapshot.grain("radius"))
    return np.diff(below) / (across * np.diff(edges))


def interface(grid, composition):
    """Height at which half of a layer is the upper melt; of several that nearest to where the interface would be flat."""
    mean, heights = grid.over_height(composition), grid.centres(grid.up)
    lower = mean if mean[0] > mean[-1] else 1 - mean  # share of the melt below
    flat = grid.low[grid.up] + lower.sum() * grid.edge[grid.up]
    crossings = [np.interp(0.5, lower[[k + 1, k]], heights[[k + 1, k]])
                 for k in np.flatnonzero((lower[:-1] >= 0.5) & (lower[1:] < 0.5))]
    return min(crossings, key=lambda height: abs(height - flat), default=np.nan)


def trapped_layer(edges, fractions, floor):
    """Thickness and mean fraction of the layer above `floor`: as far from its densest place as half of that fraction.
    A few stragglers are none."""
    centres, within = 0.5 * (edges[1:] + edges[:-1]), np.append(0, np.cumsum(fractions * np.diff(edges)))
    above = np.flatnonzero(edges[1:] > floor)
    if not len(above) or not fractions[above].max() > STRAGGLERS:
        return 0.0, np.nan
    peak = above[np.argmax(fractions[above])]
    half, ends = 0.5 * fractions[peak], []
    for step, last in ((-1, edges[0]), (1, edges[-1])):
        k = peak
        while 0 <= k + step < len(fractions) and fractions[k + step] >= half:
            k += step
        if not 0 <= k + step < len(fractions):
            ends.append(last)
            continue
        way = (fractions[k] - half) / (fractions[k] - fractions[k + step])
        ends.append(centres[k] + way * (centres[k + step] - centres[k]))
    thickness = ends[1] - ends[0]
    return thickness, np.diff(np.interp(ends, edges, within))[0] / thickness


class History:
    """What of the grains changes with time: fractions [time][height]; where there are two melts also the height of the
    interface, thickness and mean fraction of the layer above it, and the grains whose centres are below."""

    def __init__(self, run):
        self.run, self.edges = run, run.grid.faces(run.grid.up)
        self.times = run.times
        self.fractions = np.array([grain_fractions(s) for s in run])
        if not run.mixed:
            return
        self.interface = np.array([interface(run.grid, s.cell("composition")) for s in run])
        self.thickness, self.mean = np.array([trapped_layer(self.edges, fractions, floor) for fractions, floor
                                              in zip(self.fractions, self.interface)]).T
        self.below = np.array([np.sum(s.grain("position")[:, run.grid.up] < height)
                               for s, height in zip(run, self.interface)])

    def fallen(self, unit):
        """Between snapshots: middle times [s] and grains that have come below the interface per `unit` seconds."""
        span = np.diff(self.times)
        return 0.5 * (self.times[1:] + self.times[:-1]), np.diff(self.below) / span * unit
