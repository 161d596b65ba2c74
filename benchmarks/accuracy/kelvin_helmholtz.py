"""Kelvin-Helmholtz, one density: growth rate of a wave in a shear layer against the compressible linear theory.

Waves exp(i k (x - c t)) in a parallel flow U(y) without viscosity, p their pressure and eta the height by which they lift
the fluid, obey rho D^2 eta / Dt^2 = -p' and mass conservation:
  p' = rho (U - c)^2 q,  q' = p (1 / (U - c)^2 - 1 / a^2) / rho,  q = eta, lengths in 1/k,
a the speed of sound, p and q continuous also where rho jumps. The box repeats itself: layers at y = 0 and 1/2 lift alike, so
p = 0 half-way between them, which gives c. The layer U tanh(sin(k y) / k d) grows at 0.416 k U for d = 0.08 (a vortex sheet,
d = 0, at k U), 0.66 % of which M = 0.1 takes away. Projection by kernel sums, div S (1/rho) S grad p = div S v, has the
kernel S in both operators, so that S drops out: no dispersion as that of sound; without shifting 0.5 % is lost from an exact
lattice, 6 % from a jittered one whose sheared rows clash. The rest is shifting: across the layer its velocity -2 h U S opposes that
of the wave (by 5 % at 100, 4 to 15 % at 50) and takes the momentum of the shear along.
"""

import tomllib

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import root

SCENE = "kelvin_helmholtz.toml"
SIZES = (32, 50, 64, 100)  # particles a wave length
ERROR = "growth rate"
K, THICKNESS, SOUND, AMPLITUDE = 2 * np.pi, 0.08, 10, 0.003

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "no shifting": ("terms.shifting=false",),
    "no diffusion": ("terms.density_diffusion=0",),
    "h = dx": ("kernel.h_over_dx=1",),
    "h = 2 dx": ("kernel.h_over_dx=2",),
    "c = 20 U": ("group.fast.sound_speed=20", "group.slow.sound_speed=20"),
    "half the step": ("time.cfl=0.4",),
    "artificial viscosity": ("terms.artificial_viscosity=0.02",),
}


def settings(n):
    return (f"start.spacing={1 / n}",)


def flow(y):
    return np.tanh(np.sin(K * y) / (K * THICKNESS))


def across(c, ratio, sound, heights=()):
    """(p, q) at the heights, and p at y = 1/4, from p = 0, q = 1 at -1/4; lengths in 1/k."""
    values, state = [], np.array([0, 1], complex)
    for low, high, rho in ((-0.25, 0, ratio), (0, 0.25, 1)):
        def slope(y, z, rho=rho):
            square = (flow(y) - c)**2
            return K * np.array([rho * square * z[1], z[0] * (1 / square - 1 / sound**2) / rho])

        at = [y for y in heights if low <= y < high or y == high == 0.25]
        solution = solve_ivp(slope, (low, high), state, rtol=1e-9, atol=1e-12, dense_output=True)
        values.append(solution.sol(at) if at else np.empty((2, 0)))
        state = solution.y[:, -1]
    return np.hstack(values), state[0]


def wave_speed(ratio, sound):
    """c; the rate is k Im c."""
    def residual(z):
        p = across(complex(*z), ratio, sound)[1]
        return p.real, p.imag

    found = root(residual, ((1 - ratio) / (1 + ratio), 0.4), tol=1e-10)
    assert found.success
    return complex(*found.x)


def start(n, ratio=1):
    """Particles at rest in the mean flow, displaced by the wave: with xi = i p / (rho (U - c)^2), eta = q their
    velocities are the mean flow's and i k (U - c) (xi, eta). From an exact lattice: what a jitter stirs is as large as the
    wave; differences of two runs with the wave and its negative from the same jittered lattice grow at the same rate."""
    c = wave_speed(ratio, SOUND)
    centres = (np.arange(n) + 0.5) / n
    rows = np.where(centres > 0.75, centres - 1, centres)
    fold, odd = np.where(rows > 0.25, 0.5 - rows, rows), np.where(rows > 0.25, -1, 1)
    order = np.argsort(fold)
    p, q = np.empty((2, n), complex)
    p[order], q[order] = across(c, ratio, SOUND, fold[order])[0]
    p *= odd
    fast = fold > 0
    u, rho = flow(fold), np.where(fast, 1, ratio)
    size = AMPLITUDE / (K * np.max(np.abs(q * (u - c))))
    shape = size * np.column_stack((1j * p / (rho * (u - c)**2), q))
    wave = np.exp(1j * K * centres)[:, None, None]
    displacement = (wave * shape).real
    velocity = (wave * (1j * K * (u - c)[:, None] * shape)).real + np.column_stack((u, 0 * u))
    x = np.stack(np.meshgrid(centres, rows, indexing="ij"), axis=2) + displacement
    x[..., 0] %= 1
    x[..., 1] = (x[..., 1] + 0.25) % 1 - 0.25
    pressure = K * size * (wave[..., 0] * p).real
    return {"x": x.reshape(-1, 2), "v": velocity.reshape(-1, 2), "rho": (rho + pressure / SOUND**2).ravel(),
            "mass": np.tile(rho / n**2, n), "group": np.tile(1 - fast.astype(int), n)}


def measure(run):
    """Of the wave in the vertical momentum, from 1.8 e-foldings in which k eta stays below 0.07."""
    groups = tomllib.loads((run.folder / "scene.toml").read_text())["group"]
    ratio, sound = groups[1]["density"] / groups[0]["density"], np.sqrt(groups[0]["bulk_modulus"])
    snapshots = run.snapshots()
    t = np.array([s.time for s in snapshots])
    wave = np.abs([s.mass @ (s.velocity[:, 1] * np.exp(-1j * K * s.position[:, 0])) for s in snapshots])
    early, late = (t > 0.2) & (t < 0.6), (t > 0.6) & (t < 1)
    rates = [np.polyfit(t[w], np.log(wave[w]), 1)[0] for w in (early | late, early, late)]
    exact, slow = (K * wave_speed(ratio, c).imag for c in (sound, 1e3))
    return {"growth rate": abs(rates[0] / exact - 1), "rate": rates[0], "exact": exact, "incompressible": slow,
            "early / exact": rates[1] / exact, "late / exact": rates[2] / exact}
