#!/usr/bin/python3
"""What a script does to a peperite.Simulation: forces against exact motions and against gravity, grains that come and go, with the same
bits on 1, 2 and 3 ranks.

    test_caller.py --programs build/bin --module build/python --source .
"""
import gc
import json
import textwrap
import weakref

import numpy as np

from python_case import PythonCase
from runner import main

# An outlet makes the box open; grains of 2 mm over a floor, periodic in y.
BOX = {
    "domain": {"lower": [0, 0, 0], "upper": [0.04, 0.02, 0.06], "periodic": [False, True, False], "leaves": "delete"},
    "contact": {"law": "linear"}, "time": {"steps": 9},
    "group": [{"name": "sand", "kind": "grain", "density": 2500, "diameter": [0.0015, 0.002], "normal_stiffness": 500, "restitution": 0.5,
               "friction": 0.5},
              {"name": "glue", "kind": "grain", "density": 2500, "diameter": 0.002, "normal_stiffness": 500, "restitution": 0.5,
               "fixed": True}],
    "wall": [{"name": "floor", "material": "sand", "point": [0, 0, 0], "normal": [0, 0, 1]}],
    "start": {"spacing": 0.002, "lower": [0, 0, 0], "upper": [0.04, 0.02, 0.006], "region": [{"group": "sand"}]},
    "monitor": [{"kind": "budget"}],
}
FLUID = {
    "dimension": 2, "kernel": {"h_over_dx": 1.2}, "time": {"cfl": 0.7, "steps": 9},
    "domain": {"lower": [-0.5, -0.5], "upper": [1.5, 2]},
    "group": [{"name": "water", "kind": "fluid", "density": 1000, "sound_speed": 40, "viscosity": 10}, {"name": "tank", "kind": "wall"}],
    "start": {"spacing": 0.05, "lower": [-0.2, -0.2], "upper": [1.2, 1.2],
              "region": [{"group": "tank"}, {"group": "none", "shape": "box", "lower": [0, 0], "upper": [1, 1.2]},
                         {"group": "water", "shape": "box", "lower": [0, 0], "upper": [1, 0.6]}]},
}
SCENES = ("tests/scenes/open2d.toml", "tests/scenes/box3d_gas.toml", "tests/scenes/bodies3d.toml", "tests/scenes/rigid2d.toml",
          "tests/scenes/wet2d.toml", "tests/scenes/grains_silo.toml", "tests/every_key/mixture.toml")
# Of each particle's state and time alone, and of operations that have the same bits wherever in an array.
FORCES = """
import json, sys
import numpy as np
import peperite

def pushed(m):
    return 5 * (1 + m.time) / (1 + m.position**2) - 0.3 * m.velocity + (m.id[:, None] % 5 - 2.0)

for scene in sys.argv[1:]:
    ends = []
    for force in (None, pushed):
        s = peperite.Simulation(scene, set={"output.snapshot_interval": 0, "output.series_interval": 0}, force=force)
        s.step(20)
        ends.append(s.fingerprint())
    if s.rank == 0:
        print(json.dumps([scene, ends]), flush=True)
"""
EXCHANGES = """
import json, sys
import numpy as np
import peperite
s = peperite.Simulation(json.loads(sys.argv[1]))
seen = []
for k in range(12):
    s.step(40)
    x = [[0.005 * (1 + i), 0.01, 0.012 + 0.003 * k] for i in range(6)] if s.rank == 0 else None
    s.add("sand", x, radius=np.linspace(0.00075, 0.001, 6), velocity=(0, 0, -1))
    if k % 3 == 2:
        s.remove(s.field("position")[:, 0] > 0.02)
        ids = s.gather("id")
        s.remove(ids[:2] if s.rank == 0 else [])
s.step(40)
ids = s.gather("id")
last = [s.fingerprint(), s.monitors()]
if s.rank == 0:
    print(json.dumps([*last, ids.tolist()]))
"""


