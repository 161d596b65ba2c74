"""Random scenes of fluids, solids and gases: legal, small, and made to move."""

import math

import boxes
from exchange import Exchanges
from mixture import Mixture
from openings import Openings
from sph_bodies import TotalBodies
from sph_rows import FromFile
from sph_terms import Terms

RADIUS = {"quintic": 3, "wendland_c2": 2, "wendland_c4": 2}


def make(d):
    family = d.weighted("family", {"fluid": 45, "solid": 12, "ida": 12, "gas": 15, "total": 32, "mixture": 16})
    return Maker(d, family).scene()


class Maker(Terms, TotalBodies, FromFile, Mixture, Exchanges, Openings):
    def __init__(self, d, family):
        self.d, self.mixed = d, family == "mixture"
        self.family = "fluid" if self.mixed else family
        family = self.family
        self.dim = 2 if not self.mixed and d.chance("2D", 0.65) else 3
        self.dx = d.one("dx", [1.0, 1.0, 1.0, 0.01, 0.37, 250.0])
        self.c = d.one("c", [1.0, 10.0, 100.0, 1480.0])
        self.rho = d.one("rho", [1.0, 1000.0, 2500.0])
        self.kernel = "quintic"
        if family == "fluid":
            self.kernel = d.weighted("kernel", {"quintic": 70, "wendland_c2": 15, "wendland_c4": 15})
        ratio = d.one("h/dx", [0.8333333333333334, 1.0, 1.0, 1.2, 1.2, 1.5, 2.0, d.real("h", 0.7, 2.2)])
        self.ratio = min(ratio, 1.3) if self.dim == 3 and not d.chance("wide", 0.1) else ratio
        self.h = self.ratio * self.dx
        radius = RADIUS[self.kernel] * self.ratio
        self.stretch = d.one("stretch", [1.0, 1.2, 1.2, 1.5, 2.0]) if family == "total" else 1.0
        self.growth = d.one("growth", [1.0, 1.5, 3.0] if self.dim == 2 else [1.0, 1.0, 1.5]) if family == "gas" else 1.0
        pulled = family == "fluid" and self.kernel == "quintic" and d.chance("pulled", 0.08)
        self.pulled = pulled
        most = 3000 if d.chance("many", 0.02) else 400 if self.dim == 2 else 700
        nearly_lost = 0.95 if family == "total" else 1.0  # of lists where bodies fail
        self.box = boxes.Box(d.part("box"), self.dim, radius, radius * self.stretch * self.growth / nearly_lost,
                             ["open"] if pulled else list(boxes.ENDS[2]), most, 4 if family == "total" else 1)

    def scene(self):
        d = self.d
        scene = {"title": f"Random {'mixture' if self.mixed else self.family}", "dimension": self.dim}
        if self.family == "ida":
            scene["formulation"] = "ida"
        scene["precision"] = d.one("precision", ["double", "mixed"])
        scene["kernel"] = {"shape": self.kernel}
        if d.chance("h itself", 0.3):
            scene["kernel"]["smoothing_length"] = self.h
        else:
            scene["kernel"]["h_over_dx"] = self.ratio
        if self.family == "gas":
            if self.growth != (1.0 if self.box.walled() else 3.0) or d.chance("say growth", 0.5):
                scene["kernel"]["largest_growth"] = self.growth
            if d.chance("shrinks", 0.4):
                scene["kernel"]["least_growth"] = d.one("least growth", [0.05, 0.3, 1.0])
        self.offset = [0.0 if d.chance(f"at 0/{a}", 0.6) else self.dx * d.real(f"offset/{a}", -100, 100)
                       for a in range(self.dim)]
        scene["domain"] = self.domain()
        scene["group"] = self.groups()
        if any(g.get("eos") == "bubbly" for g in scene["group"]) and not self.surface:
            scene["domain"]["surface_pressure"] = self.vapour  # without it the gas has no end
        scene["start"] = self.start(scene)
        if terms := self.terms(scene):
            scene["terms"] = terms
        scene["time"] = self.time()
        if self.mixed:
            self.add_grains(scene)
        elif self.family in ("fluid", "solid"):
            self.exchanges(scene)
        elif self.wet:
            fluids = [g for g in scene["group"] if g["kind"] == "fluid"]
            if self.resets(self.d.part("exchanges"), scene, fluids, False) and d.chance("budget", 0.3):
                scene["monitor"] = [{"kind": "budget"}]
        self.openings(scene)
        case = {"scene": scene, "skin": self.box.skin}
        if self.box.centred:
            case |= {"reach": self.box.reach, "radius": self.box.radius}
        if not self.mixed and not scene["start"].get("tangled") and "inlet" not in scene and d.chance("file", 0.3):
            self.from_file(case)
        return case

    def metres(self, lengths):
        return [self.dx * x + o for x, o in zip(lengths, self.offset)]

    def domain(self):
        d, box = self.d, self.box
        out = {"lower": self.metres(box.lower), "upper": self.metres(box.upper)}
        if "periodic" in box.ends or d.chance("say periods", 0.3):
            out["periodic"] = [end == "periodic" for end in box.ends]
        height = self.dx * max(box.n)
        strength = self.c**2 / height * d.one("gravity", [0.0, 0.003, 0.01, 0.05])
        self.gravity = [0.0] * self.dim
        if strength > 0:
            axis = d.whole("down", 0, self.dim - 1)
            self.gravity[axis] = -strength
            if d.chance("tilted", 0.2):
                self.gravity = d.vector("gravity", strength, self.dim)
            out["gravity"] = self.gravity
        if self.pulled:
            out["central_pull"] = (self.c * d.real("pull", 0.02, 0.3) / height) ** 2
            if d.chance("centre", 0.7):
                out["pull_centre"] = [0.5 * (a + b) for a, b in zip(out["lower"], out["upper"])]
        self.surface = 0.0
        if self.family in ("fluid", "solid", "ida") and d.chance("surface pressure", 0.3):
            self.surface = self.rho * self.c**2 * d.log("surface pressure value", 1e-4, 0.05)
            out["surface_pressure"] = self.surface
        return out

    def viscosity(self, d):
        """From none to more than the step likes."""
        nu = d.one("viscosity", [0.0, 0.001, 0.01, 0.05, 0.2, 1.0])
        return nu * self.c * self.h * self.rho

    def stiffness(self, d, rho):
        if d.chance("by modulus", 0.5):
            return {"bulk_modulus": rho * self.c**2}
        return {"sound_speed": self.c}

    def groups(self):
        d = self.d
        out = {"fluid": self.fluids, "solid": self.with_solids, "ida": self.with_solids, "gas": self.gases,
               "total": self.bodies}[self.family]()
        self.movers = [g["name"] for g in out]
        if self.box.walled():
            out.append(self.wall(out))
        self.clamp = None
        if self.family == "total" and d.chance("clamp", 0.5):
            bodies = [g["name"] for g in out if "lagrangian" in g and not g.get("rigid")]
            if bodies:
                self.clamp = {"name": "clamp", "kind": "wall", "clamps": d.one("clamped", bodies)}
                out.append(self.clamp)
        return out

    def fluids(self):
        d, out = self.d, []
        alike = d.chance("alike", 0.4)
        for k in range(d.weighted("fluids", {1: 4, 2: 4, 3: 1})):
            g = d.part("fluid", 0 if alike else k)
            rho = self.rho * g.one("density", [1.0, 1.0, 0.5, 0.1, 1.7])
            group = {"name": ["melt", "magma", "oil"][k], "kind": "fluid", "density": rho}
            if d.part("fluid", k).chance("bubbly", 0.25):
                out += self.bubbly(d.part("bubbly", k), group, rho)
                continue
            if g.chance("stiffening", 0.15):
                group |= {"eos": "birch_murnaghan", "bulk_modulus_derivative": g.one("K'", [4, 3.5, 7])}
            elif g.chance("say eos", 0.2):
                group["eos"] = "linear"
            group |= self.stiffness(g, rho)
            self.viscosities(g, group)
            out.append(group)
        return out

    def viscosities(self, d, group):
        if nu := self.viscosity(d):
            group["viscosity"] = nu
        if d.chance("bulk", 0.2):
            group["bulk_viscosity"] = self.rho * self.c * self.h * d.log("bulk value", 1e-3, 0.1)

    def bubbly(self, d, group, rho):
        pressure = self.vapour = self.surface or self.rho * self.c**2 * 0.01
        m, exponent = d.log("gas", 1e-4, 0.02), d.one("exponent", [1, 1, 0.5, 0.7, 2])
        group |= {"eos": "bubbly", "gas_content": m, "gas_rt": self.c**2 * d.log("rt", 0.1, 10),
                  "solubility_pressure": pressure * d.log("saturation", 0.3, 3) / m ** (1 / exponent)}
        group |= self.stiffness(d, rho)
        if exponent != 1:
            group["solubility_exponent"] = exponent
        self.viscosities(d, group)
        if d.chance("lags", 0.3):
            group["exsolution_time"] = d.log("tau", 1e-3, 100) * self.h / self.c
            if not self.mixed and self.family != "ida" and d.chance("spreads", 0.5):  # up to a limit like that of sound
                group["water_diffusivity"] = d.log("D", 1e-5, 0.1) * self.h * self.c
        if not d.chance("fragments", 0.5):
            return [group]
        spray = dict(group, name=group["name"] + "_spray")
        self.viscosities(d.part("spray"), spray)
        change = {"void_fraction_above": d.log("psi", 0.01, 0.7), "group": spray["name"]}
        if d.chance("heals", 0.2):
            spray["becomes"] = [{"void_fraction_below": d.real("healed", 0.3, 1) * change["void_fraction_above"],
                                 "group": group["name"]}]
        for row in [change, *spray.get("becomes", [])]:
            if d.chance("hold", 0.2):
                row["hold"] = d.log("hold is", 0.1, 5) * self.h / self.c
        group["becomes"] = [change]
        return [group, spray]

    def solid(self, d, name):
        rho = self.rho * d.one("density", [1.0, 0.8, 1.5])
        group = {"name": name, "kind": "solid", "density": rho} | self.stiffness(d, rho)
        poisson = d.one("poisson", [0.25, 0.3, 0.0, -0.3, 0.45])
        if d.chance("mu itself", 0.3):
            group["shear_modulus"] = rho * self.c**2 * d.log("mu", 0.05, 1)
        else:
            group["poisson_ratio"] = poisson
        return group

    def strength(self, d, group):
        """Some yield at once, some never; brittle ones have as much fracture energy as the spacing asks for, or more."""
        mu = group.get("shear_modulus") or (3 * (1 - 2 * group["poisson_ratio"]) / (2 * (1 + group["poisson_ratio"]))
                                            * group["density"] * self.c**2)
        c, phi = mu * d.log("cohesion", 1e-5, 0.1), d.one("phi", [0, 0, 20, 30.5, 45])
        out = {"law": d.one("law", ["mohr_coulomb", "drucker_prager"]), "cohesion": c, "friction_angle": phi,
               "dilatancy_angle": phi * d.one("psi", [0, 0.2, 1])}
        if d.chance("tension", 0.6):
            out["tensile_strength"] = c * d.one("cut", [0, 0.1, 0.9])
        if d.chance("softens", 0.4):
            out["fracture_energy"] = c * c * self.dx / mu * d.log("energy", 0.6, 100)
            out["residual_cohesion"] = c * d.one("residual", [0, 0.3])
        return out

    def with_solids(self):
        """Updated solids beside fluids, or alone; Ida's equations without them too."""
        d = self.d
        out = self.fluids() if d.chance("fluids", 0.75) else []
        if out and self.family == "ida" and d.chance("no solid", 0.4):
            return out
        for k in range(d.weighted("solids", {1: 3, 2: 1})):
            group = self.solid(d.part("solid", k), ["block", "rock"][k])
            self.viscosities(d.part("solid", k), group)
            if self.family == "solid" and d.chance(f"yields/{k}", 0.6):
                group["strength"] = self.strength(d.part("strength", k), group)
            if d.chance(f"say updated/{k}", 0.3):
                group["lagrangian"] = "updated"
            out.append(group)
        return out

    def gases(self):
        d, out = self.d, []
        for k in range(d.weighted("gases", {1: 2, 2: 3})):
            g = d.part("gas", k)
            gamma, rho = g.one("gamma", [1.4, 1.4, 5 / 3, 1.1, 2.0]), self.rho * g.one("density", [1.0, 0.125, 4.0])
            out.append({"name": ["air", "hot"][k], "kind": "fluid", "eos": "ideal_gas", "heat_ratio": gamma,
                        "density": rho, "start_pressure": rho * self.c**2 / gamma * g.one("p", [1.0, 0.1, 30.0])})
            if nu := self.viscosity(g):
                out[-1]["viscosity"] = min(nu, 0.05 * self.c * self.h * rho)
        return out

    def wall(self, groups):
        d = self.d
        out = {"name": "wall", "kind": "wall"}
        if groups[0]["kind"] == "solid" or d.chance("wall itself", 0.2):
            out |= {"density": self.rho} | self.stiffness(d.part("wall"), self.rho)
        if self.family not in ("ida", "total") and d.chance("slip", 0.25):
            out["slip"] = True
        elif d.chance("sliding", 0.25):
            out["velocity"] = d.vector("sliding", 0.1 * self.c, self.dim)
        return out

    def start(self, scene):
        d, box = self.d, self.box
        lower, upper = box.outer()
        out = {"spacing": self.dx}
        periodic = "periodic" in box.ends
        if self.dim == 2 and not periodic and d.chance("hexagonal", 0.25):
            out["lattice"] = "hexagonal"
        elif self.dim == 3 and not periodic and d.chance("fcc", 0.15):
            out["lattice"] = "fcc"
        elif d.chance("say square", 0.1):
            out["lattice"] = "square"
        out |= {"lower": self.metres(lower), "upper": self.metres(upper)}
        if d.chance("origin", 0.2):
            out["origin"] = self.metres([x + d.one(f"origin/{a}", [0.0, 0.25, 0.5]) * (box.ends[a] != "periodic")
                                         for a, x in enumerate(lower)])
        if jitter := d.one("jitter", [0.0, 0.0, 0.05, 0.2, 0.49] + 5 * self.box.centred * [1e-6]):
            out |= {"jitter": jitter, "seed": d.whole("seed", 0, 2**31)}
        out["region"] = [scaled_region for scaled_region in self.paint()]
        self.speed(out)
        self.pressure(scene, out)
        return out

    def paint(self):
        """Walls everywhere, the first mover within, others over it."""
        d, box, out = self.d, self.box, []
        if box.walled():
            out.append({"group": "wall"})
            far = 1e4
            lower = [0.0 if low else -far for low, _ in box.layers]
            upper = [n if high else far for n, (_, high) in zip(box.n, box.layers)]
            out.append({"group": self.movers[0], "shape": "box", "lower": lower, "upper": [float(x) for x in upper]})
        else:
            out.append({"group": self.movers[0]})
            if d.chance("say everywhere", 0.2):
                out[0]["shape"] = "everywhere"
        if len(self.movers) > 1 and d.chance("halves", 0.5):
            axis = d.whole("half", 0, self.dim - 1)
            lower, upper = box.fluid()
            lower[axis] = round(0.5 * box.n[axis])
            if lower[axis] < upper[axis]:
                out.append({"group": self.movers[1], "shape": "box", "lower": lower, "upper": upper})
        if self.family == "total" and d.chance("gap", 0.7):
            axis = d.whole("gap axis", 0, self.dim - 1)
            lower, upper = box.fluid()
            lower[axis] = round(d.real("gap at", 0.2, 0.7) * box.n[axis])
            upper[axis] = lower[axis] + d.one("gap width", [1.0, 2.0])
            out.append({"group": "none", "shape": "box", "lower": lower, "upper": upper})
        if self.clamp:
            lower, upper = box.fluid()
            upper[0] = max(2.0, round(0.15 * box.n[0]))
            out.append({"group": "clamp", "shape": "box", "lower": lower, "upper": upper})
        out += box.regions(d, self.movers, 2.0 if self.family == "total" else 0.6)
        return [boxes.scaled(r, self.dx, self.offset) for r in out]

    def mach(self, d):
        return d.weighted("mach", {0.01: 2, 0.1: 3, 0.3: 3, 0.6: 2, 1.5: 1.5, 5.0: 0.7, 9.0: 0.5})

    def speed(self, out):
        d, box = self.d, self.box
        across = box.ends[0] == box.ends[1] == "periodic"
        if across and box.n[0] == box.n[1] and d.chance("taylor_green", 0.6):
            out |= {"velocity": "taylor_green", "flow_speed": self.c * self.mach(d),
                    "flow_length": self.dx * (box.upper[0] - box.lower[0])}
            if abs(box.upper[1] - box.upper[0]) > 1e-9:
                out |= {"velocity": "rest"}
        elif d.chance("moves", 0.8):
            out["velocity"] = d.vector("velocity", self.c * self.mach(d), self.dim)
        elif d.chance("say rest", 0.3):
            out["velocity"] = "rest"

    def pressure(self, scene, out):
        d = self.d
        down = [a for a in range(self.dim) if self.gravity[a]]
        periodic = any(self.box.ends[a] == "periodic" for a in down)
        fluids = self.family in ("fluid", "solid", "ida") or self.wet
        if fluids and down and not periodic and d.chance("hydrostatic", 0.7):
            out["pressure"] = "hydrostatic"
            g = math.sqrt(sum(x * x for x in self.gravity))
            top = max(-sum(self.gravity[a] * x[a] for a in range(self.dim)) / g
                      for x in (out["lower"], out["upper"]))
            if d.chance("layers", 0.4):
                movers = ["melt"] if self.wet else self.movers[: d.whole("number of layers", 1, 3)]
                out["layer"] = [{"group": m, "top": top - k * 2 * self.dx} for k, m in enumerate(movers)]
                if d.chance("plug", 0.2):
                    out["layer"][0]["pressure"] = self.rho * self.c**2 * d.log("plug held", 1e-4, 0.02)
            else:
                out["surface_height"] = top
        elif out.get("velocity") == "taylor_green" and self.family != "total" and d.chance("its pressure", 0.5):
            out["pressure"] = "taylor_green"
            if self.family == "gas":
                out["flow_speed"] = min(out["flow_speed"], 0.2 * self.c)
        elif fluids and d.chance("confined", 0.25):
            out |= {"pressure": "uniform", "uniform_pressure": self.rho * self.c**2 * d.one("confines", [0.0, 1e-3, 0.03])}
        elif d.chance("say zero", 0.1):
            out["pressure"] = "zero"

    def time(self):
        d, out = self.d, {}
        if d.chance("fixed step", 0.25):
            slow = 30.0 if self.family in ("gas",) else 2.5
            out["dt"] = d.one("dt", [0.1, 0.3, 0.5]) * self.h / (self.c * slow)
        elif d.chance("cfl", 0.7):
            out["cfl"] = d.one("cfl value", [0.8, 0.7, 0.5, 0.3, 0.1])
        out["steps"] = d.whole("steps", 3, 30)
        if d.chance("until", 0.1):
            out["until"] = 1e9 * self.h / self.c
        return out
