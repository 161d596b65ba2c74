#!/usr/bin/python3
"""Slow flow side by side with PETSc's own examples ex43 (2D, SolCx of 1e6) and ex42 (3D, a sinking cube of 1e2), in one
run, alternating, medians. Run on a quiet machine.

    stokes.py BUILD [--cells-2d 64 128 256] [--cells-3d 32 64] [--ranks 1 2] [--repeats 5] [--page]

The examples are those that Debian ships (apt-get install libpetsc-real-dev libpetsc3.18-dev-examples); peers/petsc_clock.h
times them. They are finite elements, Q1 for velocities and pressures, with assembled matrices; ours are finite differences
on a staggered grid without any. Both solve to a residual of 1e-6 by FGMRES with the block triangle of one multigrid cycle and
the pressure's mass over the viscosity; the peer's cycle smooths as ours does (Chebyshev of 4 with Jacobi) or by SOR (2),
whichever is faster. A peer's time is that of its set-up and its solution; its assembly stands beside it.
"""
import argparse
import re
import shutil
import statistics
import subprocess
import sys
from pathlib import Path

import tables
from speed import run

here = Path(__file__).resolve().parent
PACKAGES = "libpetsc-real-dev libpetsc3.18-dev-examples"
NUMBERS = re.compile(r"(?:assembly (?P<assembly>\S+) s, )?set-up (?P<set_up>\S+) s, solve (?P<solve>\S+) s, "
                     r"(?P<iterations>\d+) iterations to (?P<residual>\S+?)(?P<bad> \(not converged\))?, "
                     r"rms speed (?P<speed>[^\s,]+)")
SPLIT = """-stokes_ksp_type fgmres -stokes_ksp_gmres_restart 40 -stokes_ksp_rtol 1e-6 -stokes_pc_type fieldsplit
    -stokes_pc_fieldsplit_type schur -stokes_pc_fieldsplit_schur_fact_type upper -stokes_pc_fieldsplit_off_diag_use_amat
    -stokes_pc_fieldsplit_schur_precondition a11 -stokes_fieldsplit_p_ksp_type preonly -stokes_fieldsplit_p_pc_type jacobi
    -stokes_fieldsplit_u_ksp_type preonly -stokes_fieldsplit_u_pc_type mg -stokes_fieldsplit_u_pc_mg_galerkin pmat
    -stokes_fieldsplit_u_mg_levels_ksp_type chebyshev""".split()
SMOOTHERS = {
    "Jacobi": "-stokes_fieldsplit_u_mg_levels_pc_type jacobi -stokes_fieldsplit_u_mg_levels_ksp_max_it 4".split(),
    "SOR": "-stokes_fieldsplit_u_mg_levels_pc_type sor -stokes_fieldsplit_u_mg_levels_ksp_max_it 2".split(),
}
MODELS = {2: "-c_str 0 -solcx_eta0 1 -solcx_eta1 1e6 -solcx_xc 0.5 -solcx_nz 1".split(), 3: "-model 3".split()}
EXAMPLES = {2: "ex43", 3: "ex42"}


def build_peers(folder):
    """The programs of ex43 and ex42 by dimension, compiled there."""
    sources = sorted(Path("/usr/share/petsc").glob("*/share/petsc/examples/src/ksp/ksp/tutorials/ex43.c"))
    found = subprocess.run(["pkg-config", "--cflags", "--libs", "PETSc"], capture_output=True, text=True)
    if not sources or found.returncode != 0:
        sys.exit(f"no PETSc: apt-get install {PACKAGES}")
    folder.mkdir(exist_ok=True)
    for dim, name in EXAMPLES.items():
        grid = ["-DPEER_GIVES_GRID"] if dim == 3 else []
        run(["mpicc", "-O3", "-march=native", "-w", "-include", here / "peers/petsc_clock.h", *grid,
             sources[-1].parent / f"{name}.c", *found.stdout.split(), "-lm", "-o", folder / name])
    return {dim: folder / name for dim, name in EXAMPLES.items()}


def levels(cells):
    """Of a peer's multigrid, down to 4 to 7 cells, as ours."""
    n = 1
    while cells % 2 == 0 and cells // 2 >= 4:
        cells, n = cells // 2, n + 1
    return n


