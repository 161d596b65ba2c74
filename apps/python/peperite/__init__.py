"""The runs of Peperite in Python.

    import peperite
    run = peperite.open("out")            # the folder of a run, which may still be going on
    run.times, len(run)                   # of its snapshots [s]
    last = run[-1]                        # or run.at(0.5), the one nearest to 0.5 s
    last["position"], last.unit("pressure")
    last["pressure"][last.where(group="melt")]
    last.profile("z", slices=30).stress   # of grains in slices: fraction, velocity, stress
    run.series["t"]                       # monitors: columns of series.csv
    run.plot()                            # pictures of any scene, into its folder; returns their paths

    simulation = peperite.Simulation("scene.toml", set={"time.cfl": 0.5})     # or of a dictionary; on one rank or many
    simulation.run(until=0.1)
    simulation.field("velocity"), simulation.monitors(), simulation.fingerprint()

Nothing is read before it is asked for, and no snapshot is kept but by its user: to open a run of 10,000 snapshots takes
as much memory as one of 10. Units are SI. What is wrong raises peperite.Error, one line.
"""

from .contacts import Contacts
from .errors import Error, GuardError, InputError, OutputError
from .profile import Profile
from .run import Run, Series
from .simulation import Simulation
from .snapshot import Snapshot

__all__ = ["Contacts", "Error", "GuardError", "InputError", "OutputError", "Profile", "Run", "Series", "Simulation", "Snapshot", "open"]


def open(folder):  # noqa: A001  as in numpy, h5py and gzip
    """The run in this folder; Error where there is no snapshot in it."""
    return Run(folder)
