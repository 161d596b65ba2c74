"""Dam break: front against Martin & Moyce (1952), energy, and whether it runs to its end."""

import numpy as np

SCENE = "dam_break.toml"
SIZES = (20, 40)
ERROR = "front: largest error of dZ/dT"

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "artificial viscosity 0.02": ("terms.artificial_viscosity=0.02",),
    "seed's kernel": ("kernel.h_over_dx=0.8333333333333334",),
    "ida": ("formulation=ida", "terms.density_diffusion="),
}
# Column twice as high as wide (n^2 = 2): T = t sqrt(2 g / a), Z = x / a; a = 1 m here.
T = np.array([1.219, 1.997, 2.547, 3.345, 4.034, 5.091, 6.306])
Z = np.array([1.474, 2.292, 2.995, 4.134, 4.944, 6.980, 8.966])


def settings(n):
    """A column 1 m wide and 2 m high, n particles across."""
    layers = 4 / n
    return (f"start.spacing={1 / n}", "start.region.2.upper=[1, 2]", "start.surface_height=2", "time.until=1.5",
            "domain.upper=[13, 8]", f"start.lower={[-layers, -layers]}", f"start.upper={[12 + layers, 4]}",
            "start.region.1.upper=[12, 4]", "group.water.sound_speed=62.6", "output.snapshot_interval=0.01")


def front(snapshot, dx, rows=1):
    """Of the tongue on the floor."""
    x, y = snapshot.position.T[:2]
    return np.sort(x[y < 0.3])[-3 * rows:].mean() + 0.5 * dx


def measure(run, rows=1):
    """In 3D there are so many `rows` of particles across."""
    snapshots = run.snapshots()
    time = np.array([s.time for s in snapshots]) * np.sqrt(2 * 9.81)
    dx = np.sqrt(2 * rows / len(snapshots[0].position))
    ours = np.interp(T, time, [front(s, dx, rows) for s in snapshots])
    lead = np.mean(ours - Z)
    series = run.series()
    energy = sum(series[k] for k in series if k.startswith("energy"))
    return {"front ahead of the experiment / a": lead, "front: largest error of dZ/dT":
            np.abs(np.diff(ours) / np.diff(Z) - 1).max(),
            "front, shifted by it: largest error": np.abs((ours - lead) / Z - 1).max(),
            "energy / first": energy[-1] / energy[0],
            "largest rise of energy": np.max(energy - np.minimum.accumulate(energy)) / energy[0]}
