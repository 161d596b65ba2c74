#!/usr/bin/python3
"""What a user may get wrong before a run begins: each is refused at once, with one line and exit 2.

    input_cases.py --programs build/bin --source . [--mpirun mpirun] [name ...]
"""
import argparse
import os
import re
import sys
import time
import tomllib
from pathlib import Path

import h5py
import numpy as np

from check_cases import CheckCases
from runner import Runner, run_all

SAND = """
[domain]
lower = [0, 0, 0]
upper = [0.036, 0.012, 0.02]
gravity = [0, 0, -9.81]
[contact]
law = "linear"
largest_overlap = 0.4
[[group]]
name = "sand"
kind = "grain"
diameter = "1 mm"
density = 2500
normal_stiffness = 100
restitution = 0.5
[start]
file = "start.csv"
[time]
dt = "15 us"
steps = 1
"""
WARM = """
[domain]
lower = [0, 0]
upper = [12, 12]
periodic = [true, true]
[kernel]
h_over_dx = 1.0
[[group]]
name = "melt"
kind = "fluid"
density = 2500
sound_speed = 100
temperature = 1000
heat = { specific_heat = 1000, conductivity = 2 }
viscosity_law = { law = "vogel", a = 2.0, b = 1000, c = 500 }
[start]
spacing = 1
[[start.region]]
group = "melt"
[time]
steps = 1
dt = 2e-3
"""
HEADER = "id,x,y,z,vx,vy,vz,group,radius"


