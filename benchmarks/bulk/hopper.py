"""Silo with a round hole, flat-bottomed, of triangles: rate of discharge against the hole's width (Beverloo et al. 1961)."""

import numpy as np

from rings import widened, write_rings
from runs import Series, exponent, snapshots

DIAMETER, GRAVITY = 2e-3, 9.81  # mean of the grains [m]
HOLES = (6, 7.5, 9, 10.5, 12)  # [diameters]
RADIUS, HEIGHT = 30, 120  # of the silo [mm]
OPENS, STEADY = 0.3, 0.15  # [s]: from OPENS + STEADY on the rate is measured
EMPTY = 1.4  # k: a ring of k d / 2 along the edge of the hole is empty


def settings(work, hole):
    half = widened(hole * DIAMETER * 1e3 / 2)
    silo, plug = work / f"silo_{hole}.obj", work / f"plug_{hole}.obj"
    write_rings(silo, [(RADIUS, HEIGHT), (RADIUS, 0), (half, 0)])
    write_rings(plug, [(1.2 * half, 0), (0, 0)])
    return [f"mesh.silo.file={silo}", f"mesh.plug.file={plug}"]


class Discharge:
    def __init__(self, folder, hole):
        self.hole = hole * DIAMETER
        series = Series(folder / "series.csv")
        steady = series["t"] > OPENS + STEADY
        self.time, self.out = series["t"][steady], series["budget_mass_out"][steady]
        (self.rate, _), cov = np.polyfit(self.time, self.out, 1, cov=True)
        self.error = np.sqrt(cov[0, 0])
        full = [s for s in snapshots(folder) if s.time < OPENS][-1]
        inside = (full.position[:, 2] > 2 * DIAMETER) & (full.position[:, 2] < 10 * DIAMETER)
        self.bulk = 2500 * full.volume[inside].sum() / (np.pi * (RADIUS * 1e-3) ** 2 * 8 * DIAMETER)


def measure(runner):
    futures = [(h, runner.start(f"hopper_{h}", "hopper.toml", *settings(runner.work, h))) for h in reversed(HOLES)]
    runs = sorted((Discharge(f.result(), h) for h, f in futures), key=lambda r: r.hole)
    width = np.array([r.hole - EMPTY * DIAMETER for r in runs])
    rate = np.array([r.rate for r in runs])
    bulk = np.mean([r.bulk for r in runs])
    power, _ = exponent(width, rate)
    constants = rate / (bulk * np.sqrt(GRAVITY) * width**2.5)
    lines = ["hole [d]  rate [g/s]  C of rate = C rho sqrt(g) (D - 1.4 d)^(5/2)"]
    lines += [f"{r.hole / DIAMETER:8.1f} {1e3 * r.rate:8.2f} +- {1e3 * r.error:.2f} {c:8.3f}" for r, c in zip(runs, constants)]
    lines.append(f"with a ring of 1.4 d exponent {power:.3f} (2.5, within 5 %), C = {constants.mean():.3f} (0.58, within 10 %), rho = {bulk:.0f} kg/m3")
    # The ring is not known beforehand: rate^(2/5) is a straight line over the width of the hole, which says it and C.
    holes = np.array([r.hole for r in runs])
    slope, start = np.polyfit(holes, rate**0.4, 1)
    ring, constant = -start / slope, slope**2.5 / (bulk * np.sqrt(GRAVITY))
    off = np.abs((slope * holes + start) ** 2.5 / rate - 1).max()
    lines.append(f"rate = C rho sqrt(g) (D - k d)^(5/2) with k = {ring / DIAMETER:.2f} (1 to 2), C = {constant:.3f}: within {100 * off:.1f} %")
    return lines, (runs, width, rate, bulk)


def draw(axes, result):
    runs, width, rate, bulk = result
    left, right = axes
    for r in runs:
        left.plot(r.time, 1e3 * r.out, label=f"D = {r.hole / DIAMETER:g} d")
    left.set(xlabel="time (s)", ylabel="out (g)", title="Silo: what has left it")
    left.legend()
    right.loglog(1e3 * width, 1e3 * rate, "o")
    x = np.linspace(width.min(), width.max(), 20)
    right.loglog(1e3 * x, 1e3 * 0.58 * bulk * np.sqrt(GRAVITY) * x**2.5, "k-", lw=0.8, label="Beverloo, C = 0.58")
    right.set(xlabel="D - 1.4 d (mm)", ylabel="rate (g/s)", title="Rate of discharge")
    right.legend()
