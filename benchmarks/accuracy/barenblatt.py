"""Gas flow, Barenblatt's spot: pressures when it has spread to twice its radius, over their sum."""

import numpy as np

SCENE = "barenblatt.toml"
SIZES = (8, 16, 32)
ERROR = "L1"
PSI, RT, LIQUID = 0.5, 5e5, 1000
PEAK, FLOOR = 1e6, 1e-5
A = 1e-12 / (2 * 2e-5)  # u_t = A lap u^2
T0 = 1 / (16 * A * PEAK)


def limits(count):
    """Implicit, in steps of so many of the explicit limits of the start, 0.3 h^2 / D with D = 2 A PEAK."""
    return lambda n: ("terms.implicit_gas_flow=true", f"time.dt={count * 0.3 / n**2 / (2 * A * PEAK)}")


FORMULATIONS = {"explicit": (), "implicit": ("terms.implicit_gas_flow=true",), "implicit, 4 limits": limits(4)}


def settings(n):
    return (f"start.spacing={1 / n}",)


def exact(r, t):
    s = np.sqrt(t / T0)
    return np.maximum(PEAK - PEAK * r**2 / s, 0) / s


def start(n):
    """5 % of disorder. Gas fills the share psi of the volume: m liquid (1 - psi) RT = p psi."""
    centres = (np.arange(5 * n) + 0.5) / n - 2.5
    x = np.column_stack([a.ravel() for a in np.meshgrid(centres, centres)])
    x += np.random.default_rng(1).uniform(-0.05, 0.05, x.shape) / n
    m = (exact(np.hypot(*x.T), T0) + FLOOR * PEAK) * PSI / (RT * LIQUID * (1 - PSI))
    return {"x": x, "v": 0, "rho": LIQUID * (1 - PSI) * (1 + m), "m": m}


def measure(run):
    snapshots = run.snapshots()
    first, last = snapshots[0], snapshots[-1]
    r, t = np.hypot(*last.position.T), T0 + last.time
    u = exact(r, t)
    dx = np.sqrt(25 / len(r))
    rim = r[last.pressure > 1e-3 * u.max()].max()
    gas = [np.sum(s.mass) for s in (first, last)]
    return {"L1": np.abs(last.pressure - FLOOR * PEAK - u).sum() / u.sum(), "front ahead / dx": (rim - (t / T0)**0.25) / dx,
            "mass": gas[1] / gas[0] - 1, "steps": run.perf["steps"]}
