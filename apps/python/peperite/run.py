"""The folder of a run: its snapshots, its time series, its report."""

import functools
import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

import h5py
import numpy as np

from .errors import Error
from .snapshot import Snapshot, resolved


class Series(Mapping):
    """Columns of series.csv by name, "t" among them, and their units. A last line that is not complete is left out: the run
    may still be writing."""

    def __init__(self, path):
        self.path = Path(path)
        try:
            lines = self.path.read_text().rpartition("\n")[0].splitlines()
            titles = [re.fullmatch(r"(.*?)(?: \[(.*)\])?", title) for title in lines[0].split(",")] if lines else []
            names = [title[1] for title in titles]
            rows = [[float(value) for value in line.split(",")] for line in lines[1:]]
            if "t" not in names or not rows:
                raise ValueError("no time series in it")
            if any(len(row) != len(names) for row in rows):
                raise ValueError("lines of different lengths")
        except (OSError, ValueError) as error:
            raise Error(f"{path}: cannot read it: {error}") from None
        self._columns = dict(zip(names, np.array(rows).T))
        self._units = {title[1]: title[2] or "" for title in titles}

    def __getitem__(self, name):
        if name not in self._columns:
            raise Error(f"{self.path}: no column {name}: the scene lacks its [[monitor]]")
        return self._columns[name]

    def unit(self, name):
        """"" of a number, and of what a run of before 0.2 wrote."""
        self[name]  # there is one
        return self._units[name]

    def __contains__(self, name):
        return name in self._columns

    def __iter__(self):
        return iter(self._columns)

    def __len__(self):
        return len(self._columns)


class Run(Sequence):
    """run[k] is the k-th snapshot, read anew each time; run[-1] the last. `scene` is the resolved one, as a dictionary."""

    snapshot_type = Snapshot

    def __init__(self, folder):
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise Error(f"{folder}: no such folder")
        numbers = ((re.fullmatch(r"snapshot_(\d+)\.h5", path.name), path) for path in self.folder.glob("snapshot_*.h5"))
        self.files = [path for _, path in sorted((int(number[1]), path) for number, path in numbers if number)]
        self.scene = self[-1].scene if self.files else self._resolved()
        self.name = self.folder.resolve().name
        self.title = self.scene.get("title") or self.name

    def __repr__(self):
        return f"<run {self.title}, {len(self)} snapshots: {self.folder}>"

    def _resolved(self):
        """The scene of a run that has written no snapshot."""
        path = self.folder / "scene.toml"
        try:
            return resolved(path.read_text())
        except OSError:
            raise Error(f"{self.folder}: no snapshot_*.h5 in it, nor a scene.toml: not the folder of a run") from None
        except ValueError as error:
            raise Error(f"{path}: not a resolved scene: {error}") from None

    def __len__(self):
        return len(self.files)

    def __iter__(self):
        return map(self.snapshot_type, self.files)

    def __getitem__(self, k):
        if not self.files:
            raise Error(f"{self.folder}: no snapshot_*.h5 in it")
        return [self.snapshot_type(path) for path in self.files[k]] if isinstance(k, slice) else self.snapshot_type(self.files[k])

    @functools.cached_property
    def times(self):
        """Of the snapshots [s]."""
        def time_of(path):
            try:
                with h5py.File(path) as file:
                    return float(file.attrs["time"])
            except (OSError, KeyError, TypeError, ValueError) as error:
                raise Error(f"{path}: not a snapshot: {error}") from None
        return np.array([time_of(path) for path in self.files])

    def at(self, time):
        """The snapshot nearest to `time` [s]."""
        return self[int(np.argmin(np.abs(self.times - time))) if self.files else 0]

    def spread(self, number):
        """So many snapshots, the first and the last among them."""
        return [self[k] for k in np.unique(np.linspace(0, len(self) - 1, number).round().astype(int))]

    @functools.cached_property
    def series(self):
        return Series(self.folder / "series.csv")

    @property
    def goes_on(self):
        """A program is writing to it, or died there."""
        return (self.folder / "run.lock").exists()

    @functools.cached_property
    def perf(self):
        """The report that a run leaves at its end, or None before."""
        path = self.folder / "perf.json"
        if not path.is_file():
            return None
        try:
            return dict(json.loads(path.read_text()))
        except (OSError, ValueError, TypeError) as error:
            raise Error(f"{path}: cannot read it: {error}") from None

    def plot(self, out=None, **options):
        """Draws what its scene has, into `out` or into its folder; paths of the pictures. Options are those of `peperite plot`:
        plot(time=0.5, draw="particles")."""
        from .drawing import draw_run
        return list(draw_run(self, out, **options))
