"""A scene that Python steps, on one rank or many: python3 script.py, or mpirun -n 4 python3 -m mpi4py script.py."""

import json
import os
import tomllib
import weakref
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


class Moment:
    """What a force is asked with: `time` [s], and the particles of this rank: `position`, `velocity`, `id`, `group`, `mass`, of grains
    `radius`, and every other field of the scene but sums that last for a part of a step, copies in one order. len(moment) of them."""

    def __init__(self, running, time):
        self._running, self.time = running, time

    def __getattr__(self, name):
        try:
            return self._running.field(name)
        except InputError as error:
            raise AttributeError(str(error)) from None

    def __len__(self):
        return self._running.shape[0]


class Simulation:
    """`scene`: a TOML file, or a dictionary like one; `set`: keys instead of the scene's, {"time.dt": 1e-4}; `comm`: of mpi4py,
    default all ranks; `force`: see there. The same bits as from the command line, on any number of ranks. All but time, steps, dt, scene,
    rank, unit() and field() are collective: every rank calls them. Raises InputError, GuardError (the physics) and OutputError, each
    an Error."""

    def __init__(self, scene, set=(), comm=None, force=None):  # noqa: A002  as on the command line
        try:
            from mpi4py import MPI
            import peperite_simulation as module
        except ImportError as error:
            raise Error(f"Simulation needs mpi4py and peperite_simulation, which -DPEPERITE_PYTHON=ON builds: {error}") from None
        self.comm = MPI.COMM_WORLD if comm is None else comm
        if not isinstance(self.comm, MPI.Intracomm) or self.comm == MPI.COMM_NULL:
            raise InputError(f"comm: is {comm!r}; give an mpi4py communicator within one group, such as MPI.COMM_WORLD")
        if isinstance(scene, Mapping):
            text = "".join(f"{quoted(key)} = {toml_of(value)}\n" for key, value in scene.items())
            read = module.parse_scene(text, "scene", settings(set))
        else:
            read = module.read_scene(str(scene), settings(set))
        if read.record:
            self._refuse(InputError, lambda: Path(read.record).exists() and os.path.getsize(read.record) > 0, read.record)
        self._running = module.Simulation(read, MPI._addressof(self.comm))
        self.scene = tomllib.loads(self._running.scene)
        self.force = force

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

    @property
    def force(self):
        """None, or what accelerates particles beside the scene: f(moment), asked in each step, returns an array [particle][component]
        of accelerations [m/s^2] for the particles of a Moment, which are this rank's. They act where gravity does, on fluids, solids,
        rigid bodies and grains; the time steps of fluids and solids heed them. Fixed grains, walls and what inlets lead stay as
        they are; what a wall is given, the fluid beside it is taken to have (its reference density). The diffusion of density knows
        domain.gravity alone: fluids that rest on f want terms.density_diffusion = 0. Energies know none of its work; melts are refused.
        Positions are those of the moment's time, velocities those of half a step before. Where f is a function of each particle's own
        state and of time, made of + - * / and sqrt (what else numpy has may depend on the place in an array), bits depend on no ranks;
        the order of particles does. An exception in f on any rank is one on all, and ends the simulation. No file holds f."""
        return self._force

    @force.setter
    def force(self, force):
        asked = self.comm.allgather(None if force is None else callable(force))
        if asked.count(asked[0]) != len(asked):
            raise InputError("force: some ranks set one, others none")
        if asked[0] is False:
            raise InputError("force: is no function of a moment that returns accelerations")
        me = weakref.proxy(self)  # the module's part of a simulation must not keep all of it alive
        self._running.accelerate(None if force is None else lambda time: me._accelerations(time))
        self._force = force

    def _accelerations(self, time):
        """Raises on all ranks or none: what f raised where it did, elsewhere that it has."""
        import numpy as np
        moment, raised, fault = Moment(self._running, time), None, None
        try:
            given = np.asarray(self._force(moment))
            if given.shape != self._running.shape or given.dtype.kind not in "fiu":
                raise InputError(f"force: returned {given.dtype}{list(given.shape)}, not numbers{list(self._running.shape)}, "
                                 "[particle][component]")
            given = given.astype(float)
            bad = ~np.isfinite(given).all(axis=1)
            if bad.any():
                ids = moment.id[bad]
                fault = (int(ids.min()), f"force: the acceleration of particle {ids.min()} is not finite: {given[bad][ids.argmin()]}")
        except BaseException as error:
            raised, fault = error, (-1, f"force: {type(error).__name__} on rank {self.rank}: {error}".splitlines()[0])
        faults = [found for found in self.comm.allgather(fault) if found is not None]
        if raised is not None:
            raise raised
        if faults:
            raise InputError(min(faults)[1])
        return given

    def add(self, group, position, radius, velocity=(0, 0, 0)):
        """Puts grains into a scene of grains alone that is open (an [[outlet]], an [[insertion]], domain.leaves), before the next step.
        Arrays of rank 0 count, [grain][component] and [grain] or one for all; those of other ranks may be None. `radius` within those of
        the group. Ids go on from those of the start and of all that came since; budgets count what comes. InputError, and nothing
        happens, where one is outside the domain or too deep in another or in a wall."""
        import numpy as np

        def arrays():
            if self.rank > 0:
                return None
            places = np.atleast_2d(np.asarray(position, dtype=float))
            if places.ndim != 2 or places.shape[1] != 3:
                raise ValueError(f"position is {list(np.shape(position))}, not [grain][3]")
            return (str(group), np.broadcast_to(np.asarray(radius, dtype=float), len(places)), places,
                    np.broadcast_to(np.asarray(velocity, dtype=float), places.shape))
        self._running.exchange([], *self._agreed("add", arrays)[0])

    def remove(self, where):
        """Takes grains out, before the next step, where add() could put them in: by a mask of this rank's particles, or by ids, of which
        any rank may name any. Budgets count them as gone."""
        import numpy as np

        def ids():
            chosen = np.asarray(where)
            if chosen.dtype == bool and chosen.shape == self._running.shape[:1]:
                return self.field("id")[chosen]
            if chosen.size and (chosen.dtype.kind not in "iu" or chosen.ndim != 1 or (chosen < 0).any()):
                raise ValueError(f"{chosen.dtype}{list(chosen.shape)} is neither a mask of this rank's particles nor ids")
            return chosen.astype(np.uint64)
        parts = self._agreed("remove", ids)
        self._running.exchange(sorted({int(i) for part in parts for i in part}), "", [], [], [])

    def _agreed(self, name, work):
        """Collective: what `work` returns on each rank, or what is wrong on the first where something is."""
        try:
            said = work(), None
        except Exception as error:  # whatever it is, the other ranks wait to hear of it
            said = None, f"{name}: {error}"
        said = self.comm.allgather(said)
        for _, wrong in said:
            if wrong is not None:
                raise InputError(wrong)
        return [value for value, _ in said]

    def step(self, steps=1):
        if steps < 0:
            raise InputError(f"step: {steps} steps; give 0 or more")
        self._running.step(steps)

    def run(self, until=None, steps=None, each=None):
        """On to the first step with t >= `until` [s] or to that many steps since the start; without both to the scene's end.
        `each(simulation)` after every step."""
        end = self.scene["time"]
        if until is None and steps is None:
            until, steps = end.get("until"), end.get("steps")
        if not (until is None or until >= 0) or not (steps is None or steps >= 0):
            raise InputError(f"run: until = {until}, steps = {steps}; give numbers from 0")
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

    def unit(self, monitor):
        """Of one of monitors(), "" of a number."""
        units = dict(zip(self._running.monitor_names(), self._running.monitor_units()))
        if monitor not in units:
            raise InputError(f"no monitor {monitor} in this scene")
        return units[monitor]

    def fingerprint(self):
        """Of every bit of the state."""
        return self._running.fingerprint()

    def save(self, path, overwrite=False):
        """Writes a snapshot, as runs do; instead of another one where that is said."""
        path = os.fspath(path)
        if "\0" in path:
            raise InputError(f"save: {path!r} is no name of a file")
        self._refuse(OutputError, lambda: os.path.lexists(path) and not (overwrite and is_snapshot(path)), path)
        part = path + ".tmp"  # what is written before it gets its name
        self._refuse(OutputError, lambda: os.path.lexists(part), part)
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
