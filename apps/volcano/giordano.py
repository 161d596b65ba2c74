#!/usr/bin/python3
"""The constants of viscosity_law = "vogel" of a melt from its oxides, after Giordano, Russell & Dingwell (2008): log10 eta =
a + b / (T - c), eta in Pa s, T in K.

    giordano.py SiO2=50.42 TiO2=1.53 Al2O3=15.13 FeO=9.81 MgO=7.76 CaO=11.35 Na2O=2.83 K2O=0.14 H2O=1 [--at 1473]

Oxides in percent of the weight, FeO all of the iron; all but water are scaled so that the sum is 100. Prints the line for a
scene, and the viscosity at a temperature.
"""

import argparse
import math
import sys

WEIGHTS = {"SiO2": 60.0843, "TiO2": 79.8658, "Al2O3": 101.961276, "FeO": 71.8444, "MnO": 70.937449, "MgO": 40.3044, "CaO": 56.0774,
           "Na2O": 61.97894, "K2O": 94.1960, "P2O5": 141.9446, "H2O": 18.01528, "F2O": 37.9968}  # g/mol
A = -4.55


def mole_percents(weights):
    """Of weight percents; volatiles as they are, the rest scaled to what they leave."""
    given = {oxide: weights.get(oxide, 0.0) for oxide in WEIGHTS}
    volatiles = given["H2O"] + given["F2O"]
    dry = sum(given.values()) - volatiles
    moles = {oxide: w * (1 if oxide in ("H2O", "F2O") else (100 - volatiles) / dry) / WEIGHTS[oxide] for oxide, w in given.items()}
    total = sum(moles.values())
    return {oxide: 100 * n / total for oxide, n in moles.items()}


def constants(weights):
    """B and C [K]: their table 1."""
    x = mole_percents(weights)
    volatiles = x["H2O"] + x["F2O"]
    iron, titania_alumina, alkalis = x["FeO"] + x["MnO"] + x["MgO"], x["TiO2"] + x["Al2O3"], x["Na2O"] + x["K2O"]
    b = (159.56 * (x["SiO2"] + x["TiO2"]) - 173.34 * x["Al2O3"] + 72.13 * (x["FeO"] + x["MnO"] + x["P2O5"]) + 75.69 * x["MgO"] -
         38.98 * x["CaO"] - 84.08 * (x["Na2O"] + volatiles) + 141.54 * (volatiles + math.log(1 + x["H2O"])) -
         2.43 * (x["SiO2"] + x["TiO2"]) * iron - 0.91 * (x["SiO2"] + titania_alumina + x["P2O5"]) * (alkalis + x["H2O"]) +
         17.62 * x["Al2O3"] * alkalis)
    c = (2.75 * x["SiO2"] + 15.72 * titania_alumina + 8.32 * iron + 10.20 * x["CaO"] - 12.29 * alkalis -
         99.54 * math.log(1 + volatiles) + 0.30 * (x["Al2O3"] + iron + x["CaO"] - x["P2O5"]) * (alkalis + volatiles))
    return b, c


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("oxides", nargs="+", metavar="OXIDE=PERCENT")
    parser.add_argument("--at", type=float, help="temperature [K]")
    given = parser.parse_args()
    weights = {}
    for text in given.oxides:
        oxide, _, percent = text.partition("=")
        try:
            weights[oxide] = float(percent)
        except ValueError:
            parser.error(f"{text}: write it like SiO2=50.42")
        if oxide not in WEIGHTS or not 0 <= weights[oxide] <= 100:
            parser.error(f"{text}: give one of {', '.join(WEIGHTS)} from 0 to 100")
    if not sum(w for oxide, w in weights.items() if oxide not in ("H2O", "F2O")) > 0:
        parser.error("give the oxides of the melt, not its volatiles alone")
    b, c = constants(weights)
    print(f'viscosity_law = {{ law = "vogel", a = {A}, b = {b:.2f}, c = {c:.3f} }}')
    if given.at is not None:
        if given.at <= c:
            parser.error(f"--at {given.at}: below c, a glass")
        print(f"# at {given.at} K: 10^{A + b / (given.at - c):.4f} Pa s")


if __name__ == "__main__":
    sys.exit(main())
