"""Convection between a warm and a cold wall, Ra 1e5: against de Vahl Davis (1983)."""

import numpy as np

import kernel

SCENE = "de_vahl_davis.toml"
SIZES = (50, 100)
ERROR = "largest departure / value"
NUSSELT, ACROSS, UP = 4.519, 34.73, 68.59
FORMULATIONS = {"default": ()}


def settings(n):
    wall = 3 / n
    return (f"start.spacing={1 / n}", f"start.lower={[-wall, -wall]}", f"start.upper={[1 + wall, 1 + wall]}",
            "domain.gravity=[0, -710]", "group.fluid.sound_speed=800", "time.until=0.3", "output.snapshot_interval=0.005")


def measure(run):
    """Mean over the last quarter of the time. Nu is the mean over the square of u (T - T_m) + 1."""
    snapshots = run.snapshots()
    late = [s for s in snapshots if s.time > 0.75 * snapshots[-1].time]
    nusselt = across = up = 0
    line = np.linspace(0.01, 0.99, 99)
    for s in late:
        h = 1 / np.sqrt(len(s.position))
        nusselt += (np.mean(s.velocity[:, 0] * (s.temperature - 1.5)) + 1) / len(late)
        across += kernel.at(np.column_stack((0.5 + 0 * line, line)), s.position, s.velocity[:, 0], h).max() / len(late)
        up += kernel.at(np.column_stack((line, 0.5 + 0 * line)), s.position, s.velocity[:, 1], h).max() / len(late)
    return {ERROR: max(abs(nusselt / NUSSELT - 1), abs(across / ACROSS - 1), abs(up / UP - 1)),
            "Nu": nusselt, "largest u": across, "largest v": up}
