"""What grains are in slices of a snapshot: solid fraction, velocity, stress."""

import numpy as np

from .errors import Error

COMPONENTS = {"x": 0, "y": 1, "z": 2}


class Profile:
    """Slices along an axis, `edges` and `middle` [m]. `fraction`: volume of grains over that of the slice, each grain cut where the slices
    end; `velocity` [slice][axis], its mean over that volume, nan where there are no grains; `temperature`, a third of the mean square of
    what velocities differ from it [m2/s2]; `stress` [slice][axis][axis] of the contacts, -sum f l / V over the part of the line between
    both centres, or from a centre to a wall, that is in the slice, positive where grains press on each other (Christoffersen et al.
    1981, eq. 2.9) [Pa], None without output.contacts = true; `kinetic_stress`, density times fraction times the mean of what velocities
    differ by, times itself [Pa]. Fixed grains count where `fixed` is true."""

    def __init__(self, snapshot, axis="z", slices=20, lower=None, upper=None, area=None, fixed=False):
        if "radius" not in snapshot:
            raise Error(f"{snapshot.path}: there are no grains in it")
        if axis not in COMPONENTS or not isinstance(slices, (int, np.integer)) or slices < 1:
            raise Error(f"a profile is along \"x\", \"y\" or \"z\", of one slice or more; not along \"{axis}\", of {slices}")
        if area is not None and not area > 0:
            raise Error(f"a profile has slices of an area above 0, not {area} m2")
        self.axis, along = axis, COMPONENTS[axis]
        domain = snapshot.scene["domain"]
        low, high = (np.array(domain[side], dtype=float) for side in ("lower", "upper"))
        self.edges = np.linspace(low[along] if lower is None else lower, high[along] if upper is None else upper, slices + 1)
        self.middle = 0.5 * (self.edges[1:] + self.edges[:-1])
        if not self.edges[0] < self.edges[-1]:
            raise Error(f"a profile from {self.edges[0]:g} to {self.edges[-1]:g} m has no slices")
        across = np.prod(np.delete(high - low, along)) if area is None else area
        self.volume = np.diff(self.edges) * across
        # Across a period what reaches over its end is in the slice at the other.
        self._shifts = (0, -(high - low)[along], (high - low)[along]) if snapshot.periodic()[along] else (0,)
        grains = snapshot["radius"] > 0
        if not fixed:
            grains &= snapshot.moves()
        self._of_grains(snapshot, grains, along)
        self.stress = self._of_contacts(snapshot, along) if snapshot.has_contacts() else None

    def _of_grains(self, snapshot, grains, along):
        x, r, v = snapshot["position"][grains, along], snapshot["radius"][grains], snapshot["velocity"][grains]
        density = np.array([g.get("density", np.nan) for g in snapshot.scene["group"]])[snapshot["group"][grains]]
        slices, images = len(self.middle), len(self._shifts)
        x = np.concatenate([x + shift for shift in self._shifts])
        r, v, density = np.tile(r, images), np.tile(v, (images, 1)), np.tile(density, images)
        self.fraction, self.temperature = np.zeros(slices), np.full(slices, np.nan)
        self.velocity, self.kinetic_stress = np.full((slices, 3), np.nan), np.zeros((slices, 3, 3))
        below = volume_below(self.edges[0] - x, r)
        for k in range(slices):
            next_below = volume_below(self.edges[k + 1] - x, r)
            part, below = next_below - below, next_below
            whole = part.sum()
            self.fraction[k] = whole / self.volume[k]
            if whole <= 0:
                continue
            self.velocity[k] = part @ v / whole
            off = v - self.velocity[k]
            self.temperature[k] = part @ (off**2).sum(axis=1) / whole / 3
            self.kinetic_stress[k] = np.einsum("n,ni,nj->ij", part * density, off, off) / self.volume[k]

    def _of_contacts(self, snapshot, along):
        contacts, position = snapshot.contacts, snapshot["position"]
        pair = contacts.second >= 0
        end = np.where(pair[:, None], position[contacts.second], contacts.point)
        line = snapshot.nearest_image(end - position[contacts.first])
        begin = position[contacts.first, along]
        low, high = (edge(begin, begin + line[:, along]) for edge in (np.minimum, np.maximum))
        dyad = -np.einsum("ni,nj->nij", contacts.force, line)
        low, high = (np.concatenate([end + shift for shift in self._shifts]) for end in (low, high))
        dyad = np.tile(dyad, (len(self._shifts), 1, 1))
        out = np.empty((len(self.middle), 3, 3))
        for k, (start, stop) in enumerate(zip(self.edges, self.edges[1:])):
            inside = np.clip(np.minimum(high, stop) - np.maximum(low, start), 0, None)
            with np.errstate(divide="ignore", invalid="ignore"):
                share = np.where(high > low, inside / (high - low), (start <= low) & (low < stop))
            out[k] = np.einsum("n,nij->ij", share, dyad) / self.volume[k]
        return out


def volume_below(height, radius):
    """Of balls, below planes so high above their centres."""
    h = np.clip(height, -radius, radius)
    return np.pi * (radius**2 * h - h**3 / 3 + 2 * radius**3 / 3)