class Cases(CheckCases):
    def __init__(self, run, source):
        self.run = run
        self.source = Path(source)
        self.pour = Path(source) / "tests" / "scenes" / "grains_pour.toml"
        self.cases = Path(source) / "apps" / "buoyant_cylinder"
        self.sand = run.folder / "sand.toml"
        self.sand.write_text(SAND)

    def file(self, name, text):
        path = self.run.folder / name
        path.write_bytes(text.encode())
        return path

    def rows(self, *rows, end="\n"):
        return self.file("start.csv", end.join([HEADER, *rows]) + end)

    def test_steps_too_long(self):
        scene = self.file("warm.toml", WARM)
        self.run.run(1, "peperite", "run", scene, "--out", "warm")
        self.refused("run", scene, "--out", "bad", "--set", "group.melt.heat.conductivity=1e9", ranks=(2,),
                     says="time.dt: 0.002 s is above the limit of explicit conduction")
        self.refused("run", scene, "--out", "bad", "--set", "group.melt.viscosity_law.a=5", ranks=(2,),
                     says="group.melt.viscosity_law.most: 1e+07 is unstable with time steps of 0.002 s; set it to")

    def refused(self, *arguments, says, ranks=(1, 3)):
        for n in ranks:
            begin = time.monotonic()
            self.run.refused(n, "peperite", *arguments, says=says)
            assert time.monotonic() - begin < 40, f"{arguments} takes too long"

    # ---- the command line ----------------------------------------------------------------------------------

    def test_options(self):
        scene = self.pour
        for steps in ("18446744073709551616", "9223372036854775808", "-1", "1.5", "", "nan"):
            self.refused("run", scene, "--steps", steps, "--out", "no", says="--steps", ranks=(1,))
        for until in ("nan", "inf", "-1", "", "soon", "5 m", "1e999"):
            self.refused("run", scene, "--until", until, "--out", "no", says="--until", ranks=(1,))
        for limit in ("", "nan", "inf", "-1", "1:2:3:4", "1e5", "0:0:x", ":"):
            self.refused("run", scene, "--max-time", limit, "--out", "no", says="--max-time", ranks=(1,))
        self.refused("run", scene, "--out", "", says="--out", ranks=(1,))
        for end in (["--steps", 3], ["--until", "1 ms"]):  # the end that they replace
            for key in ("time.steps=-1", "time.until=-1"):
                self.refused("run", scene, "--set", key, *end, "--out", "no", says=f"{key[:-3]}: is -1", ranks=(1,))
        self.refused("run", scene, "--steps", "18446744073709551616", "--out", "no", says="--steps", ranks=(3,))
        assert not (self.run.folder / "no").exists()
        short = self.run.run(1, "peperite", "run", scene, "--until", "30 us", "--out", "short")
        assert " step 2 " in short.fingerprint, short.fingerprint

    # ---- the scene file ------------------------------------------------------------------------------------

    def test_no_scene_file(self):
        pipe = self.run.folder / "pipe"
        os.mkfifo(pipe)
        for path, says in (("/dev/zero", "device"), (pipe, "pipe"), (self.run.folder, "directory"),
                           (self.file("large.toml", "#" * 5_000_000), "5000000 bytes")):
            self.refused("check", path, says=says)
        for key in ("start.file", "start.tile.file"):
            for path in ("/dev/zero", pipe):
                self.refused("check", self.sand, "--set", "start.file=", "--set", "start.tile.repeat=[1, 1, 1]",
                             *(["--set", "start.tile="] if key == "start.file" else []), "--set", f"{key}={path}",
                             says="device", ranks=(1,))

    def test_deep_keys(self):
        deep = "a" + ".a" * 100_000
        for text in (deep + " = 1", f"[{deep}]", f"x = {{ {deep} = 1 }}", '"a"' + '."a"' * 100_000 + " = 1"):
            self.refused("check", self.file("deep.toml", text), says="too many parts", ranks=(1,))
        self.refused("check", self.sand, "--set", deep[:60_000] + "=1", says="too many parts")
        self.refused("check", self.sand, "--set", f"title={{ {deep[:60_000]} = 1 }}", says="too many parts", ranks=(1,))
        # Dots in texts and comments are no keys.
        self.rows("1,0.01,0.006,0.002,0,0,0,sand,0.0005")
        kind = f"# {'.' * 99}\ntitle = \"{'a.' * 99}\"\n"
        more = f"[[monitor]]\nkind = \"energy\"\nname = '''energy''' # {'a.' * 99}\n"
        self.run.run(1, "peperite", "check", self.file("kind.toml", kind + SAND + more))

    # ---- starts ---------------------------------------------------------------------------------------------

    def test_suction(self):
        flow = self.cases.parents[1] / "benchmarks" / "accuracy" / "taylor_green.toml"
        for command in (["check"], ["run", "--out", "no"]):
            self.refused(command[0], flow, *command[1:], "--set", "start.flow_speed=20", says="would have a density of -")
            self.refused(command[0], self.cases / "gas.toml", *command[1:], "--set", "start.pressure=zero", "--set",
                         "start.surface_height=", "--set", "domain.surface_pressure=0", says="raise domain.surface_pressure")

    def test_overlaps(self):
        near = "{},{},0.006,0.002,0,0,0,sand,0.0005"
        self.rows(near.format(5, 0.01), near.format(3, 0.02), near.format(9, 0.0107), near.format(4, 0.01065))
        for command in (["check"], ["run", "--out", "no"]):
            self.refused(command[0], self.sand, *command[1:],
                         says="start.csv: grain 4 (line 5) and grain 5 (line 2) overlap by 0.7 radii; "
                              "contact.largest_overlap allows 0.4")
        tile = ["--set", "start.file=", "--set", "start.tile.file=start.csv", "--set", "start.tile.repeat=[1, 1, 1]"]
        self.refused("check", self.sand, *tile, says="grain 1 (line 5 in copy 0) and grain 2 (line 2 in copy 0)", ranks=(1,))
        self.rows("8,0.01,0.006,0.0001,0,0,0,sand,0.0005")
        wall = self.file("wall.toml", SAND + "[[wall]]\nname = \"floor\"\nmaterial = \"sand\"\npoint = [0, 0, 0]\n"
                         "normal = [0, 0, 1]\n")
        self.refused("run", wall, "--out", "no", says="grain 8 (line 2) lies 0.8 radii deep in wall \"floor\"")
        self.rows(near.format(5, 0.01), near.format(3, 0.0109))
        self.run.run(1, "peperite", "check", self.sand)
        # Particles of a fluid must not coincide.
        self.file("same.csv", "id,x,y,z,vx,vy,vz,group\n" + "".join(f"{i},0.5,0.5,0.5,0,0,0,water\n" for i in (1, 2)))
        self.refused("check", self.file("fluid.toml", self.FLUID), "--set", "start.region=", "--set",
                     "start.file=same.csv", says="line 3: the particle lies at exactly the point of that in line 2")

    def test_hexagons(self):
        """Over a period every particle has six neighbours at one distance, whether rounding makes it longer or shorter."""
        scene = self.file("hexagons.toml", WARM.replace("spacing = 1", "spacing = 1\nlattice = \"hexagonal\""))
        self.refused("check", scene, says="in x into 11.1673 columns; make that length 11.82026925 m, which holds 11 columns")
        for n, (x, y) in enumerate(((21.49139, 22.33451), (21.4914, 22.33452))):
            self.run.run(1, "peperite", "run", scene, "--set", f"domain.upper=[{x}, {y}]",
                         "--set", "time.steps=0", "--set", "output.snapshot_interval=0", "--out", f"hexagons{n}")
            with h5py.File(self.run.folder / f"hexagons{n}" / "snapshot_000000000.h5") as file:
                places = file["particles/position"][:]
            assert len(places) == 480, len(places)
            apart = places[:, None] - places
            apart = np.sort(np.hypot(*np.moveaxis(apart - [x, y] * np.round(apart / [x, y]), 2, 0)))
            assert np.all(np.abs(apart[:, 1:7] - 1.07457) < 2e-5), apart[:, 1:7]

    def test_every_key(self):
        """The scenes that show every key run."""
        scenes = sorted((self.source / "tests" / "every_key").glob("*.toml"))
        assert len(scenes) > 5
        for scene in scenes:
            self.run.run(2, "peperite", "run", scene, "--set", "decomposition.record=", "--steps", 100, "--out", scene.stem)

    def test_keys(self):
        """Every form of the reference, and one at a time."""
        forms = {"": "\n[[group]]  A material", "--markdown": "\n| `density` | number [kg/m3], positive |",
                 "--toml": "\n#density = \"1 kg/m3\"\n", "--json-schema": "\"$schema\": "}
        for form, text in forms.items():
            assert text in self.run.run(1, "peperite", "keys", *form.split()).out, form
        tomllib.loads(self.run.run(3, "peperite", "keys", "--toml").out)
        for wrong in (["--toml", "--markdown"], ["density"], ["--jsn-schema"]):
            self.refused("keys", *wrong, says="--help", ranks=(1,))

    # ---- programs -------------------------------------------------------------------------------------------

    def test_readme(self):
        text = (self.source / "README.md").read_text()
        scene = self.file("first.toml", re.search(r"```toml\n(.*?)```", text, re.S)[1])
        assert "warning" not in self.run.run(1, "peperite", "check", scene).out
        assert self.run.run(2, "peperite", "run", scene, "--steps", 20, "--out", self.run.folder / "first").out

    def test_programs(self):
        for program in sorted(self.run.programs.iterdir()):
            if not os.access(program, os.X_OK) or program.is_dir():
                continue
            text = self.run.run(1, program.name, "--help").out
            assert len(text) > 40, f"{program.name} --help says nothing"
            result = self.run.run(1, program.name, "--no-such-option", code=2)
            lines = [line for line in result.err.splitlines() if line]
            assert len(lines) == 1, f"{program.name}: {result.err}"

    # ---- start files ---------------------------------------------------------------------------------------

    def test_ids(self):
        """Keys of walls lie above all ids."""
        there = "0.01,0.006,0.00049,0,0,0,sand,0.0005"
        for bad in (2**63, 2**63 + 1, 2**64 - 1):
            self.rows(f"7,{there.replace('0.01,', '0.02,')}", f"{bad},{there}")
            for command in (["check"], ["run", "--out", "no"]):
                self.refused(command[0], self.sand, *command[1:], says=f"line 3: id is {bad}; it must be at most 2^63 - 1")
            tile = ["--set", "start.file=", "--set", "start.tile.file=start.csv", "--set", "start.tile.repeat=[1, 1, 1]"]
            self.refused("check", self.sand, *tile, says=f"line 3: id is {bad}", ranks=(1,))
        self.rows(f"{2**64},{there}")
        self.refused("check", self.sand, says="line 2: id", ranks=(1,))
        fluid = self.cases / "fluid.toml"
        lattice = [f"--set=start.{key}=" for key in ("lattice", "origin", "lower", "upper", "region")]
        self.file("fluid.csv", f"id,x,y,vx,vy,group\n{2**63},20,20,0,0,melt\n")
        self.refused("check", fluid, *lattice, "--set", "start.file=fluid.csv", says="line 2: id is 9223372036854775808")
        self.rows(f"{2**63 - 1},{there}")
        self.run.run(1, "peperite", "check", self.sand)

    def test_line_ends(self):
        rows = ("7,0.01,0.006,0.00049,0,0,0,sand,0.0005", "8,0.02,0.006,0.00049,0,0,0,sand,0.0005")
        prints = set()
        for end in ("\n", "\r\n"):
            self.rows(*rows, end=end)
            prints.add(self.run.run(2, "peperite", "run", self.sand, "--out", f"ends{len(end)}").fingerprint)
        assert len(prints) == 1
        for rows in (rows, ("# a comment",) + rows):
            self.rows(*rows, end="\r")
            self.refused("check", self.sand, says="ends its lines with CR alone")
        self.file("start.csv", f"# first\r{HEADER}\r{rows[1]}\r")
        self.refused("check", self.sand, says="ends its lines with CR alone", ranks=(1,))

    def test_encodings(self):
        scene = self.file("fluid.toml", self.FLUID)
        text = "id,x,y,z,vx,vy,vz,group\n1,0.5,0.5,0.5,0,0,0,water\n"
        rows = self.run.folder / "rows.csv"
        use = ["--set", "start.region=", "--set", "start.file=rows.csv"]
        rows.write_bytes(text.encode("utf-8-sig"))
        self.run.run(1, "peperite", "check", scene, *use)
        rows.write_bytes(text.encode("utf-16"))
        self.refused("check", scene, *use, says="UTF-16; save it as ASCII or UTF-8")
        rows.write_bytes(text.replace("water", "wa\0ter").encode())
        self.refused("check", scene, *use, says="line 2: holds a byte of value 0")

    def test_extreme_rows(self):
        scene = self.file("fluid.toml", self.FLUID)
        rows = self.run.folder / "rows.csv"
        for column, value, says in (("rho", "1e-300", "particle 7 of group water would have a density of 1e-300 kg/m^3"),
                                    ("mass", "1e30", "particle 7 of group water would have a mass of 1e+30 kg")):
            rows.write_text(f"id,x,y,z,vx,vy,vz,group,{column}\n7,0.5,0.5,0.5,0,0,0,water,{value}\n")
            for command in (["check"], ["run", "--out", "no"]):
                self.refused(command[0], scene, *command[1:], "--set", "start.region=", "--set", "start.file=rows.csv",
                             says=says)

    def test_hdf5_types(self):
        good = dict(id=np.array([1, 2], "u8"), x=np.array([[0.01, 0.006, 0.002], [0.02, 0.006, 0.002]]),
                    v=np.zeros((2, 3)), group=np.array([0, 0], "u4"), radius=np.array([5e-4, 5e-4]))

        def write(**changed):
            with h5py.File(self.run.folder / "start.h5", "w") as file:
                for name, values in {**good, **changed}.items():
                    file[name] = values

        def refused(says, ranks=(1,), **changed):
            write(**changed)
            self.refused("check", self.sand, "--set", "start.file=start.h5", says=says, ranks=ranks)

        refused("row 1: group is -1; it must be 0 to 0", (1, 3), group=np.array([0, -1], "i8"))
        refused("row 0: group is 4294967296", group=np.array([2**32, 0], "i8"))
        refused("row 0: group is 1;", group=np.array([1, 0], "u1"))
        for group in ([0.9, 0], [np.nan, 0], [0.0, 0.0]):
            refused("\"group\" holds 64-bit real numbers; it must hold integers", (1, 3), group=np.array(group))
        for ids in ([1.9, 2.5], [np.nan, 2], [1e300, 2], [np.inf, 2]):
            refused("\"id\" holds 64-bit real numbers; it must hold integers", id=np.array(ids))
        refused("row 0: id is -1; it must be 0 to 9223372036854775807", (1, 3), id=np.array([-1, 2], "i8"))
        refused("row 1: id is 9223372036854775808", id=np.array([1, 2**63], "u8"))
        refused("\"group\" holds no numbers", group=np.array([b"sand", b"sand"]))
        refused("\"x\" holds no numbers", x=good["x"].astype("c16"))
        refused("\"x\" holds no numbers", x=good["x"] > 0)
        refused("\"x\" has 2 x 3 x 4 values; it must have 2 x 3", x=np.zeros((2, 3, 4)))
        refused("\"x\" has 6 values; it must have 2 x 3", x=np.zeros(6))
        refused("\"x\" has one value", x=0.5)
        refused("\"id\" has one value", id=np.uint64(3))
        refused("row 0: radius is not finite", radius=np.array([np.nan, 5e-4]))
        prints = set()
        for k, types in enumerate([{}, dict(id=np.array([1, 2], "i2"), group=np.array([[0], [0]], "i8"),
                                            v=np.zeros((2, 3), "i4"))]):
            write(**types)
            result = self.run.run(1, "peperite", "run", self.sand, "--set", "start.file=start.h5", "--out", f"types{k}")
            prints.add(result.fingerprint)
        assert len(prints) == 1


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--programs", required=True)
    parser.add_argument("--source", required=True)
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    run = Runner(arguments.programs, arguments.mpirun)
    cases = Cases(run, Path(arguments.source).resolve())
    sys.exit(run_all(cases, arguments.names))


if __name__ == "__main__":
    main()
