"""One snapshot: snapshot_<step>.h5."""

import functools
import tomllib
from pathlib import Path

import h5py
import numpy as np

from .contacts import Contacts
from .errors import Error
from .profile import Profile


@functools.lru_cache(maxsize=8)  # the same text in all snapshots of a run
def resolved(text):
    """The scene that files hold, as a dictionary; ValueError where it is none."""
    scene = tomllib.loads(text)
    for key in ("group", "dimension", "domain"):
        if key not in scene:
            raise ValueError(f"no {key} in it")
    return scene


class Snapshot:
    """Particles at one time, by ascending id, whatever their order in the file. A field is read when it is first asked
    for: snapshot["velocity"], or snapshot.velocity, is an array [particle][axis] that is not to be written to."""

    def __init__(self, path):
        self.path = Path(path)
        self._kept = {}
        try:
            with h5py.File(path) as file:
                self.time, self.step = float(file.attrs["time"]), int(file.attrs["step"])
                self.scene = resolved(file.attrs["scene"])
                self.fields = tuple(file["particles"])
        except (OSError, KeyError, ValueError, TypeError, AttributeError) as error:
            raise Error(f"{path}: not a snapshot: {error}") from None

    def __repr__(self):
        return f"<snapshot of step {self.step}, t = {self.time:g} s: {self.path}>"

    def __contains__(self, field):
        return field in self.fields

    def __len__(self):
        return len(self["id"])

    def __getitem__(self, field):
        if field not in self.fields:
            raise Error(f"{self.path}: no field \"{field}\" in it; there are {', '.join(self.fields)}")
        if field not in self._kept:
            values = self._read(field)
            self._check(field, values)
            self._kept[field] = values if self._order is None else values[self._order]
            self._kept[field].setflags(write=False)
        return self._kept[field]

    def __getattr__(self, name):
        if name in self.__dict__.get("fields", ()):
            return self[name]
        raise AttributeError(f"no field \"{name}\" in this snapshot")

    def __dir__(self):
        return [*super().__dir__(), *self.fields]

    def get(self, field):
        """The field, or None where the scene has none such."""
        return self[field] if field in self.fields else None

    def _read(self, field):
        try:
            with h5py.File(self.path) as file:
                return file["particles"][field][()]
        except (OSError, KeyError, TypeError) as error:
            raise Error(f"{self.path}: cannot read {field}: {error}") from None

    def _check(self, field, values):
        """A damaged file is refused here, not where its numbers are used."""
        vector = field in ("position", "velocity")
        if not isinstance(values, np.ndarray) or values.dtype.kind not in "iuf" or len(values) != len(self._ids) or (
                vector and values.shape[1:] != (self.scene["dimension"],)):
            raise Error(f"{self.path}: {field} is not a row of numbers for each particle")
        if field == "group" and len(values) and not 0 <= values.min() <= values.max() < len(self.scene["group"]):
            raise Error(f"{self.path}: group: the scene has {len(self.scene['group'])} groups, numbers are {values.min()} to {values.max()}")
        if field == "position" and not np.isfinite(values).all():
            raise Error(f"{self.path}: position: some are no numbers")

    @functools.cached_property
    def _ids(self):
        ids = self._read("id")
        if not isinstance(ids, np.ndarray) or ids.ndim != 1 or ids.dtype.kind not in "iu":
            raise Error(f"{self.path}: id is not an integer for each particle")
        return ids

    @functools.cached_property
    def _order(self):
        """Rows by ascending id; None where they are so already. Long snapshots are in the order of their owners."""
        ids = self._ids
        return None if np.all(ids[:-1] <= ids[1:]) else np.argsort(ids, kind="stable")

    def _attribute(self, field, name, without):
        with h5py.File(self.path) as file:
            return file["particles"][field].attrs.get(name, without)

    def unit(self, field):
        """"m/s", ..., "1" of numbers, "quantum" of lengths as integers."""
        self[field]
        return self._attribute(field, "unit", "1")

    def meaning(self, field):
        self[field]
        return self._attribute(field, "meaning", "")

    def metres(self, field):
        """Of a field whose unit is the quantum of length."""
        if self.unit(field) != "quantum":
            raise Error(f"{self.path}: {field} is in {self.unit(field)}, no number of quanta")
        with h5py.File(self.path) as file:
            return self[field] * file.attrs["quantum"]

    def component(self, field, name):
        """One of a vector ("x") or of a symmetric tensor ("xz"), in the order that the file names."""
        values = self[field]
        if values.ndim != 2:
            raise Error(f"{self.path}: {field} has no components")
        usual = {1: "x", 2: "x y", 3: "x y z" if self.scene["dimension"] == 3 else "xx yy xy", 6: "xx yy zz xy xz yz"}
        names = self._attribute(field, "components", usual.get(values.shape[1], "")).split()
        if name not in names:
            raise Error(f"{self.path}: no component \"{name}\" of {field}; there are {', '.join(names)}")
        return values[:, names.index(name)]

    def where(self, group=None, kind=None):
        """Which particles are of the group of this name, or of the groups of this kind ("fluid", "wall", ...)."""
        groups = self.scene["group"]
        if group is not None and group not in (g["name"] for g in groups):
            raise Error(f"{self.path}: no group \"{group}\"; there are {', '.join(g['name'] for g in groups)}")
        chosen = [group in (None, g["name"]) and kind in (None, g["kind"]) for g in groups]
        return np.array(chosen)[self["group"]]

    def moves(self):
        """Which particles are neither walls nor fixed grains."""
        return np.array([g["kind"] != "wall" and not g.get("fixed", False) for g in self.scene["group"]])[self["group"]]

    def has_contacts(self):
        with h5py.File(self.path) as file:
            return "contacts" in file

    def speed(self):
        return np.linalg.norm(self["velocity"], axis=1)

    def periodic(self):
        """Along which axes."""
        domain = self.scene["domain"]
        return np.array(domain.get("periodic", [False] * len(domain["upper"])))

    def nearest_image(self, way):
        """Differences of positions, the shortest where axes are periodic."""
        domain = self.scene["domain"]
        length = np.array(domain["upper"], dtype=float) - np.array(domain["lower"], dtype=float)
        around = self.periodic()
        return way - np.where(around, length * np.round(way / length), 0)

    def displacement_since(self, first):
        """Of each particle [m]; NaN if it was not there. Periods count where a particle went less than half of one."""
        ids, before = self["id"], first["id"]
        if not len(before):
            return np.full(self["position"].shape, np.nan)
        place = np.minimum(np.searchsorted(before, ids), len(before) - 1)
        way = self.nearest_image(self["position"] - first["position"][place])
        return np.where((before[place] == ids)[:, None], way, np.nan)

    def profile(self, axis="z", **options):
        """Of grains in slices along an axis: Profile."""
        return Profile(self, axis, **options)

    @functools.cached_property
    def contacts(self):
        """Between grains, and of grains with walls (output.contacts = true)."""
        return Contacts(self)
