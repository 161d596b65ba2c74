"""Flow down a rough incline (Silbert et al. 2001): which angles flow steadily, and the Bagnold profile."""

import numpy as np

from runs import snapshots, write_start

D, G = 1e-3, 9.81
TAU = np.sqrt(D / G)
SIDE = 9.9 # of the periodic base [d]
BASE = (8.0, 9.3)  # the slice of the settled packing that becomes the base [d]
ANGLES = (20, 22, 24, 26)
START, END, SNAPSHOTS = 150, 300, 50  # averages are taken over times from START to END [tau]


def prepare(runner):
    """Position above the base, and whether a grain is of it."""
    settled = snapshots(runner.run("incline_packing", "incline.toml"))[-1]
    x = settled.position.copy()
    used = x[:, 2] >= BASE[0] * D
    x, radius = x[used], settled.radius[used]
    x[:, 2] -= BASE[1] * D
    return x, radius, (x[:, 2] < 0)


def guess(angle, z):
    """Bagnold's profile with Jop's mu(I), so that the flow begins near its steady state [m/s]."""
    mu_s, mu_2, i_0 = 0.382, 0.643, 0.279
    mu = min(np.tan(np.radians(angle)), 0.95 * mu_2)
    inertial = i_0 * (mu - mu_s) / (mu_2 - mu) if mu > mu_s else 0.02
    h = z.max()
    top = 2 / 3 * inertial * np.sqrt(0.59 * G * np.cos(np.radians(angle))) * h**1.5 / D
    return top * (1 - (1 - np.clip(z, 0, h) / h) ** 1.5)


def begin(runner, packing, angle):
    x, radius, base = packing
    velocity = np.zeros_like(x)
    velocity[:, 0] = np.where(base, 0, guess(angle, x[:, 2]))
    start = runner.work / f"incline_{angle}.h5"
    write_start(start, x + [0, 0, 2 * D], radius, np.where(base, 1, 0), velocity)
    tilt = np.radians(angle)
    return runner.start(f"incline_{angle}", "incline.toml", "start.jitter=", "start.spacing=", "start.origin=",
                        "start.lower=", "start.upper=", "start.region=", f"start.file={start}",
                        f"domain.gravity=[{G * np.sin(tilt):.9g}, 0, {-G * np.cos(tilt):.9g}]",
                        f"time.until={END * TAU:.9g}",
                        f"output.snapshot_interval={(END - START) * TAU / SNAPSHOTS:.9g}")


class Flow:
    def __init__(self, angle, folder):
        used = [s for s in snapshots(folder) if s.time >= START * TAU]
        self.angle = angle
        group = used[0].group
        moving = group == 0
        base_top = used[0].position[~moving, 2].max()
        edges = np.arange(0, 60) * D
        z = np.concatenate([s.position[moving, 2] - base_top for s in used])
        u = np.concatenate([s.velocity[moving, 0] for s in used])
        inside = np.digitize(z, edges) - 1
        inside[z < 0] = -1
        count = np.bincount(inside[inside >= 0], minlength=60)[:59]
        self.z = 0.5 * (edges[:-1] + edges[1:]) / D
        sums = np.bincount(inside[inside >= 0], weights=u[inside >= 0], minlength=60)[:59]
        self.u = np.divide(sums, count, out=np.zeros(59), where=count > 0) / np.sqrt(G * D)
        self.fraction = count / len(used) * (np.pi / 6) / SIDE**2
        bulk = self.fraction > 0.3
        self.h = self.z[bulk].max() + 0.5
        means = np.array([s.velocity[moving, 0].mean() for s in used]) / np.sqrt(G * D)
        self.mean = means.mean()
        half = len(means) // 2
        self.drift = means[half:].mean() / max(means[:half].mean(), 1e-12) - 1
        self.middle = (self.z > 4) & (self.z < self.h - 4)
        self.density = self.fraction[self.middle].mean()
        self.density_slope = np.ptp(self.fraction[self.middle])
        self.exponent = self.fit() if self.state == "steady" else np.nan

    def fit(self):
        """n of u = u_0 + A (1 - (1 - z/h)^n), by least squares over a fine grid of n: A and u_0 are linear."""
        z, u = self.z[self.middle] / self.h, self.u[self.middle]

        def residual(n):
            columns = np.stack([np.ones_like(z), 1 - (1 - z) ** n], axis=1)
            solution = np.linalg.lstsq(columns, u, rcond=None)[0]
            return np.sum((columns @ solution - u) ** 2)

        tried = np.arange(1.0, 2.2, 0.005)
        return float(tried[np.argmin([residual(n) for n in tried])])

    @property
    def state(self):
        if self.mean < 0.01:
            return "stopped"
        return "steady" if abs(self.drift) < 0.1 else "accelerates" if self.drift > 0 else "comes to rest"


def measure(runner):
    packing = prepare(runner)
    futures = {angle: begin(runner, packing, angle) for angle in sorted(ANGLES, reverse=True)}
    flows = [Flow(angle, future.result()) for angle, future in sorted(futures.items())]
    lines = ["angle  state          mean u/sqrt(g d)  drift   h/d   solid fraction (spread)  exponent"]
    lines += [f"{f.angle:5} {f.state:14} {f.mean:12.3f} {f.drift:+12.1%} {f.h:6.1f} {f.density:10.3f} "
              f"({f.density_slope:.3f}) {f.exponent:15.2f}" for f in flows]
    lines.append("expected: steady from 20 to 26 degrees, solid fraction 0.59, the same at all depths, exponent 1.5")
    return lines, flows


def draw(axes, flows):
    left, right = axes
    for f in flows:
        if f.state == "steady":
            left.plot(f.u / f.u[f.z < f.h].max(), f.z / f.h, "o", ms=3, label=f"{f.angle} degrees, n = {f.exponent:.2f}")
            right.plot(f.fraction, f.z, label=f"{f.angle} degrees")
    z = np.linspace(0, 1, 50)
    left.plot(1 - (1 - z) ** 1.5, z, "k-", lw=0.8, label="Bagnold, 3/2")
    left.set(xlabel="u / u(h)", ylabel="z / h", title="Incline: velocity", ylim=(0, 1.05))
    right.set(xlabel="solid fraction", ylabel="z / d", title="Incline: solid fraction", xlim=(0, 0.7))
    left.legend()
    right.legend()
