"""The measure of an interface's length on particles that follow a perturbed circle: both length and area are known."""

import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "benchmarks/accuracy"))
import interface  # noqa: E402


def rings(dx, amplitude):
    """Particles on rings about the origin, drawn out by 1 + amplitude cos 3 phi; those of r < 20 dx are inside."""
    radius = np.concatenate([np.full(n := round(2 * np.pi * (k + 0.5)), (k + 0.5) * dx) for k in range(30)])
    angle = np.concatenate([2 * np.pi * (np.arange(n := round(2 * np.pi * (k + 0.5))) + 0.5 * (k % 2)) / n
                            for k in range(30)])
    stretch = radius * (1 + amplitude * np.cos(3 * angle))
    return np.column_stack([stretch * np.cos(angle), stretch * np.sin(angle)]), radius < 20 * dx


def exact(amplitude):
    """Length and area of r = 1 + amplitude cos 3 phi."""
    phi = np.linspace(0, 2 * np.pi, 20001)
    r = 1 + amplitude * np.cos(3 * phi)
    points = np.column_stack([r * np.cos(phi), r * np.sin(phi)])
    return np.linalg.norm(np.diff(points, axis=0), axis=1).sum(), np.pi * (1 + 0.5 * amplitude**2)


class Interface(unittest.TestCase):
    def test_perturbed_circle(self):
        for amplitude in (0, 0.1, 0.2):
            position, inside = rings(0.05, amplitude)
            found = interface.length_and_area(position, inside, 0.05, 0.06)
            for ours, theirs, what in zip(found, exact(amplitude), ("length", "area")):
                print(f"amplitude {amplitude}: {what} {ours:.4f}, exact {theirs:.4f}")
                self.assertLess(abs(ours / theirs - 1), 0.003 if amplitude == 0 else 0.02)


if __name__ == "__main__":
    unittest.main()
