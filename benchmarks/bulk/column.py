"""Column collapse: run-out and final height against the aspect ratio a = H/L0 (Lajeunesse et al. 2005)."""

import numpy as np

from runs import exponent, snapshots

WIDTH, DIAMETER, DEPTH = 0.0506, 2e-3, 0.011
RELEASE = 0.6  # [s]
RATIOS = (0.4, 0.7, 1.1, 1.6, 2.3, 3.5, 5, 7.5)
FILLED = 1.45  # height of the lattice that settles to 1


class Collapse:
    def __init__(self, folder):
        all_of_it = snapshots(folder)
        before = [s for s in all_of_it if s.time <= RELEASE * (1 + 1e-9)][-1]
        self.last = all_of_it[-1]
        self.height = self.top(before)
        self.ratio = self.height / WIDTH
        self.fraction = before.volume.sum() / (WIDTH * DEPTH * self.height)
        self.final_height = self.profile(self.last)[1][:3].max()
        self.front = self.front_of(self.last)
        self.crept = abs(self.front - self.front_of(all_of_it[-2]))

    @staticmethod
    def profile(snapshot):
        """Height in bins of two diameters: the upper edge of the upper grains, lone ones left out."""
        edges = np.arange(0, snapshot.position[:, 0].max() + 4 * DIAMETER, 2 * DIAMETER)
        top = snapshot.position[:, 2] + snapshot.radius
        inside = np.digitize(snapshot.position[:, 0], edges) - 1
        height = [np.sort(top[inside == k])[-4:].mean() if np.sum(inside == k) >= 4 else 0.0
                  for k in range(len(edges) - 1)]
        return 0.5 * (edges[:-1] + edges[1:]), np.array(height)

    def top(self, snapshot):
        x, height = self.profile(snapshot)
        return float(np.median(height[x < WIDTH - 2 * DIAMETER]))

    def front_of(self, snapshot):
        """Where the connected heap becomes thinner than a diameter."""
        x, height = self.profile(snapshot)
        thin = np.flatnonzero(height < DIAMETER)
        return float(x[thin[0]]) if len(thin) else float(x[-1])


def settings(ratio):
    high = FILLED * ratio * WIDTH
    fall = np.sqrt(ratio * WIDTH / 9.81)
    until = RELEASE + max(0.6, 5.5 * fall)
    return [f"start.upper=[{WIDTH}, {DEPTH}, {high:.6g}]",
            f"domain.upper=[{WIDTH * (5 + 6 * ratio):.6g}, {DEPTH}, {1.2 * high + 0.03:.6g}]",
            f"time.until={until:.6g}"]


def measure(runner):
    # The largest first: they take longest.
    futures = [runner.start(f"column_{a}", "column.toml", *settings(a)) for a in sorted(RATIOS, reverse=True)]
    cases = sorted((Collapse(f.result()) for f in futures), key=lambda c: c.ratio)
    a = np.array([c.ratio for c in cases])
    runout = np.array([(c.front - WIDTH) / WIDTH for c in cases])
    height = np.array([c.final_height / WIDTH for c in cases])
    low, high = a < 2.3, a > 2.3
    lines = ["    a   run-out/L0  H_f/L0  solid fraction  creep of the front [d]"]
    lines += [f"{c.ratio:6.2f} {r:10.3f} {h:8.3f} {c.fraction:12.3f} {c.crept / DIAMETER:14.2f}"
              for c, r, h in zip(cases, runout, height)]
    fits = {}
    for name, x, y, expected in (("run-out, a < 2.3", a[low], runout[low], "1, prefactor 1.2 (experiments) to 2.5"),
                                 ("run-out, a > 2.3", a[high], runout[high], "2/3, prefactor 1.9 to 3.25"),
                                 ("height, a > 0.7", a[a > 0.7], height[a > 0.7], "1/3")):
        if len(x) < 3:
            continue
        fits[name] = exponent(x, y)
        lines.append(f"{name}: exponent {fits[name][0]:.3f}, prefactor {fits[name][1]:.2f} (expected {expected})")
    return lines, (cases, a, runout, height, fits)


def draw(axes, result):
    cases, a, runout, height, fits = result
    left, right = axes
    for c in cases[::2]:
        x, h = Collapse.profile(c.last)
        left.plot(x / WIDTH, h / WIDTH, label=f"a = {c.ratio:.1f}")
    left.set(xlabel="x / L0", ylabel="height / L0", title="Column collapse: deposits")
    left.legend()
    right.loglog(a, runout, "o", label="run-out / L0")
    right.loglog(a, height, "s", label="final height / L0")
    for name, (n, c) in fits.items():
        x = a[a < 2.3] if "<" in name else a[a > (2.3 if "run" in name else 0.7)]
        right.loglog(x, c * x**n, "k-", lw=0.8)
        right.annotate(f"{n:.2f}", (x[len(x) // 2], 1.25 * c * x[len(x) // 2] ** n))
    right.set(xlabel="a = H / L0", title="Exponents: 1 and 2/3; 1/3 expected")
    right.legend()
