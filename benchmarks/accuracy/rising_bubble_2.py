"""Rising bubble 2 (Hysing et al. 2009): density 1:1000, viscosity 1:100, Eo = 125; before the skirt breaks."""

import numpy as np

import rising_bubble

SCENE = "rising_bubble.toml"
SIZES = (20, 40, 80)
ERROR = "first largest rise velocity"
FIRST, SECOND, CENTRE = 0.2513, 0.2416, 1.1315  # middle of the groups' values
BUBBLE = ("group.bubble.density=1", "group.bubble.viscosity=0.1", "group.bubble.sound_speed=100",
          "terms.surface_tension.coefficient=1.96")

FORMULATIONS = {name: (*BUBBLE, *sets) for name, sets in rising_bubble.FORMULATIONS.items()}


def settings(n):
    return rising_bubble.settings(n)


def measure(run):
    time, speed = rising_bubble.smooth_speed(run)
    series = run.series()
    first = speed[(time > 0.4) & (time < 1.2)].max()  # before: the sound of the start
    second = speed[(time > 1.6) & (time < 2.4)].max()
    return {"first largest rise velocity": abs(first / FIRST - 1), "first": first, "second": second,
            "second, error": abs(second / SECOND - 1),
            "centre of mass at 3 s": abs(np.interp(3, series["t"], series["bubble_y"]) / CENTRE - 1)}
