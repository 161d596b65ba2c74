"""Drag on a grain held in a creeping flow, h/d = 6, 3, 2 (Wendland kernels 8, 4, 2.7), against Stokes.

One grain of diameter d = 1 in a periodic box of L = 60 d, from uniform flow, Re = 0.001; its disturbance has spread over the
box after (L / 2 pi)^2 / nu = 0.9. In such a box the fluid meets images of the grain, too, whose point forces make the drag at the mean
speed U (Hasimoto 1959)
  F = 3 pi eta d U / (1 - 2.837297 d / 2 L).
The force is spread over the kernel, however wide: coarser is better, until the box is too small for it. Density diffusion lets
fluid through where it is pushed, less of it with a faster sound.
"""

import numpy as np

SCENE = "held_grain.toml"
SIZES = (12, 24, 36)  # particles along the box
ERROR = "drag"
LENGTH, DIAMETER, VISCOSITY = 60, 1, 100
EXACT = 3 * np.pi * VISCOSITY * DIAMETER / (1 - 2.837297 * DIAMETER / (2 * LENGTH))

FORMULATIONS = {
    "default": (),
    "mixed": ("precision=mixed",),
    "wendland c2": ("kernel.shape=wendland_c2", "kernel.h_over_dx=1.6"),
    "wendland c4": ("kernel.shape=wendland_c4", "kernel.h_over_dx=1.6"),
    "c = 500": ("group.fluid.sound_speed=500",),
    "own disturbance left in": ("drag.own_disturbance=false",),
}


def settings(n):
    return (f"start.spacing={LENGTH / n}",)


def measure(run):
    last = run.snapshots()[-1]
    fluid = last.group == 0
    speed = np.average(last.velocity[fluid, 0], weights=last.mass[fluid])
    ratio = last.fluid_force[~fluid][0, 0] / (EXACT * speed)
    return {"drag": abs(ratio - 1), "of Stokes'": ratio}
