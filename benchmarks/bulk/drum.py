"""A drum of triangles that turns, half full: slope of the bed by its end walls, beside LAMMPS's (if there is an `lmp`) and an experiment
(Geitani et al. 2023)."""

import shutil

import numpy as np

import speed
from peers import bed
from rings import widened, write_rings
from runs import snapshots, source

RADIUS, LENGTH = 69e-3, 185e-3
SEEDS = range(1, 4)
UNTIL, STEADY = 5.0, 4.0  # [s]: from STEADY on the slope is measured
PUBLISHED = 26  # degrees, measured
DIAMETER = 5.95e-3
PEER_STEP, PEER_FRAME = 3e-5, 600  # [s]; steps between frames


def heights(position, slab):
    """Of the ten highest beads within 3 mm of eight places across the middle of the surface."""
    x, y = position[slab(position[:, 2]), :2].T
    places = np.linspace(-RADIUS / 2, RADIUS / 2, 8)
    return places, np.array([np.sort(y[abs(x - at) < 3e-3])[-10:].mean() for at in places])


def by_ends(z):
    """Of the experiment's reading."""
    return abs(z - LENGTH / 2) > 70e-3


def in_middle(z):
    return abs(z - LENGTH / 2) < LENGTH / 2 - 70e-3


def slope(frames, slab):
    """Of the mean surface [degrees]."""
    surfaces = [heights(frame, slab) for frame in frames]
    return np.degrees(np.arctan(abs(np.polyfit(surfaces[0][0], np.mean([height for _, height in surfaces], axis=0), 1)[0])))


def of_lammps(work, start):
    """Its frames of the last second, from the same start."""
    folder = work / "drum_lammps"
    frames = {int(path.suffix[1:]): path for path in folder.glob("frame.*")}
    steps = round(UNTIL / PEER_STEP)
    if max(frames, default=0) < steps // PEER_FRAME * PEER_FRAME:
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        still = bed.Bed(np.full(len(start), DIAMETER), start, np.zeros_like(start), (RADIUS + 1e-3, RADIUS + 1e-3, LENGTH + 1e-3))
        bed.write_data(still, folder / "beads.data", (-RADIUS - 1e-3, -RADIUS - 1e-3, -1e-3))
        speed.run(["lmp", "-in", source / "benchmarks/peers/lmp_drum.in", "-log", "none", "-var", "data", folder / "beads.data",
                   "-var", "steps", str(steps), "-var", "every", str(PEER_FRAME), "-var", "out", f"{folder}/frame.*"])
        frames = {int(path.suffix[1:]): path for path in folder.glob("frame.*")}
    return [np.loadtxt(path, skiprows=9) for step, path in sorted(frames.items()) if step * PEER_STEP >= STEADY]


def measure(runner):
    mesh = runner.work / "drum.obj"
    radius, length = 1e3 * widened(RADIUS), 1e3 * LENGTH
    write_rings(mesh, [(0, 0), (radius, 0), (radius, length), (0, length)])
    futures = [runner.start(f"drum_{seed}", "drum.toml", f"mesh.drum.file={mesh}", f"start.seed={seed}") for seed in SEEDS]
    runs = [snapshots(f.result()) for f in futures]
    steady = [[s.position for s in run if s.time >= STEADY] for run in runs]
    peer = of_lammps(runner.work, runs[0][0].position) if shutil.which("lmp") else None
    lines = [f"{len(runs[0][0].radius)} beads, slope over the last second, {len(SEEDS)} seeds"]
    for name, slab in (("by the ends", by_ends), ("in the middle", in_middle)):
        slopes = [slope(frames, slab) for frames in steady]
        lines.append(f"{name} {np.mean(slopes):.1f} +- {np.std(slopes, ddof=1):.1f} degrees"
                     + (f"; LAMMPS {slope(peer, slab):.1f}" if peer else "") + (f"; measured {PUBLISHED}" if slab is by_ends else ""))
    return lines, runs[0]


def draw(axes, run):
    last = run[-1]
    seen = by_ends(last.position[:, 2])
    x, y = 1e3 * last.position[seen, :2].T
    axes.scatter(x, y, s=2, c=1e3 * np.hypot(*last.velocity[seen, :2].T), cmap="viridis")
    places, height = heights(last.position, by_ends)
    middle = height.mean()
    rise = np.sign(np.polyfit(places, height, 1)[0]) * np.tan(np.radians(PUBLISHED))
    axes.plot(1e3 * places, 1e3 * (middle + rise * places), "k--", label=f"{PUBLISHED} degrees")
    turn = np.linspace(0, 2 * np.pi, 100)
    axes.plot(1e3 * RADIUS * np.cos(turn), 1e3 * RADIUS * np.sin(turn), "k", lw=0.8)
    axes.set(xlabel="x [mm]", ylabel="y [mm]", title="Drum: beads by the ends, by speed", aspect="equal")
    axes.legend(loc="upper right")
