"""Rayleigh-Taylor of a layer of grains over clear fluid: growth rate against that of two viscous fluids.

Grains that sink slowly, v_s k << n, move with the fluid, and the layer is a fluid of density rho_2 = (1 - c) rho + c rho_s; its
viscosity is that of the fluid, as the model has no 1 + 2.5 c (here 3.5 %). A wave w(z) e^(nt) cos kx of both (Chandrasekhar
1961, sections 92-94) solves (D^2 - k^2)(D^2 - q^2) w = 0, q^2 = k^2 + n rho / eta, in each, w = Dw = 0 on floor and lid, and where
they meet w, Dw, eta (D^2 + k^2) w have no jump, and the normal stress none but the weight of the wave:
  [rho n Dw - eta D^3 w + 3 eta k^2 Dw] + g k^2 (rho_2 - rho) w / n = 0.
Two solutions of each that vanish at its wall make a determinant of four, whose root is n. Grains push and see the fluid through
the kernel, whose variance is 0.67 dx^2 (quintic 0.467 h^2, Wendland C2 0.267 h^2): it makes w (1 - 0.67 k^2 dx^2) of w to first
order, twice, as if g were as much less.
"""

import numpy as np
from scipy.optimize import brentq

SCENE = "sinking_layer.toml"
SIZES = (20, 40)  # particles a wave
ERROR = "growth rate"
K, DEPTH, VISCOSITY, DENSITY, DIAMETER, SPACING = 2 * np.pi, 0.5, 0.012, 36, 0.0075, 0.025
SOLID = np.pi / 6 * (DIAMETER / SPACING)**3
LAYERS = (1, 1 + SOLID * (DENSITY - 1))
FIRST, LAST = 0.02, 0.08  # of a wave length: the amplitudes between which it is fitted

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "wendland c2": ("kernel.shape=wendland_c2", "kernel.h_over_dx=1.6"),
}


def from_wall(q):
    """w, Dw, D^2 w, D^3 w of the two solutions at the interface, away from the wall."""
    k, (a, b), (c, d) = K, np.cosh((K * DEPTH, q * DEPTH)), np.sinh((K * DEPTH, q * DEPTH))
    return np.array([(a - b, k * c - q * d, k**2 * a - q**2 * b, k**3 * c - q**3 * d),
                     (c / k - d / q, a - b, k * c - q * d, k**2 * a - q**2 * b)]) / b


def dispersion(n, gravity=1):
    columns = []
    for side, rho in zip((-1, 1), LAYERS):
        for w, dw, ddw, dddw in from_wall(np.sqrt(K**2 + n * rho / VISCOSITY)) * (1, -side, 1, -side):
            stress = rho * n * dw + VISCOSITY * (3 * K**2 * dw - dddw)
            weight = 0 if side < 0 else gravity * K**2 * (LAYERS[1] - LAYERS[0]) * w / n
            columns.append((side * w, side * dw, side * (ddw + K**2 * w), side * stress + weight))
    return np.linalg.det(columns)


RATE = brentq(dispersion, 0.1, 1.1)


def settings(n):
    across = 12 / n
    return (f"start.spacing={1 / n}", f"domain.upper=[1, {across}, {DEPTH + 10 / n}]",
            f"domain.lower=[0, 0, {-DEPTH - 10 / n}]", f"start.grains.0.upper=[0.25, {across}, 0.505]",
            f"start.grains.1.upper=[0.75, {across}, 0.495]", f"start.grains.2.upper=[1, {across}, 0.505]")


def rate_of(time, wave):
    """Of a wave that grows, from its logarithm."""
    return np.polyfit(time, np.log(wave), 1)[0]


def measure(run):
    """The amplitude is that of the grains that were the lowest; beside it the momentum of the wave."""
    snapshots = run.snapshots()
    time = np.array([s.time for s in snapshots])
    places = np.array([s.position[s.group == 2] for s in snapshots])
    lowest = places[0, :, 2] < 0.02
    amplitude, momentum = [], []
    for s, x in zip(snapshots, places[:, lowest]):
        wave = np.column_stack([np.ones(len(x)), np.cos(K * x[:, 0])])
        amplitude.append(np.linalg.lstsq(wave, x[:, 2], rcond=None)[0][1])
        momentum.append(s.mass @ (s.velocity[:, 2] * np.cos(K * s.position[:, 0])))
    amplitude, momentum = np.array(amplitude), np.array(momentum)
    chosen = (amplitude > FIRST) & (amplitude < LAST)
    rate = rate_of(time[chosen], amplitude[chosen])
    square = 12 / np.sum(snapshots[0].group == 0)  # of the spacing
    seen = (1 - 0.67 * K**2 * square)**2
    return {"growth rate": abs(rate / RATE - 1), "rate": rate, "of the momentum": rate_of(time[chosen], momentum[chosen]),
            "exact": RATE, "through the kernel": brentq(dispersion, 0.1, 1.1, seen)}
