"""Sod's shock tube: plateaus of density, pressure and speed, the place of the shock, and the energy at t = 0.2."""

import numpy as np
from scipy.optimize import brentq

SCENE = "sod.toml"
SIZES = (50, 100, 200)  # particles along its length as far apart as on the right
ERROR = "worst plateau"
GAMMA = 1.4
LEFT, RIGHT = (1.0, 1.0), (0.125, 0.1)  # density, pressure

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "no conduction": ("terms.artificial_conduction=0",),
    "conduction 1": ("terms.artificial_conduction=1",),
    "alpha = 2": ("terms.artificial_viscosity=2",),
    "beta = 0": ("terms.quadratic_viscosity=0",),
    "h = 0.8 dx": ("kernel.h_over_dx=0.8",),
    "h = 1.2 dx": ("kernel.h_over_dx=1.2",),
    "cfl = 0.4": ("time.cfl=0.4",),
}
WIDEST = 1.2  # h / dx of the formulations above
SMOOTH = 1  # half width of the jump at the start, in distances on the right


def rows(n):
    """Particles across: a period is at least three cells of the kernel's radius and the skin."""
    return int(np.ceil(3 * 1.2 * 3 * WIDEST)) + 1


def settings(n):
    return (f"start.spacing={1 / n}", f"domain.upper=[0.8, {rows(n) / n}]")


def across(n, low, high, width):
    """Places of particles of equal mass, 1 / n apart where the density is `low`, in a tanh from `high` to it."""
    w, ratio = width / n, high / low
    x = np.linspace(-0.8, 0.8, 200001)
    far = np.abs(x / w)  # of ln cosh without overflow
    mass = 0.5 * (ratio + 1) * x - 0.5 * (ratio - 1) * w * (far + np.log1p(np.exp(-2 * far)) - np.log(2))
    whole = np.arange(np.ceil(mass[0] * n), np.floor(mass[-1] * n)) + 0.5
    return np.interp(whole / n, mass, x)


def start(n, width=SMOOTH):
    """Of equal masses, so that no spacing grows beyond that on the right; density and pressure in the same tanh. Of equal
    spacing the gas in the fan would thin out to 2.3 spacings along the tube, too few for the kernel: plateaus 15 to 40 % off."""
    layers = 12
    x = across(n, RIGHT[0], LEFT[0], width)
    x = x[(x > -0.5 - layers / n) & (x < 0.5 + layers / n)]
    x = np.column_stack([a.ravel() for a in np.meshgrid(x, (np.arange(rows(n)) + 0.5) / n)])
    rho, p = (0.5 * (a + b) - 0.5 * (a - b) * np.tanh(x[:, 0] * n / width) for a, b in zip(LEFT, RIGHT))
    return {"x": x, "v": 0, "group": (np.abs(x[:, 0]) > 0.5).astype(int), "rho": rho, "mass": RIGHT[0] / n**2,
            "u": p / ((GAMMA - 1) * rho)}


def exact():
    """Pressure, speed, both densities between the waves and speeds of tail, contact and shock (Toro 2009, 4.2)."""
    (rho_l, p_l), (rho_r, p_r), g = LEFT, RIGHT, GAMMA
    c_l, c_r = np.sqrt(g * p_l / rho_l), np.sqrt(g * p_r / rho_r)

    def fan(p):
        return 2 * c_l / (g - 1) * ((p / p_l)**((g - 1) / (2 * g)) - 1)

    def jump(p):
        return (p - p_r) * np.sqrt(2 / rho_r / ((g + 1) * p + (g - 1) * p_r))

    p = brentq(lambda p: fan(p) + jump(p), p_r, p_l, xtol=1e-14)
    u, left = jump(p), rho_l * (p / p_l)**(1 / g)
    right = rho_r * (p / p_r + (g - 1) / (g + 1)) / ((g - 1) / (g + 1) * p / p_r + 1)
    tail = u - c_l * (p / p_l)**((g - 1) / (2 * g))
    return p, u, left, right, tail, u, c_r * np.sqrt((g + 1) / (2 * g) * p / p_r + (g - 1) / (2 * g))


def measure(run):
    """Plateaus are means between tail and contact and between contact and shock, 0.15 of the way off either; the shock
    is where the mean density of columns falls through the middle. Energy over that at the start."""
    last = run.snapshots()[-1]
    p, u, left, right, *speeds = exact()
    tail, contact, front = (s * last.time for s in speeds)
    x = last.position[:, 0]
    dx = np.sqrt(last.mass.min() / RIGHT[0])
    width = last.mass.sum() / (0.5 * (LEFT[0] + RIGHT[0]))

    def plateau(a, b, density):
        inside = (x > a + 0.15 * (b - a)) & (x < b - 0.15 * (b - a))
        values = (last.density[inside] / density, last.pressure[inside] / p, last.velocity[inside, 0] / u)
        return [v.mean() - 1 for v in values], max(v.std() for v in values)

    (rho_l, p_l, u_l), noise_l = plateau(tail, contact, left)
    (rho_r, p_r, u_r), noise_r = plateau(contact, front, right)
    columns = np.array_split(np.argsort(x), round(len(x) * last.mass.min() / RIGHT[0] / dx / width))
    place, mean = np.array([[x[c].mean(), last.density[c].mean()] for c in columns]).T
    above = np.nonzero((mean > 0.5 * (right + RIGHT[0])) & (place > contact))[0]
    k = above[-1]
    found = np.interp(-0.5 * (right + RIGHT[0]), -mean[k:k + 2], place[k:k + 2])
    series = run.series()
    energy = series["energy_kinetic"] + series["energy_internal"]
    blip = np.max(np.abs(last.pressure[np.abs(x - contact) < 0.05] / p - 1))
    return {"worst plateau": max(abs(v) for v in (rho_l, p_l, u_l, rho_r, p_r, u_r)), "rho*L": rho_l, "rho*R": rho_r,
            "p*, left": p_l, "p*, right": p_r, "u*, left": u_l, "u*, right": u_r, "noise": max(noise_l, noise_r),
            "p at the contact": blip, "shock ahead / dx": (found - front) / dx,
            "energy": energy[-1] / energy[0] - 1}
