"""A scene that Python steps, on one rank or many: python3 script.py, or mpirun -n 4 python3 -m mpi4py script.py."""

import json
import os
import tomllib
from collections.abc import Mapping
from pathlib import Path

import h5py

from .errors import Error, InputError, OutputError


def quoted(text):
    """A string of TOML: one of JSON, but for characters that it writes in pairs, and for DEL."""
    return json.dumps(str(text), ensure_ascii=False).replace("\x7f", "\\u007f").encode(errors="replace").decode()


def toml_of(value):
    """Of what tomllib reads, and of numbers and arrays of numpy, in one line."""
    value = value.tolist() if hasattr(value, "tolist") else value
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{quoted(key)} = {toml_of(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml_of, value)) + "]"
    if isinstance(value, (str, Path)):
        return quoted(value)
    if isinstance(value, (int, float)):
        return repr(value)
    raise InputError(f"a scene has no values of the type {type(value).__name__}")


def settings(values):
    """What --set takes: of {"time.dt": 1e-4}, or already so."""
    if isinstance(values, Mapping):
        return [f"{key}={toml_of(value)}" for key, value in values.items()]
    if isinstance(values, str) or not all(isinstance(value, str) for value in values):
        raise InputError("set: not a dictionary of keys, nor a list of texts like \"time.dt=1e-4\"")
    return list(values)


def is_snapshot(path):
    if os.path.islink(path) or not os.path.isfile(path) or not h5py.is_hdf5(path):
        return False
    try:
        with h5py.File(path) as file:
            return str(file.attrs.get("format", "")).startswith("peperite snapshot")
    except OSError:  # cut off, say
        return False


class Simulation:
    """`scene`: a TOML file, or a dictionary like one; `set`: keys instead of the scene's, {"time.dt": 1e-4}; `comm`: of mpi4py,
    default all ranks. The same bits as from the command line, on any number of ranks. All but time, steps, dt, scene, rank and
    field() are collective: every rank calls them. Raises InputError, GuardError (the physics) and OutputError, each an Error."""

    def __init__(self, scene, set=(), comm=None):  # noqa: A002  as on the command line
        try:
            from mpi4py import MPI
            import peperite_simulation as module
        except ImportError as error:
            raise Error(f"Simulation needs mpi4py and peperite_simulation, which -DPEPERITE_PYTHON=ON builds: {error}") from None
        self.comm = MPI.COMM_WORLD if comm is None else comm
        if isinstance(scene, Mapping):
            text = "".join(f"{quoted(key)} = {toml_of(value)}\n" for key, value in scene.items())
            read = module.parse_scene(text, "scene", settings(set))
        else:
            read = module.read_scene(str(scene), settings(set))
        if read.record:
            self._refuse(InputError, lambda: Path(read.record).exists() and os.path.getsize(read.record) > 0, read.record)
        self._running = module.Simulation(read, MPI._addressof(self.comm))
        self.scene = tomllib.loads(self._running.scene)

    def __repr__(self):
        return f"<simulation at step {self.steps}, t = {self.time:g} s>"

    @property
    def rank(self):
        return self.comm.rank

    @property
    def time(self):
        return self._running.time

    @property
    def steps(self):
        """Made since the start."""
        return self._running.steps

    @property
    def dt(self):
        """Of the last step [s]."""
        return self._running.dt

    def step(self, steps=1):
        self._running.step(steps)

    def run(self, until=None, steps=None, each=None):
        """On to the first step with t >= `until` [s] or to that many steps since the start; without both to the scene's end.
        `each(simulation)` after every step."""
        end = self.scene["time"]
        if until is None and steps is None:
            until, steps = end.get("until"), end.get("steps")
        while (until is None or self.time < until) and (steps is None or self.steps < steps):
            self.step()
            if each is not None:
                each(self)

    @property
    def fields(self):
        return tuple(self._running.fields())

    def field(self, name):
        """Of the particles of this rank, in an order of its own: a copy, [particle] or [particle][component]."""
        return self._running.field(name)

    def gather(self, name):
        """Of all particles by ascending id on rank 0, None on others."""
        import numpy as np
        parts = self.comm.gather((self.field("id"), self.field(name)))
        if parts is None:
            return None
        ids, values = (np.concatenate(columns) for columns in zip(*parts))
        return values[np.argsort(ids, kind="stable")]

    def monitors(self):
        """The numbers of a line of series.csv, by name."""
        return dict(zip(self._running.monitor_names(), self._running.monitors()))

    def fingerprint(self):
        """Of every bit of the state."""
        return self._running.fingerprint()

    def save(self, path, overwrite=False):
        """Writes a snapshot, as runs do; instead of another one where that is said."""
        path = os.fspath(path)
        self._refuse(OutputError, lambda: os.path.lexists(path) and not (overwrite and is_snapshot(path)), path)
        self._running.save(path)

    def _refuse(self, error, exists, path):
        """Collective: what the first rank finds."""
        def looked():
            try:
                return "exists and would be overwritten; name another file, or move it away" if exists() else None
            except OSError as problem:
                return f"cannot be looked at: {problem}"
        found = self.comm.bcast(looked() if self.rank == 0 else None)
        if found is not None:
            raise error(f"{path} {found}")
