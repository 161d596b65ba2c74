"""Viscous standing wave, Re 500: decay of the amplitude against the exact linear theory, 2 nu k^2 to first order."""

import numpy as np
from scipy.optimize import curve_fit, root

import sloshing

SCENE = "standing_wave.toml"
SIZES = (25, 50, 100)  # particles from floor to surface
ERROR = "decay rate"
REYNOLDS, GRAVITY, AMPLITUDE = 500, 9.81, 0.03
K = np.pi
OMEGA = np.sqrt(GRAVITY * K * np.tanh(K))

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "laplacian viscosity": ("terms.viscosity=laplacian",),
    "no-slip floor": ("group.floor.slip=",),
    "no diffusion": ("terms.density_diffusion=0",),
    "ida": ("formulation=ida", "terms.viscosity=", "terms.density_diffusion=", "group.floor.slip="),
}


def settings(n):
    return (f"start.spacing={1 / n}",)


def start(n):
    centres, layers = (np.arange(2 * n) + 0.5) / n, 4
    up = (np.arange(-layers, n) + 0.5) / n
    x = np.column_stack([a.ravel() for a in np.meshgrid(centres, up)])
    water = x[:, 1] > 0
    v = np.where(water[:, None], sloshing.mode(x, K, 1, AMPLITUDE * OMEGA), 0)
    return {"x": x, "v": v, "group": 1 - water.astype(int)}


def theory(reynolds):
    """Rate of the amplitude and angular frequency, from (s + 2 nu k^2)^2 + omega^2 = 4 nu^2 k^4 sqrt(1 + s / nu k^2)
    (Lamb, Hydrodynamics, article 349; the floor, where tanh k H = 0.996, enters omega alone)."""
    rate = np.sqrt(GRAVITY) / reynolds * K**2

    def residual(z):
        s = complex(*z)
        out = (s + 2 * rate)**2 + OMEGA**2 - 4 * rate**2 * np.sqrt(1 + s / rate)
        return out.real, out.imag

    real, imaginary = root(residual, (-2 * rate, OMEGA), tol=1e-12).x
    return -real, imaginary


def energy(t, first, decay, omega, phase, rest):
    return first * np.exp(-2 * decay * t) * np.cos(omega * t + phase)**2 + rest


def measure(run, reynolds=REYNOLDS):
    series = run.series()
    decay, omega = theory(reynolds)
    t, kinetic = series["t"], series["energy_kinetic"]
    try:
        fit, _ = curve_fit(energy, t, kinetic, (kinetic[0], decay, omega, 0, 0))
    except RuntimeError:  # no wave is left
        return {"decay rate": np.nan}
    first_order = 2 * np.sqrt(GRAVITY) / reynolds * K**2
    return {"decay rate": abs(fit[1] / decay - 1), "decay / 2 nu k^2": fit[1] / first_order,
            "theory / 2 nu k^2": decay / first_order, "period": omega / fit[2] - 1,
            "rms from the fit / first": np.std(kinetic - energy(t, *fit)) / kinetic[0]}