def numbers(command, ranks):
    out = run(["mpirun", "-np", str(ranks), *command])
    found = NUMBERS.search(out)
    if not found or found["bad"]:
        sys.exit(f"{' '.join(map(str, command))}\n{out}")
    return {key: float(found[key] or 0) for key in ("assembly", "set_up", "solve", "iterations", "residual", "speed")}


def with_set_up(timing):
    return timing["set_up"] + timing["solve"]


def median_of(timings, value):
    return statistics.median(map(value, timings))


class Case:
    """One problem on one number of ranks: timings of all that solve it."""

    def __init__(self, dim, cells, ranks):
        self.dim, self.cells, self.ranks, self.timings = dim, cells, ranks, {}

    def measure(self, ours, peers, repeats):
        of_peer = [peers[self.dim], "-mx", str(self.cells), "-my", str(self.cells), *MODELS[self.dim], *SPLIT,
                   "-stokes_fieldsplit_u_pc_mg_levels", str(levels(self.cells))]
        commands = {"ours": [ours, "--dimension", str(self.dim), "--cells", str(self.cells), "--repeats", "1"],
                    **{name: [*of_peer, *options] for name, options in SMOOTHERS.items()}}
        for _ in tables.turns(repeats):
            for name, command in commands.items():
                self.timings.setdefault(name, []).append(numbers(command, self.ranks))
        speeds = {name: timings[0]["speed"] for name, timings in self.timings.items()}
        if max(speeds.values()) > 1.2 * min(speeds.values()):
            sys.exit(f"{self.name()}: these are other flows: {speeds}")

    def name(self):
        return f"{'SolCx' if self.dim == 2 else 'cube'}, {self.cells}^{self.dim}, {self.ranks}"

    def row(self):
        ours = self.timings["ours"]
        best = min(SMOOTHERS, key=lambda name: median_of(self.timings[name], with_set_up))
        peer = self.timings[best]
        ratios = sorted(with_set_up(p) / with_set_up(o) for p, o in zip(peer, ours))
        iterations = [f"{t[0]['iterations']:.0f}" for t in (ours, peer)]
        unknowns = (self.dim + 1) * self.cells**self.dim
        each = 1e9 * median_of(ours, lambda t: t["solve"] / t["iterations"]) / unknowns
        return (self.name(), f"{median_of(ours, with_set_up):.3f} s, {iterations[0]} iterations", f"{each:.0f} ns",
                f"{median_of(peer, with_set_up):.3f} s, {iterations[1]} ({best})",
                f"{median_of(peer, lambda t: t['solve']):.3f} s", f"{median_of(peer, lambda t: t['assembly']):.3f} s",
                f"{statistics.median(ratios):.2f}x", f"{ratios[0]:.2f} to {ratios[-1]:.2f}")


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path)
    arguments.add_argument("--cells-2d", type=int, nargs="*", default=[64, 128, 256])
    arguments.add_argument("--cells-3d", type=int, nargs="*", default=[32, 64])
    arguments.add_argument("--ranks", type=int, nargs="+", default=[1, 2])
    arguments.add_argument("--repeats", type=int, default=5)
    arguments.add_argument("--page", action="store_true", help="write the table of README.md")
    options = arguments.parse_args()
    build = options.build.resolve()
    if shutil.which("mpicc") is None:
        sys.exit("no mpicc")
    peers = build_peers(build / "petsc_peers")
    rows = []
    for dim, sizes in ((2, options.cells_2d), (3, options.cells_3d)):
        for cells in sizes:
            for ranks in options.ranks:
                case = Case(dim, cells, ranks)
                case.measure(build / "bin/slow_flow", peers, options.repeats)
                rows.append(case.row())
                print(" | ".join(rows[-1]), flush=True)
    if options.page:
        tables.write(here / "README.md", "slow-flow", tables.origin(tables.commit_of(build)),
                     tables.markdown(("case, ranks", "with set-up", "an unknown and iteration", "PETSc with set-up",
                                      "its solution alone", "its assembly besides", "median of ratios", "all"), rows))


if __name__ == "__main__":
    main()
