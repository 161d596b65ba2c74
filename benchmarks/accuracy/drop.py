"""A drop of R = rho = sigma = 1 in a fluid like it, at rest or drawn out to r = 1 + eps cos 2 phi: starts, shapes, and the
linear theory of its oscillation with the viscosity of both fluids."""

import numpy as np
from scipy.special import ive, kve

SIDE, VISCOSITY, MODE = 8, 0.002, 2  # box, Oh


def stream(x, eps):
    """Velocity of the stream function eps x y g(r), g = 1 to r = 1.2 and 0 from 3.6: a strain of the drop, without
    divergence."""
    first, last = 1.2, 3.6
    r = np.hypot(*x.T)
    s = np.pi * np.clip((r - first) / (last - first), 0, 1)
    g, slope = 0.5 * (1 + np.cos(s)), -0.5 * np.pi / (last - first) * np.sin(s) / np.maximum(r, first)
    square = x**2
    return eps * x * np.column_stack([g + slope * square[:, 1], -(g + slope * square[:, 0])])


def start(n, eps):
    """A jittered lattice, n spacings a radius, cut by a circle and carried along by the strain."""
    centres = (np.arange(SIDE * n) + 0.5) / n - SIDE / 2
    x = np.column_stack([a.ravel() for a in np.meshgrid(centres, centres)])
    x += np.random.default_rng(1).uniform(-0.05, 0.05, x.shape) / n
    inside = np.hypot(*x.T) < 1
    steps = 20
    for _ in range(steps if eps else 0):
        x += stream(x + stream(x, eps) / (2 * steps), eps) / steps
    return {"x": x, "v": np.zeros_like(x), "group": inside}


def elongation(position, volume):
    """eps of r = 1 + eps cos 2 phi, which is the integral of x^2 - y^2 over pi."""
    total = volume.sum()
    x, y = (position - volume @ position / total).T
    return np.pi * (volume @ (x**2 - y**2)) / total**2


def answer(s, viscosity):
    """Laplace transform of the interface's speed under a unit of pressure cos 2 phi inside it: stream functions r^n and
    I_n(k r) inside, r^-n and K_n(k r) outside, k^2 = s / nu; both velocities and the shear stress are continuous."""
    n, k = MODE, np.sqrt(s / viscosity)
    i1, k1 = k * ive(n - 1, k) / ive(n, k) - n, -k * kve(n - 1, k) / kve(n, k) - n
    i2, k2 = k * k + n * n - i1, k * k + n * n - k1
    rows = [[1, 1, -1, -1], [n, i1, n, -k1], [n * (n - 1), i2, -n * (n + 1), -k2], [-s, 0, -s, 0]]
    a, b, _, _ = np.linalg.solve(np.array(rows, dtype=complex), np.array([0, 0, 0, 1], dtype=complex))
    return n * (a + b)


def exact(times, viscosity=VISCOSITY):
    """Elongation over that at the start, where the drop is let go at rest; the inviscid part, cos sqrt(3) t, apart."""
    tension, square, shift, width = MODE**2 - 1, MODE * (MODE**2 - 1) / 2, 0.3, 0.01
    frequency = (np.arange(20000) + 0.5) * width
    s = shift + 1j * frequency
    transform = np.array([1 / (z - tension * answer(z, viscosity)) - z / (z * z + square) for z in s])
    waves = (np.exp(1j * np.outer(times, frequency)) @ transform).real
    return np.cos(np.sqrt(square) * times) + np.exp(shift * times) / np.pi * width * waves
