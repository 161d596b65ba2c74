"""What `peperite check` says of size, time step and speeds, and that a run says the same."""
import re
import resource
import shutil
import time


class CheckCases:
    """Cases of input_cases.py."""

    FLUID = """
dimension = 3
[domain]
lower = [0, 0, 0]
upper = [1, 1, 1]
gravity = [0, 0, -9.81]
[kernel]
h_over_dx = 1.2
[[group]]
name = "water"
kind = "fluid"
density = 1000
sound_speed = 40
[[group]]
name = "wall"
kind = "wall"
[start]
spacing = 0.05
[[start.region]]
group = "wall"
[[start.region]]
group = "water"
shape = "box"
lower = [0.2, 0.2, 0.2]
upper = [0.8, 0.8, 0.8]
[[start.region]]
group = "none"
shape = "ball"
centre = [0.5, 0.5, 0.6]
radius = 0.1
[time]
until = 1
"""

    def check(self, *options, ranks=1):
        scene = self.file("fluid.toml", self.FLUID)
        more = [word for option in options for word in ("--set", option)]
        return self.run.run(ranks, "peperite", "check", scene, *more).out

    def test_size(self):
        """8.5e9 particles are counted in seconds and without memory; runs of what no machine holds are refused."""
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))
        scene = self.file("fluid.toml", self.FLUID)
        begin = time.monotonic()
        out = self.run.run(1, "peperite", "check", scene, "--set", "start.spacing=0.00049", preexec_fn=limit).out
        assert time.monotonic() - begin < 30
        assert "particles: 84" in out and "  water: 18" in out and "it would not run here" in out, out
        for ranks in (1, 3):
            self.run.refused(ranks, "peperite", "run", scene, "--set", "start.spacing=0.00049", "--out", "no",
                             says=" cells need ", **({"preexec_fn": limit} if ranks == 1 else {}))
        assert not (self.run.folder / "no").exists()

    def test_shipped(self):
        """Every scene of apps is in order; the largest bed starts, whose last column of grains a wall would cut."""
        scenes = sorted((self.source / "apps").glob("*/*.toml"))
        assert len(scenes) > 15
        for scene in scenes:
            self.run.run(1, "peperite", "check", scene)
        fine = self.source / "apps" / "sandbox" / "sandbox_fine.toml"
        self.run.run(2, "peperite", "run", fine, "--steps", 1, "--out", "fine")
        shutil.rmtree(self.run.folder / "fine")
        for command in (["check"], ["run", "--out", "no"]):
            self.run.refused(1, "peperite", command[0], fine, *command[1:], "--set", "start.upper=[0.35, 0.012825, 0.463125]",
                             says="lies 0.43 radii deep in wall \"front\"; contact.largest_overlap allows 0.4: keep start.lower")

    def test_meshes(self):
        """What meshes take, on each machine and on each rank; a mesh region with a hole is told once, by check and run."""
        out = self.run.run(2, "peperite", "check", self.source / "tests/scenes/grains_mesh.toml").out
        assert re.search(r"^meshes: \S+ kB on each machine, whatever its ranks$", out, re.M), out
        faces = [line for line in (self.source / "tests/scenes/ring.obj").read_text().splitlines(True)]
        told = 'start.region.0.file: "{}" is not closed: 4 of its edges have one triangle; what is inside is what most rays'
        for name, lines in (("whole.obj", faces), ("open.obj", faces[:-1])):
            mesh = self.file(name, "".join(lines))
            region = f'[[start.region]]\ngroup = "water"\nshape = "mesh"\nfile = "{mesh}"\nscale = 0.3\norigin = [0.5, 0.5, 0.5]\n'
            scene = self.file("mesh.toml", self.FLUID.replace('[[start.region]]\ngroup = "wall"\n', region))
            out = self.run.run(2, "peperite", "check", scene).out
            assert re.search(r"^mesh regions: \S+ kB on each rank$", out, re.M), out
            assert out.count(f"warning: {told.format(mesh)}") == (name == "open.obj") == out.count("not closed"), out
            err = self.run.run(2, "peperite", "run", scene, "--steps", 1, "--out", f"{name}_run").err
            assert err.count(f"peperite: warning: {told.format(mesh)}") == (name == "open.obj") == err.count("not closed"), err

    def test_steps(self):
        """What the message names is accepted with a warning, half of it without."""
        for dt in ("1e-3", "1.2e-3"):
            for value in ("terms.density_diffusion=1", "terms.artificial_viscosity=10",
                          "group.water.bulk_viscosity=1e9", "group.water.viscosity=1e9"):
                key, fluid = value.split("=")[0], self.file("fluid.toml", self.FLUID)
                end = ["--set", f"time.dt={dt}", "--set"]
                for command in (["check"], ["run", "--out", "no"]):
                    result = self.run.refused(1, "peperite", command[0], fluid, *command[1:], *end, value,
                                              says=f"{key}: ")
                assert "is unstable with time steps of" in result.complaints[0], result.err
                most = result.complaints[0].split("set it to ")[1].split(" ")[0]
                out = self.check(f"time.dt={dt}", f"{key}={most}")
                assert f"of what {key} = " in out, out
                out = self.check(f"time.dt={dt}", f"{key}={0.5 * float(most)}")
                assert f"of what {key} = " not in out, out
        assert "warning" not in self.check()

    STILL = """
dimension = 2
kernel = { h_over_dx = 1.2 }
domain = { lower = [0, 0], upper = [1, 1], periodic = [true, true] }
terms = { motion = false }
time = { until = 1e6 }
[[group]]
name = "rock"
kind = "fluid"
density = 1000
sound_speed = 100
temperature = 300
heat = { specific_heat = 1000, conductivity = 2 }
[start]
spacing = 0.05
region = [{ group = "rock" }]
"""

    def test_still(self):
        """Where nothing moves sound limits no step."""
        scene = self.file("still.toml", self.STILL)
        assert "time step: 450 s, nothing moves" in self.run.run(1, "peperite", "check", scene).out
        given = ["--set", "time.dt=1e5", "--set", "terms.implicit_conduction=true"]
        assert "time step: 100000 s, nothing moves" in self.run.run(1, "peperite", "check", scene, *given).out
        self.run.refused(1, "peperite", "check", scene, "--set", "time.dt=1e5",
                         says="time.dt: 100000 s is above the limit of explicit conduction")

    def test_insertions(self):
        """How many grains are to come: 10 g/s that end in a second, of 1.804e-4 kg in the mean."""
        out = self.run.run(1, "peperite", "check", self.source / "tests/every_key/silo.toml").out
        assert "insertion: sand every 0.01 s, 0.005 kg or about 27.72 grains in all" in out, out

    ROCK = """
dimension = 2
kernel = { h_over_dx = 1.2 }
domain = { lower = [0, 0], upper = [1, 1], periodic = [true, true], surface_pressure = 4.8e6 }
time = { until = 0.01 }
[[group]]
name = "rock"
kind = "fluid"
density = 1000
bulk_modulus = 1.6e6
eos = "birch_murnaghan"
bulk_modulus_derivative = 4
[start]
spacing = 0.05
region = [{ group = "rock" }]
"""

    def test_stiffened(self):
        """Rock under three times its bulk modulus: sound is 2.24 times as fast as at rest, for check, run and screen."""
        scene = self.file("rock.toml", self.ROCK)

        def said(command, *options):
            """dt and c dt/h."""
            more = ["--steps", 1, "--out", "rock", "--set", "output.snapshot_interval=0"] if command == "run" else []
            out = self.run.run(1, "peperite", command, scene, *more, *options).out
            shutil.rmtree(self.run.folder / "rock", ignore_errors=True)
            return re.search(r"(?:time step: |dt = )(\S+) s.*, c dt/h = (\S+)", out).groups()

        step, courant = said("check")
        assert (step, courant) == ("0.00053459", "0.8"), (step, courant)
        assert said("run") == ("0.0005346", "0.8")
        # Above the limit, and not above that of rho_0: refused at once, by a step that both accept.
        for dt in ("8.1e-4", "1.7e-3"):
            for command in (["check"], ["run", "--out", "no"]):
                result = self.run.refused(1, "peperite", command[0], scene, *command[1:], "--set", f"time.dt={dt}",
                                          says="time.dt: c dt/h = ")
        self.run.refused(3, "peperite", "run", scene, "--out", "no", "--set", "time.dt=1e-3", says="time.dt: c dt/h = 1.5 ")
        assert not (self.run.folder / "no").exists()
        named = re.search(r"set it to (\S+) s or less", result.complaints[0])[1]
        assert said("check", "--set", f"time.dt={named}")[1] == said("run", "--set", f"time.dt={named}")[1] == "1.19"
        # Diffusion goes with the sound of now too.
        for command in (["check"], ["run", "--out", "no"]):
            self.run.refused(1, "peperite", command[0], scene, *command[1:], "--set", "time.dt=7e-4", "--set",
                             "terms.density_diffusion=0.5", says="terms.density_diffusion: 0.5 is unstable")
        # Of more particles than check places: a hundredth of the spacing, under the same pressure and under their weight.
        fine = ("--set", "start.spacing=0.0005")
        assert said("check", *fine) == ("5.3459e-06", "0.8")
        deep = ["domain.periodic=[true, false]", "domain.gravity=[0, -4800]", "domain.surface_pressure=0",
                "start.pressure=hydrostatic", "start.surface_height=1"]
        deep = [word for option in deep for word in ("--set", option)]
        coarse, many = (float(said("check", *deep, *more)[0]) for more in ((), fine))
        assert abs(many / coarse - 0.01) < 1e-4 and coarse < 0.0006, (coarse, many)

    def test_stiffens(self):
        """Rock that its weight compresses while it runs: stopped where the step becomes too long, with the reason."""
        bowl = self.ROCK.replace("[{ group = \"rock\" }]", """[{ group = "bowl" },
    { group = "none", shape = "box", lower = [0.2, 0.2], upper = [0.8, 1] },
    { group = "rock", shape = "box", lower = [0.2, 0.2], upper = [0.8, 0.8] }]""")
        scene = self.file("bowl.toml", bowl + "[[group]]\nname = \"bowl\"\nkind = \"wall\"\n")
        options = ["domain.periodic=[false, false]", "domain.gravity=[0, -40]", "domain.surface_pressure=0",
                   "group.rock.bulk_modulus_derivative=12", "time.dt=1.75e-3", "time.until=1"]
        options = [word for option in options for word in ("--set", option)]
        result = self.run.run(1, "peperite", "run", scene, *options, "--out", "stiff", code=3)
        assert "is beyond the integrator's limit 1.2: pressure has made the matter stiffer" in result.err, result.err
        assert "set time.dt to 0.001" in result.err and "gas" not in result.err, result.err

    def test_speeds(self):
        assert "warning" not in self.check()
        out = self.check("group.water.sound_speed=3", ranks=3)
        assert "group.water: its sound speed of 3 m/s is below 10 times sqrt(g H) = 2.323 m/s, H = 0.55 m" in out, out
        assert "set it to 23.23 m/s or more" in out, out
        out = self.check("group.water.sound_speed=30", "start.velocity=[5, 0, 0]")
        assert "below 10 times the 5 m/s of start.velocity: set it to 50 m/s or more" in out, out
        assert "start.velocity: 100 m/s is Mach 2.5" in self.check("start.velocity=[0, 100, 0]")
        assert "group.wall.velocity: 1e+05 m/s is Mach 2500" in self.check("group.wall.velocity=[1e5, 0, 0]")
        self.file("fast.csv", "id,x,y,z,vx,vy,vz,group\n1,0.5,0.5,0.5,0,0,50,water\n2,0.6,0.5,0.5,0,0,0,water\n")
        out = self.check("start.region=", "start.file=fast.csv")
        assert "start.file: 50 m/s is Mach 1.25" in out, out

    def test_thin_tension(self):
        bubble = self.cases.parents[1] / "benchmarks" / "accuracy" / "rising_bubble.toml"
        thin = ["--set", "group.liquid.viscosity=0.1", "--set", "group.bubble.viscosity=0.1"]
        warning = "tension as a stress moves the interface"
        assert warning not in self.run.run(1, "peperite", "check", bubble).out
        assert warning in self.run.run(1, "peperite", "check", bubble, *thin).out
        jump = ["--set", "terms.surface_tension.form=jump"]
        assert warning not in self.run.run(1, "peperite", "check", bubble, *thin, *jump).out
