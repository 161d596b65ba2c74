"""A run of the sandbox as a history of its shortening: profile, taper, faults and the order of the thrusts."""

import numpy as np

from strain import Grid, find_faults, shear_strain
from wedge import Surface

STEP = 0.004  # shortening between the two snapshots that show the active faults, at least [m]


class Moment:
    """One snapshot of the shortening."""

    def __init__(self, history, snapshot):
        run = history.run
        self.snapshot = snapshot
        self.shortening = history.shortening(snapshot)
        self.wall = history.wall_start + self.shortening
        self.surface = Surface(snapshot, run.diameter, self.wall, history.far)
        self.front = self.surface.front(history.rest, 1.5 * run.diameter)
        self.taper = self.surface.taper(history.rest, run.diameter)
        self.gamma, self.faults, self.since = None, [], 0.0


class Thrust:
    """A forward thrust when it first shows."""

    def __init__(self, shortening, fault):
        self.shortening, self.root, self.dip = shortening, fault.root, fault.dip


class History:
    def __init__(self, run):
        self.run = run
        self.begin, velocity = run.drive("back")
        self.speed = float(velocity[0])
        self.wall_start = run.wall("back")["point"][0]
        self.far = run.wall("front")["point"][0]
        used = [run[k] for k in np.flatnonzero(run.times >= self.begin * (1 - 1e-9))] or [run[-1]]
        self.first = used[0]
        edge = 0.25 * (self.far - self.wall_start)
        self.rest = float(np.median(Surface(self.first, run.diameter, self.wall_start + edge, self.far - 5 *
                                            run.diameter).height))
        self.grid = Grid((self.wall_start, 0.0), (self.far, 4 * self.rest), run.diameter)
        self.moments = [Moment(self, s) for s in used]
        self.find_faults()
        self.thrusts = self.order_thrusts()

    def shortening(self, snapshot):
        return max(0.0, self.speed * (snapshot.time - self.begin))

    def find_faults(self):
        for k, moment in enumerate(self.moments):
            earlier = [m for m in self.moments[:k] if moment.shortening - m.shortening >= 0.97 * STEP]
            if not earlier:
                continue
            before = earlier[-1]
            moment.since = before.shortening
            moment.gamma = shear_strain(before.snapshot, moment.snapshot, self.grid)
            moment.faults = find_faults(moment.gamma, self.grid, moment.surface, moment.wall, self.run.diameter)

    def order_thrusts(self):
        """A forward thrust is new where its root is more than half the layer ahead of all before it. The sand ahead
        of it has not moved, so roots are places in the sand as it was."""
        born = []
        for moment in self.moments:
            for fault in sorted(moment.faults, key=lambda f: f.root):
                if fault.dip > 0 and (not born or fault.root > max(t.root for t in born) + 0.5 * self.rest):
                    born.append(Thrust(moment.shortening, fault))
        return born

    def nearest(self, shortening):
        return min(self.moments, key=lambda m: abs(m.shortening - shortening))

    def layers(self, number):
        """Of each grain, by its height when the shortening began."""
        share = self.first.position[:, 2] / self.rest
        return np.clip((number * share).astype(int), 0, number - 1)

    def dips(self):
        """Of all active faults, weighted with their strain: mean and spread of forward and of back thrusts."""
        out = []
        for sign in (1, -1):
            chosen = [(abs(f.dip), f.strain) for m in self.moments for f in m.faults if sign * f.dip > 0]
            if not chosen:
                out.append((np.nan, np.nan))
                continue
            dip, weight = np.array(chosen).T
            mean = np.average(dip, weights=weight)
            out.append((mean, np.sqrt(np.average((dip - mean) ** 2, weights=weight))))
        return out
