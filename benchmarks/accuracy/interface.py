"""The interface between two fluids: length and area inside it.

The shares of the two fluids, smoothed with the kernel and divided by their sum, are 1/2 on the interface. It is drawn on
a grid of half a spacing. A lattice cut by a circle makes steps, which are measured as 1 % more length; on particles
that follow the interface the length of a circle of 20 spacings is met to 0.1 %, its area to 0.2 %
(tests/accuracy/test_interface.py).
"""

import contourpy
import numpy as np
from scipy.spatial import cKDTree


def smoothed(points, position, share, h):
    """Kernel mean of the shares at points, with the quintic kernel."""
    tree = cKDTree(position)
    mean = np.zeros(len(points))
    for k, near in enumerate(tree.query_ball_point(points, 3 * h)):
        q = np.linalg.norm(position[near] - points[k], axis=1) / h
        weight = sum(factor * np.clip(reach - q, 0, None)**5 for factor, reach in ((1, 3), (-6, 2), (15, 1)))
        mean[k] = weight @ share[near] / max(weight.sum(), 1e-30)
    return mean


def length_and_area(position, inside, dx, h):
    """Of the closed curves around particles of which `inside` is true; they must not cross the edge of the grid."""
    low, high = (f(position[inside], axis=0) + sign * 4 * dx for f, sign in ((np.min, -1), (np.max, 1)))
    x, y = (np.arange(a, b, 0.5 * dx) for a, b in zip(low, high))
    grid = np.stack(np.meshgrid(x, y), axis=-1)
    share = smoothed(grid.reshape(-1, 2), position, inside.astype(float), h).reshape(grid.shape[:2])
    curves = contourpy.contour_generator(x, y, share).lines(0.5)
    length = sum(np.linalg.norm(np.diff(c, axis=0), axis=1).sum() for c in curves)
    area = sum(0.5 * abs(np.sum(c[:-1, 0] * c[1:, 1] - c[1:, 0] * c[:-1, 1])) for c in curves)
    return length, area


def circularity(position, inside, dx, h):
    """Circumference of the circle of the same area over the length: 1 for a circle."""
    length, area = length_and_area(position, inside, dx, h)
    return 2 * np.sqrt(np.pi * area) / length
