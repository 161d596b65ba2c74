"""Values of particles at points, by moving least squares of first order: exact for linear fields."""

import numpy as np
from scipy.spatial import cKDTree


def at(points, position, values, h, neighbours=30):
    """`values` (n,) or (n, k) of particles at `position` in 2D, at `points`; Gaussian weight of width h."""
    values = np.asarray(values, float).reshape(len(position), -1)
    distance, index = cKDTree(position).query(points, k=neighbours)
    out = np.empty((len(points), values.shape[1]))
    for n, (point, r, near) in enumerate(zip(points, distance, index)):
        basis = np.column_stack((np.ones(len(near)), position[near] - point))
        weight = np.exp(-0.5 * (r / h) ** 2)
        out[n] = np.linalg.lstsq(basis * weight[:, None], values[near] * weight[:, None], rcond=None)[0][0]
    return out
