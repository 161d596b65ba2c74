"""A cone poured from a funnel onto a round table, both of triangles: its slope over two seeds, against the fit of Zhou et al. (2002)."""

import numpy as np

import repose
from rings import write_rings
from runs import snapshots

SEEDS = range(1, 3)
EXPECTED = repose.fit(0.1)
RADIUS = 40  # of the table [mm]
EDGES = np.linspace(0.2, 0.85, 14) * RADIUS * 1e-3  # between the rounded top and the edge


def surface(snapshot):
    """Mean height of the highest grain in each of 24 sectors, ring by ring."""
    x, y, z = snapshot.position.T
    ring = np.digitize(np.hypot(x, y), EDGES)
    sector = np.floor((np.arctan2(y, x) / (2 * np.pi) + 0.5) * 24).astype(int) % 24
    top = z + snapshot.radius
    return 0.5 * (EDGES[1:] + EDGES[:-1]), np.array([np.mean([top[(ring == r) & (sector == s)].max() for s in range(24) if ((ring == r) & (sector == s)).any()])
                                                      for r in range(1, len(EDGES))])


def angle(snapshot):
    return np.degrees(np.arctan(-np.polyfit(*surface(snapshot), 1)[0]))


def measure(runner):
    table, funnel = runner.work / "table.obj", runner.work / "funnel.obj"
    write_rings(table, [(0, 0), (RADIUS, 0), (RADIUS, 1.5)])  # a rim, so that the grains lie on grains
    write_rings(funnel, [(8, 50), (40, 80), (40, 145)])
    meshes = (f"mesh.table.file={table}", f"mesh.funnel.file={funnel}")
    futures = [runner.start(f"cone_{seed}", "cone.toml", *meshes, f"start.seed={seed}") for seed in SEEDS]
    runs = [snapshots(f.result()) for f in futures]
    slopes = np.array([angle(run[-1]) for run in runs])
    moved = max(abs(angle(run[-2]) - angle(run[-1])) for run in runs)
    fell = np.mean([len(run[0].radius) - len(run[-1].radius) for run in runs])
    return [f"{len(runs[0][0].radius)} grains of which {fell:.0f} fell off the table",
            f"slope {slopes.mean():.1f} +- {slopes.std(ddof=1):.1f} degrees over {len(SEEDS)} seeds; Zhou's fit {EXPECTED:.1f}, asked within 3; "
            f"change in the last 0.2 s {moved:.2f} degrees"], [run[-1] for run in runs]


def draw(axes, last):
    for snapshot in last:
        r, height = surface(snapshot)
        axes.plot(1e3 * r, 1e3 * height, lw=1)
    slope = np.tan(np.radians(EXPECTED))
    axes.plot(1e3 * r, 1e3 * (height.mean() - slope * (r - r.mean())), "k--", label=f"Zhou's fit, {EXPECTED:.1f} degrees")
    axes.set(xlabel="distance from the axis [mm]", ylabel="height [mm]", title="Cone: two seeds", aspect="equal")
    axes.legend()
