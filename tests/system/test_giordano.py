"""apps/volcano/giordano.py: constants of a basalt, what water does, what it refuses."""

import argparse
import subprocess
import sys
import unittest
from pathlib import Path

given = None
MORB = ["SiO2=50.42", "TiO2=1.53", "Al2O3=15.13", "FeO=9.81", "MgO=7.76", "CaO=11.35", "Na2O=2.83", "K2O=0.14"]


def run(*words):
    return subprocess.run([sys.executable, "-B", Path(given.source) / "apps/volcano/giordano.py", *words], capture_output=True,
                          text=True)


class Giordano(unittest.TestCase):
    def test_basalt_with_a_percent_of_water(self):
        line, at = run(*MORB, "H2O=1", "--at", "1473.15").stdout.splitlines()
        b, c = (float(line.split(f"{k} = ")[1].split(",")[0].rstrip(" }")) for k in "bc")
        self.assertAlmostEqual(b, 5515.14, delta=0.3)  # digits of the atomic weights
        self.assertAlmostEqual(c, 489.235, delta=0.03)
        self.assertIn("10^1.0553 Pa s", at)

    def test_water_makes_thin(self):
        def log_eta(*words):
            return float(run(*words, "--at", "1473.15").stdout.split("10^")[1].split()[0])

        self.assertLess(log_eta(*MORB, "H2O=2"), log_eta(*MORB))

    def test_refuses(self):
        for words, what in ((["Si02=50"], "Si02"), (["SiO2=x"], "SiO2=x"), (["H2O=1"], "oxides of the melt"),
                            ([*MORB, "--at", "300"], "glass")):
            done = run(*words)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(what, done.stderr)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--source", required=True)
    given, rest = parser.parse_known_args()
    unittest.main(argv=[sys.argv[0], *rest], verbosity=2)
