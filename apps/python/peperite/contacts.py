"""The contacts of grains in a snapshot."""

import h5py
import numpy as np

from .errors import Error

WALL = np.uint64(1) << np.uint64(63)  # partners at or above it are walls


class Contacts:
    """One row a contact. `first`, `second`: rows of both grains in the snapshot, second -1 where it is a wall; `force` on
    the first [N]; `normal`: the unit vector from the first to the second; `point` [m]."""

    def __init__(self, snapshot):
        try:
            with h5py.File(snapshot.path) as file:
                if "contacts" not in file:
                    raise Error(f"{snapshot.path}: no contacts in it: run with output.contacts = true")
                ids, partner, self.force, self.point = (file["contacts"][k][()] for k in ("id", "partner", "force", "point"))
        except (OSError, KeyError) as error:
            raise Error(f"{snapshot.path}: cannot read contacts: {error}") from None
        known, position = snapshot["id"], snapshot["position"]
        self.first = np.searchsorted(known, ids)
        wall = partner >= WALL
        self.second = np.where(wall, -1, np.searchsorted(known, np.where(wall, 0, partner)))
        target = np.where(wall[:, None], self.point, position[self.second])
        way = snapshot.nearest_image(target - position[self.first])
        self.normal = way / np.linalg.norm(way, axis=1)[:, None]

    def __len__(self):
        return len(self.first)
