"""Rayleigh wave: speed of a standing surface wave on an elastic plate two wave lengths thick, and its damping.

Exact: the symmetric mode of Rayleigh and Lamb for a plate with both faces free, -b < y < b, in plane strain,
  (k^2 + q^2)^2 tanh q b = 4 k^2 p q tanh p b,  p^2 = k^2 - (w / c_p)^2,  q^2 = k^2 - (w / c_s)^2,
which for kb -> infinity is Rayleigh's wave: 0.9243 c_s here, 0.9194 c_s then (Poisson's ratio 1/4).
What kernel sums make of it: inside, c_s falls by (w h / c_s)^2 / 4, as sound does, 0.53 % at 40 particles a wave and h = dx.
At a face the sums see a strain m(d) < 1 times the true one, d the depth: 0.78, 0.994 in the rows at dx/2 and 3 dx/2. There
is no traction there, so the stress is E' m e_xx and the skin too soft: with Rayleigh's quotient
  dc / c = -0.239 k L,  L = sum of (1 - m^2) dx = 0.39 dx at h = dx, 0.53 dx at 1.2 dx, 0.92 dx at 2 dx,
1.5 % at 40 and of first order; the eigenmode of the plate's lattice sums is 5.85, 2.17, 0.87 % slow at 20, 40, 80.
"""

import numpy as np
from scipy.optimize import brentq, curve_fit

SCENE = "rayleigh_wave.toml"
SIZES = (20, 40, 80)  # particles a wave length
ERROR = "speed"
K, HALF = 2 * np.pi, 1.0
SHEAR, PRESSURE = np.sqrt(6e6 / 1000), np.sqrt((1e7 + 4 / 3 * 6e6) / 1000)  # speeds of waves

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "h = 1.2 dx": ("kernel.h_over_dx=1.2",),
    "h = 2 dx": ("kernel.h_over_dx=2",),
    "half the step": ("time.cfl=0.4",),
    "total": ("group.plate.lagrangian=total",),
}


def decays(c):
    return K * np.sqrt(1 - (c / PRESSURE)**2), K * np.sqrt(1 - (c / SHEAR)**2)


def lamb(c):
    p, q = decays(c)
    return (K**2 + q**2)**2 * np.tanh(q * HALF) - 4 * K**2 * p * q * np.tanh(p * HALF)


SPEED = brentq(lamb, 0.5 * SHEAR, 0.999 * SHEAR)


def settings(n):
    return (f"start.spacing={1 / n}",)


def mode(x):
    p, q = decays(SPEED)
    share = 2 * np.sinh(p * HALF) / ((q**2 + K**2) * np.sinh(q * HALF))
    along = K * (np.cosh(p * x[:, 1]) - p * q * share * np.cosh(q * x[:, 1]))
    up = p * (np.sinh(p * x[:, 1]) - K**2 * share * np.sinh(q * x[:, 1]))
    v = np.column_stack((-along * np.sin(K * x[:, 0]), up * np.cos(K * x[:, 0])))
    return v / np.abs(v).max()


def start(n):
    """Free of stress, with the largest velocities of the standing wave."""
    centres = (np.arange(2 * n) + 0.5) / n
    x = np.column_stack([a.ravel() for a in np.meshgrid(centres, centres - HALF, indexing="ij")])
    return {"x": x, "v": 1e-5 * SHEAR * mode(x), "rho": np.full(len(x), 1000.0)}


def swing(t, size, decay, omega, phase):
    return size * np.exp(-decay * t) * np.cos(omega * t + phase)


def measure(run):
    """Of the velocities' share in the mode, over three periods."""
    snapshots = run.snapshots()
    shape = mode(snapshots[0].position)
    t = np.array([s.time for s in snapshots]) * SPEED
    share = np.array([np.sum(s.velocity * shape) for s in snapshots])
    share /= share[0]
    fit, _ = curve_fit(swing, t, share, (1, 0, K, 0))
    return {"speed": abs(fit[2] / K - 1), "speed / exact": fit[2] / K, "exact / c_s": SPEED / SHEAR,
            "damping a period": 1 - np.exp(-fit[1]), "rms from the fit": np.std(share - swing(t, *fit))}
