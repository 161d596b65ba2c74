"""Isothermal shock tube, 8 : 1: plateaus of density and speed and the place of the shock at t = 0.2 L / c."""

import numpy as np
from scipy.optimize import brentq

SCENE = "shock_tube.toml"
SIZES = (50, 100, 200)  # particles along its length as far apart as on the right
ERROR = "density of the plateau"
RATIO = 8
GAMMA = 1.001  # the ideal gas nearly keeps its temperature

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "alpha = 1": ("terms.artificial_viscosity=1",),
    "h = 1.2 dx": ("kernel.h_over_dx=1.2",),
    "h = 0.8 dx": ("kernel.h_over_dx=0.8",),
    "delta = 0.1": ("terms.density_diffusion=0.1",),
    "no diffusion": ("terms.density_diffusion=0",),
    "shifting": ("terms.shifting=true",),
    "ida": ("formulation=ida", "terms.density_diffusion="),
    "ideal gas": ("group.gas.eos=ideal_gas", f"group.gas.heat_ratio={GAMMA}", "group.gas.start_pressure=1",
                  "group.gas.sound_speed=", "terms.density_diffusion=", "terms.artificial_viscosity="),
}
WIDEST = 1.2  # h / dx of the formulations above
SMOOTH = 2  # half width of the jump at the start, in distances on the right


def rows(n):
    """Particles across: a period is at least three cells of the kernel's radius and the skin."""
    return int(np.ceil(3 * 1.2 * 3 * WIDEST)) + 1


def settings(n):
    return (f"start.spacing={1 / n}", f"domain.upper=[0.8, {rows(n) / n}]")


def start(n, ratio=RATIO, width=SMOOTH):
    """Of equal masses, so that particles are as far apart behind the contact as before it. The jump is a tanh: nothing
    sharper than the kernel can be followed, and what the kernel makes of a sharp one stays with the matter for good."""
    layers, w = 12, width / n
    x = np.linspace(-0.8, 0.8, 200001)
    # of rho = (ratio + 1) / 2 - (ratio - 1) / 2 tanh(x / w), from the middle; ln cosh without overflow
    far = np.abs(x / w)
    mass = 0.5 * (ratio + 1) * x - 0.5 * (ratio - 1) * w * (far + np.log1p(np.exp(-2 * far)) - np.log(2))
    whole = np.arange(np.ceil(mass[0] * n), np.floor(mass[-1] * n)) + 0.5
    across = np.interp(whole / n, mass, x)
    across = across[(across > -0.5 - layers / n) & (across < 0.5 + layers / n)]
    x = np.column_stack([a.ravel() for a in np.meshgrid(across, (np.arange(rows(n)) + 0.5) / n)])
    rho = 0.5 * (ratio + 1) - 0.5 * (ratio - 1) * np.tanh(x[:, 0] / w)
    return {"x": x, "v": 0, "group": (np.abs(x[:, 0]) > 0.5).astype(int), "rho": rho, "mass": 1 / n**2,
            "u": 1 / (GAMMA - 1)}


def exact(ratio):
    """Densities over that on the right: isothermal rarefaction u = c ln(rho_L / rho), shock u = c (s - 1) / sqrt(s)."""
    middle = brentq(lambda s: np.log(ratio / s) - (s - 1) / np.sqrt(s), 1, ratio)
    return middle, np.log(ratio / middle), np.sqrt(middle)


def measure(run, ratio=RATIO):
    """Plateaus are means between the tail of the rarefaction and the shock, 0.15 of the way off either; the shock
    is where the mean density of columns falls through the middle."""
    last = run.snapshots()[-1]
    middle, speed, shock = exact(ratio)
    x, rho, u = last.position[:, 0], last.density, last.velocity[:, 0]
    mass = last.mass.min()
    dx, width = np.sqrt(mass), last.mass.sum() / (0.5 * (ratio + 1))
    tail, front = (speed - 1) * last.time, shock * last.time
    contact = speed * last.time

    def plateau(a, b):
        inside = (x > a + 0.15 * (b - a)) & (x < b - 0.15 * (b - a))
        density, flow = rho[inside] / middle, u[inside] / speed
        return density.mean() - 1, flow.mean() - 1, density.std(), flow.std()

    left, right = plateau(tail, contact), plateau(contact, front)
    order = np.argsort(x)
    columns = np.array_split(order, round(len(x) * dx / width))
    place, mean = np.array([[x[c].mean(), rho[c].mean()] for c in columns]).T
    above = np.nonzero((mean > 0.5 * (middle + 1)) & (place > contact))[0]
    k = above[-1]
    found = np.interp(-0.5 * (middle + 1), -mean[k:k + 2], place[k:k + 2])
    series = run.series()
    return {"density of the plateau": max(abs(left[0]), abs(right[0])), "left": left[0], "right": right[0],
            "speed, left": left[1], "speed, right": right[1], "noise of rho": max(left[2], right[2]),
            "noise of u": max(left[3], right[3]), "shock ahead / dx": (found - front) / dx,
            "momentum": series["momentum_px"][-1] / (last.time * (ratio - 1) * width) - 1}
