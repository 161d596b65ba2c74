"""A settled box of sand for a million steps: kinetic energy, and how far grains creep."""

import numpy as np

from runs import Series, snapshots

DIAMETER = 1.6e-3


def measure(runner):
    folder = runner.run("quiet", "quiet.toml")
    series = Series(folder / "series.csv")
    time = series["t"]
    states = snapshots(folder)
    height = states[-1].position[:, 2]
    mass = 2500 * states[-1].volume
    potential = np.sum(mass * 9.81 * height)
    ratio = series["energy_kinetic"] / potential
    late = time > 0.5 * time[-1]
    early = next(s for s in states if s.time >= 0.2 * time[-1])
    way = np.linalg.norm(states[-1].position - early.position, axis=1)
    lines = [f"kinetic over potential energy: {np.median(ratio[(time > 0.1 * time[-1]) & ~late]):.1e} in the first half, "
             f"{np.median(ratio[late]):.1e} (at most {ratio[late].max():.1e}) in the second; asked below 1e-8",
             f"from step {early.step} to {states[-1].step} a grain moved {np.median(way) / DIAMETER:.1e} d in the median, "
             f"{way.max() / DIAMETER:.1e} d at most"]
    return lines, (time, ratio)


def draw(axes, result):
    time, ratio = result
    axes.semilogy(time / 17.5e-6, np.maximum(ratio, 1e-32))
    axes.set(xlabel="step", ylabel="kinetic / potential energy", title="A million steps at rest")