class Caller(PythonCase):
    def test_forces_have_the_same_bits_on_any_ranks(self):
        (self.folder / "forces.py").write_text(FORCES)
        scenes = [self.source / scene for scene in SCENES]
        ends = [self.python(ranks, "forces.py", *scenes).out for ranks in (1, 2, 3)]
        self.assertEqual(ends[0], ends[1])
        self.assertEqual(ends[0], ends[2])
        lines = [json.loads(line) for line in ends[0].splitlines()]
        self.assertEqual(len(lines), len(SCENES))
        for scene, (without, with_force) in lines:
            self.assertNotEqual(without, with_force, f"{scene}: the force does nothing")

    def test_a_grain_in_a_trap_oscillates(self):
        import peperite
        w, dt, centre, a = 40.0, 1e-4, np.array([0.02, 0.01, 0.03]), 0.005
        seen = []

        def trap(m):
            seen.append(m.time)
            return -w**2 * (m.position - centre)
        s = peperite.Simulation({**BOX, "start": {**BOX["start"], "lower": [0.02 + a - 0.001, 0.009, 0.029], "upper": [0.02 + a + 0.001, 0.011, 0.031]}},
                                set={"time.dt": dt, "group.sand.diameter": 0.002}, force=trap)
        turn = 2 * np.arcsin(w * dt / 2)  # of a leapfrog, whose velocity at the start is that of half a step before
        for n in range(1, 2001):
            s.step()
            x = s.field("position")[0] - centre
            self.assertLess(abs(x[0] - a * np.cos((n + 0.5) * turn) / np.cos(turn / 2)), 1e-9 * a)
            self.assertLess(abs(x[0] - a * np.cos(w * n * dt)), 0.6 * w * dt * a)
        self.assertLess(np.abs(x[1:]).max(), 1e-12)
        np.testing.assert_allclose(seen, dt * np.arange(2000), rtol=1e-12, atol=0)

    def test_a_force_of_gravity_is_gravity(self):
        import peperite
        g = np.array([1.0, 0, -9.81])

        def ends(scene, gravity, steps):
            pulled = peperite.Simulation(scene, set={"domain.gravity": list(gravity)})
            pushed = peperite.Simulation(scene, force=lambda m: np.tile(gravity, (len(m), 1)))
            for s in (pulled, pushed):
                s.step(steps)
            return pulled, pushed
        pulled, pushed = ends(BOX, g, 400)
        self.assertEqual(pulled.fingerprint(), pushed.fingerprint())
        # Walls take the fluid's reference density: 0.1 % of the pressure.
        pulled, pushed = ends({**FLUID, "terms": {"density_diffusion": 0}}, np.array([0, -9.81]), 3000)
        p, q = pulled.gather("pressure"), pushed.gather("pressure")
        y = pushed.gather("position")[:, 1]
        wet = pushed.gather("group") == 0
        self.assertLess(np.abs(p - q)[wet].max(), 6)
        self.assertLess(np.abs(q - 9810 * (0.6 - y))[wet].max(), 200)

    def test_a_rigid_body_turns_and_goes_as_its_parts_are_pushed(self):
        import peperite
        scene = {
            "dimension": 2, "kernel": {"h_over_dx": 1.2}, "time": {"dt": 1e-3, "steps": 9},
            "domain": {"lower": [0, 0], "upper": [4, 4]},
            "group": [{"name": "plate", "kind": "solid", "rigid": True, "density": 2000, "bulk_modulus": 1e7}],
            "start": {"spacing": 0.1, "region": [{"group": "none"}, {"group": "plate", "shape": "box", "lower": [1.5, 1.7], "upper": [2.5, 2.3]}]},
            "monitor": [{"kind": "body", "name": "plate", "group": "plate"}],
        }
        spin, pull = 3.0, np.array([0.5, -0.25])

        def turned(m):
            x = m.position - place
            return pull + spin * np.stack((-x[:, 1], x[:, 0]), axis=1)
        s = peperite.Simulation(scene)
        place = np.array([s.monitors()[f"plate_{a}"] for a in "xy"])
        s.force = turned
        s.step()
        now = s.monitors()
        self.assertAlmostEqual(now["plate_w"], spin * 1e-3, delta=1e-12)
        self.assertAlmostEqual(now["plate_vx"], pull[0] * 1e-3, delta=1e-12)
        self.assertAlmostEqual(now["plate_vy"], pull[1] * 1e-3, delta=1e-12)
        s.force = None
        s.step(9)
        self.assertEqual([s.monitors()[f"plate_{q}"] for q in ("w", "vx")], [now["plate_w"], now["plate_vx"]])

    def test_time_steps_heed_a_force(self):
        import peperite
        seen = []

        def strongly(m):
            seen.append(m.time)
            return np.full((len(m), 2), 1e5)
        quiet, strong = peperite.Simulation(FLUID), peperite.Simulation(FLUID, force=strongly)
        for s in (quiet, strong):
            s.step()
        self.assertLess(strong.dt, 0.8 * quiet.dt)
        self.assertEqual(seen, [strong.time])  # fluids drift first

    def test_saving_changes_no_bit(self):
        import peperite

        def swing(m):
            return -100 * (m.position - 0.02) * m.time
        a, b = (peperite.Simulation(BOX, force=swing) for _ in range(2))
        a.step(60)
        b.step(30)
        b.save(self.folder / "half_way.h5")
        b.step(30)
        self.assertEqual(a.fingerprint(), b.fingerprint())

    def test_what_is_wrong_with_a_force_is_one_line(self):
        import peperite
        s = peperite.Simulation(BOX)
        for force in (lambda m: None, lambda m: np.zeros((len(m), 2)), lambda m: np.zeros((len(m), 3), dtype=complex), lambda m: m.warmth):
            s = peperite.Simulation(BOX, force=force)
            with self.assertRaises((peperite.InputError, AttributeError)) as caught:
                s.step()
            self.assertEqual(len(str(caught.exception).splitlines()), 1)
            with self.assertRaises(peperite.GuardError) as caught:
                s.step()
            self.assertIn("in the middle of a step", str(caught.exception))
        with self.assertRaises(peperite.InputError):
            peperite.Simulation(BOX, force=9.81)
        for melt in ("tests/scenes/chamber.toml", "tests/scenes/melts2d.toml"):
            with self.assertRaises(peperite.InputError) as caught:
                peperite.Simulation(self.source / melt, force=lambda m: np.zeros((len(m), 3)))
            self.assertIn("slow flow", str(caught.exception))

    def test_sums_that_rows_leave_behind_are_no_fields(self):
        import peperite
        s = peperite.Simulation(FLUID)
        for name in ("divergence", "diffusion", "wall_sums"):
            self.assertNotIn(name, s.fields)
            with self.assertRaises(peperite.InputError):
                s.field(name)

    def test_a_failure_on_one_rank_is_one_on_all(self):
        (self.folder / "failing.py").write_text(textwrap.dedent("""
            import json, sys
            import numpy as np
            import peperite
            from mpi4py import MPI

            def raising(m):
                if MPI.COMM_WORLD.rank == 1:
                    raise KeyError("mine")
                return np.zeros((len(m), 3))

            def wrong(m):
                a = np.zeros((len(m), 3))
                a[m.id % 2 == 1, 1] = np.nan
                return a
            for force in (raising, wrong):
                s = peperite.Simulation(json.loads(sys.argv[1]), force=force)
                ids = s.gather("id")
                if s.rank == 0:
                    print(ids[ids % 2 == 1].min(), flush=True)
                for work in (s.step, s.fingerprint):
                    try:
                        work()
                    except Exception as error:
                        text = s.comm.gather(f"{type(error).__name__}: {error}")
                        if s.rank == 0:
                            print("; ".join(text), flush=True)
            """))
        lines = self.python(2, "failing.py", json.dumps(BOX), timeout=60).out.splitlines()
        middle = "GuardError: this simulation ended in the middle of a step; begin another"
        nan = f"InputError: force: the acceleration of particle {lines.pop(0)} is not finite: [ 0. nan 0.]"
        self.assertEqual(lines[0], "InputError: force: KeyError on rank 1: 'mine'; KeyError: 'mine'")
        self.assertEqual(lines[1], f"{middle}; {middle}")
        self.assertEqual(lines[3], f"{nan}; {nan}")

    def test_a_force_keeps_no_simulation_alive(self):
        import peperite
        s = peperite.Simulation(BOX, force=lambda m: np.zeros((len(m), 3)))
        s.step()
        seen = weakref.ref(s)
        del s
        gc.collect()
        self.assertIsNone(seen())

    def test_grains_come_and_go_with_the_same_bits_on_any_ranks(self):
        import peperite
        (self.folder / "exchanges.py").write_text(EXCHANGES)
        scene = json.dumps({**BOX, "domain": {**BOX["domain"], "gravity": [0.5, 0, -9.81]}})
        ends = [self.python(ranks, "exchanges.py", scene).out for ranks in (1, 2, 3)]
        self.assertEqual(ends[0], ends[1])
        self.assertEqual(ends[0], ends[2])
        _, monitors, ids = json.loads(ends[0])
        self.assertEqual(monitors["budget_n_in"], 72)
        self.assertEqual(len(ids), 600 + 72 - monitors["budget_n_out"])
        self.assertGreater(monitors["budget_n_out"], 100)
        largest = int(max(peperite.Simulation(BOX).gather("id")))
        self.assertEqual(max(ids), largest + 70)  # the last two were put where the mask takes them out

    def test_grains_that_do_not_fit_are_refused(self):
        import peperite
        s = peperite.Simulation(BOX)
        s.step()
        before = s.fingerprint()
        place, r = [0.02, 0.01, 0.04], 0.001
        for says, work in (
                ("outside the domain", lambda: s.add("sand", [0.02, 0.01, 0.07], radius=r)),
                ("outside the domain", lambda: s.add("sand", [0.02, 0.01, np.nan], radius=r)),
                ("0.00075 to 0.001 m", lambda: s.add("sand", place, radius=0.0011)),
                ("0.00075 to 0.001 m", lambda: s.add("sand", place, radius=np.nan)),
                ("no group of grains that move", lambda: s.add("glue", place, radius=r)),
                ("no group \"gravel\"", lambda: s.add("gravel", place, radius=r)),
                ("grain 2 of 2: at (0.0205, 0.01, 0.04) m it lies deeper", lambda: s.add("sand", [place, [0.0205, 0.01, 0.04]], radius=r)),
                ("grain 1 of 1: at (0.02, 0.01, 0.0055) m it lies deeper", lambda: s.add("sand", [0.02, 0.01, 0.0055], radius=r)),
                ("could pass others unseen", lambda: s.add("sand", place, radius=r, velocity=[1e4, 0, 0])),
                ("not [grain][3]", lambda: s.add("sand", [0.02, 0.01], radius=r)),
                ("add: ", lambda: s.add("sand", [place, place], radius=[r, r, r])),
                ("grain 9999 is not there", lambda: s.remove([9999])),
                ("neither a mask", lambda: s.remove([True, False])),
                ("neither a mask", lambda: s.remove([0.5]))):
            with self.assertRaises(peperite.InputError) as caught:
                work()
            self.assertIn(says, str(caught.exception))
            self.assertEqual(s.fingerprint(), before)
        closed = peperite.Simulation({**BOX, "domain": {**BOX["domain"], "leaves": "stop"}, "monitor": []})
        for scene in (closed, peperite.Simulation(FLUID)):
            with self.assertRaises(peperite.InputError) as caught:
                scene.remove([0])
            self.assertIn("domain.leaves", str(caught.exception))
        s.add("sand", place, radius=r)
        s.step(100)

    def test_a_grain_that_comes_falls_and_leaves_no_contact_behind(self):
        import peperite
        s = peperite.Simulation({**BOX, "start": {**BOX["start"], "upper": [0.002, 0.002, 0.002]}})
        s.add("sand", [0.02, 0.01, 0.00085], radius=0.001)  # 0.15 mm in the floor
        s.step()
        first = s.gather("id")[0]
        up = s.gather("velocity")[1, 2]
        self.assertAlmostEqual(up, 500 * 1.5e-4 / (2500 * 4 / 3 * np.pi * 1e-9) * s.dt, delta=0.02 * up)
        s.remove(s.field("id") == first + 1)
        s.add("sand", [0.02, 0.01, 0.03], radius=0.001, velocity=[0, 0, -0.5])
        s.step(10)
        self.assertEqual(s.gather("id").tolist(), [first, first + 2])
        self.assertTrue(np.array_equal(s.gather("velocity")[1], [0, 0, -0.5]))
        budget = s.monitors()
        self.assertEqual((budget["budget_n_in"], budget["budget_n_out"]), (2, 1))
        mass = 2500 * 4 / 3 * np.pi * 1e-9
        self.assertAlmostEqual(budget["budget_mass_in"] - budget["budget_mass_out"], mass, delta=1e-9 * mass)


if __name__ == "__main__":
    main("module")
