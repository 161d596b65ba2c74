"""Measures of interfaces where the answer is known: length and area of a perturbed circle, elongation of a drop drawn out,
and the frequency of its oscillation in the limit of no viscosity."""

import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "benchmarks/accuracy"))
import drop  # noqa: E402
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


class Drop(unittest.TestCase):
    def test_elongation(self):
        for eps in (0, 0.05):
            found = drop.start(16, eps)
            inside = found["group"]
            position = found["x"][inside]
            elongation = drop.elongation(position, np.full(len(position), 1 / 16**2))
            print(f"drawn out by {eps}: {elongation:.4f}")
            self.assertLess(abs(elongation - eps), 0.001)

    def test_limit_of_no_viscosity(self):
        times = np.linspace(0, 8, 9)
        self.assertLess(np.abs(drop.exact(times, 1e-9) - np.cos(np.sqrt(3) * times)).max(), 3e-3)

    def test_viscosity(self):
        """The root s = -0.0436 + 1.6904 i of s = 3 answer(s) is the wave that is left when the shear layers have formed."""
        root = -0.04361818 + 1.69042978j
        self.assertLess(abs(root - 3 * drop.answer(root, drop.VISCOSITY)), 1e-6)
        times = np.linspace(4, 8, 200)
        wave = np.column_stack([np.exp(root * times).real, np.exp(root * times).imag])
        series = drop.exact(times)
        rest = series - wave @ np.linalg.lstsq(wave, series, rcond=None)[0]
        print(f"linear theory: {np.abs(rest).max():.1e} is not of the wave")
        self.assertLess(np.abs(rest).max(), 3e-3)


if __name__ == "__main__":
    unittest.main()
