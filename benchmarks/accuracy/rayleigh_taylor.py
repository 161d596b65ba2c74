"""Rayleigh-Taylor, densities 1.8:1, Re = 420: growth rate of a small wave against the exact dispersion relation."""

import numpy as np
from scipy.optimize import brentq

SCENE = "rayleigh_taylor.toml"
SIZES = (25, 50, 100)  # particles a wavelength
ERROR = "growth rate"
K, NU, HEAVY, LIGHT, AMPLITUDE = 2 * np.pi, 2 / 420, 1.8, 1.0, 0.002


def dispersion(n):
    """Chandrasekhar (1961), section 94, eq. (113), without tension and g = 1: zero at the rate n. The often used
    sqrt(At g k + nu^2 k^4) - nu k^2 is 11 % too fast here."""
    q = np.sqrt(K**2 + n / NU)
    light, heavy = LIGHT / (LIGHT + HEAVY), HEAVY / (LIGHT + HEAVY)
    jump = (light - heavy) * NU
    return (-(K / n**2 * (light - heavy) + 1) * (q - K) - 4 * K * light * heavy +
            4 * K**2 / n * jump * ((heavy - light) * q + K * (light - heavy)) +
            4 * K**3 / n**2 * jump**2 * (q - K)**2)


RATE = brentq(dispersion, 0.3, 1.34)

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "laplacian viscosity": ("terms.viscosity=laplacian",),
    "pressures by volume": ("terms.pressure_weights=volume",),
    "no shifting": ("terms.shifting=false",),
}


def settings(n):
    return (f"start.spacing={1 / n}",)


def start(n):
    """A lattice drawn out along y so that a row follows the interface, moving as the wave that grows."""
    layers = 4
    x, y = (a.ravel() for a in np.meshgrid((np.arange(n) + 0.5) / n, (np.arange(-layers, 2 * n + layers) + 0.5) / n))
    wall = (y < 0) | (y > 2)
    heavy = y > 1
    near = np.where(wall, 0, np.exp(-K * np.abs(y - 1)))
    wave = AMPLITUDE * near * np.cos(K * x)
    v = RATE * AMPLITUDE * near[:, None] * np.column_stack([np.sign(y - 1) * np.sin(K * x), np.cos(K * x)])
    y = y + wave
    pressure = np.where(heavy, HEAVY * (2 - y), HEAVY + LIGHT * (1 - y))
    rho0 = np.where(heavy, HEAVY, LIGHT)
    rho = np.where(wall, HEAVY, rho0 + pressure / 14**2)
    return {"x": np.column_stack([x, y]), "v": v, "rho": rho, "group": np.where(wall, 2, np.where(heavy, 0, 1))}


def measure(run):
    """Momentum of the wave, which grows with it; the straight part of its logarithm."""
    snapshots = run.snapshots()
    time = np.array([s.time for s in snapshots])
    wave = np.array([s.mass @ (s.velocity[:, 1] * np.cos(K * s.position[:, 0])) for s in snapshots])
    straight = (time > 1.45) & (time < 3.05)  # of the fastest mode alone, and up to k a = 0.25 still straight
    rate = np.polyfit(time[straight], np.log(np.abs(wave[straight])), 1)[0]
    return {"growth rate": abs(rate / RATE - 1), "rate": rate, "exact": RATE}
