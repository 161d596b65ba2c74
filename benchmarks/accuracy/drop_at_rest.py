"""Drop at rest in a thin fluid like it, Oh = 0.002: parasitic currents and pressure jump, in sqrt(sigma / rho R) and sigma / R."""

import numpy as np

import drop

SCENE = "drop.toml"
SIZES = (8, 12, 16)  # spacings a radius
ERROR = "rms at the interface"

JUMP = "terms.surface_tension.form=jump"
FORMULATIONS = {
    "default": (),
    "tension as a jump": (JUMP,),
    "jump, pressures by density": (JUMP, "terms.pressure_weights=density"),
    "pressures by density": ("terms.pressure_weights=density",),
    "no shifting": ("terms.shifting=false",),
}


def settings(n):
    return (f"start.spacing={1 / n}",)


def start(n):
    return drop.start(n, 0)


def measure(run):
    """Over the second half of the run; the jump is that from r < 0.6 to r > 1.5."""
    rms, largest, jump = [], [], []
    snapshots = run.snapshots()
    for s in snapshots:
        if s.time < 0.5 * snapshots[-1].time:
            continue
        inside = s.group == 1
        centre = s.position[inside].mean(axis=0)
        r, speed = np.hypot(*(s.position - centre).T), np.hypot(*s.velocity.T)
        dx = np.sqrt(drop.SIDE**2 / len(r))
        rms.append(np.sqrt(np.mean(speed[np.abs(r - 1) < 2 * dx]**2)))
        largest.append(speed.max())
        jump.append(s.pressure[r < 0.6].mean() - s.pressure[r > 1.5].mean())
    return {"rms at the interface": np.mean(rms), "largest": max(largest), "pressure jump": np.mean(jump),
            "drift of the centre / R": np.hypot(*centre)}
