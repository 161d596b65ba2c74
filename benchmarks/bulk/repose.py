"""Angle of repose of a discharged box over five seeds, against the fit of Zhou et al. (2002)."""

import numpy as np

from runs import snapshots

SEEDS = range(1, 6)
DIAMETER, HALF_WIDTH = 2e-3, 0.0792
FRICTION = 0.5  # of the grains and of the plate


def fit(arm):
    """Zhou et al. (2002): 68.61 mu_s^0.27 mu_sw^0.22 mu_r^0.06 mu_rw^0.12 d^-0.2, lengths in mm; `arm` [mm] of the rolling friction."""
    return 68.61 * FRICTION**0.49 * arm**0.18 * (1e3 * DIAMETER)**-0.2


EXPECTED = fit(0.05)


def surface(snapshot):
    edges = np.linspace(-HALF_WIDTH, HALF_WIDTH, 41)
    heap = snapshot.position[:, 2] > -DIAMETER
    top = (snapshot.position[:, 2] + snapshot.radius)[heap]
    inside = np.digitize(snapshot.position[heap, 0], edges) - 1
    height = np.array([np.sort(top[inside == k])[-3:].mean() for k in range(40)])
    return 0.5 * (edges[:-1] + edges[1:]), height


def angles(snapshot):
    """Of both sides, without the rounded top and the edge."""
    x, height = surface(snapshot)
    out = []
    for side in (-1, 1):
        used = (side * x > 0.15 * HALF_WIDTH) & (side * x < 0.9 * HALF_WIDTH)
        out.append(np.degrees(np.arctan(-side * np.polyfit(x[used], height[used], 1)[0])))
    return out


def measure(runner):
    futures = [runner.start(f"repose_{seed}", "repose.toml", f"start.seed={seed}") for seed in SEEDS]
    runs = [snapshots(f.result()) for f in futures]
    sides = np.array([angles(run[-1]) for run in runs])
    mean = sides.mean(axis=1)
    moved = max(np.max(np.abs(np.array(angles(run[-2])) - angles(run[-1]))) for run in runs)
    lines = [f"seed {seed}: {left:.1f} and {right:.1f} degrees" for seed, (left, right) in zip(SEEDS, sides)]
    lines.append(f"angle of repose {mean.mean():.1f} +- {mean.std(ddof=1):.1f} degrees over {len(SEEDS)} seeds; "
                 f"Zhou's fit {EXPECTED:.1f}, asked within 3; change in the last 0.2 s {moved:.2f} degrees")
    return lines, [run[-1] for run in runs]


def draw(axes, last):
    for snapshot in last:
        x, height = surface(snapshot)
        axes.plot(1e3 * x, 1e3 * height, lw=1)
    slope = np.tan(np.radians(EXPECTED))
    x = np.linspace(-HALF_WIDTH, HALF_WIDTH, 3)
    axes.plot(1e3 * x, 1e3 * slope * (HALF_WIDTH - abs(x)), "k--", label=f"Zhou's fit, {EXPECTED:.1f} degrees")
    axes.set(xlabel="x [mm]", ylabel="height [mm]", title="Angle of repose: five seeds", aspect="equal")
    axes.legend()
