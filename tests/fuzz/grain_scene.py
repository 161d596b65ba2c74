"""Random scenes of grains: both contact laws, walls that rest, move, press and go, all sizes and all starts."""

import math
from pathlib import Path

import start_rows
from pieces import Pieces


def make(d):
    return Maker(d).scene()


class Maker:
    def __init__(self, d):
        self.d = d
        self.size = d.one("size", [1e-3, 1e-3, 0.05, 1.0])
        self.hertz = d.chance("hertz", 0.45)
        self.rho = d.one("rho", [1.0, 2500.0, 7800.0])
        self.speed = d.one("speed", [0.3, 1.0, 12.0])
        # So stiff that the fastest head-on impact overlaps by this share of the diameter.
        self.mass = self.rho * math.pi / 6 * self.size**3
        overlap = d.log("softness", 0.005, 0.12) * self.size
        self.stiffness = 0.5 * self.mass * (self.speed / overlap) ** 2
        self.young = self.stiffness / self.size * 3
        self.contact_time = math.pi * math.sqrt(self.mass / (2 * self.stiffness))
        self.steps = d.whole("steps", 10, 120)
        self.damped = not self.hertz and d.chance("one damping", 0.2)
        self.latched = not self.hertz and not self.damped and d.chance("latched", 0.3)

    def scene(self):
        d = self.d
        scene = {"title": "Random grains"}
        if d.chance("say 3", 0.3):
            scene["dimension"] = 3
        self.place()
        scene["domain"] = self.domain()
        scene["group"] = self.groups()
        scene["contact"] = self.contact()
        scene["wall"] = self.walls()
        if meshes := self.meshes():
            scene["mesh"] = meshes
        scene["start"] = self.start()
        dt = 0.04 * self.contact_time
        scene["time"] = {"steps": self.steps}
        if d.chance("fixed step", 0.5):
            scene["time"]["dt"] = dt * d.one("dt", [0.2, 1.0, 1.5])
        if stages := self.stages(scene["wall"], dt):
            scene["stage"] = stages
        self.openings(scene, dt)
        case = {"scene": scene, "skin": self.skin}
        way = d.weighted("start", {"lattice": 5, "file": 4, "tile": 1})
        if way == "file":
            self.from_file(case)
        elif way == "tile":
            self.from_tile(case)
        return case

    def place(self):
        """A lattice of n cells that begins at 0, and a domain around it."""
        d = self.d
        total = d.log("grains", 1, 400) if d.chance("few", 0.95) else 2000
        shape = [d.log(f"shape/{a}", 1, 5) for a in range(3)]
        scale = (total / math.prod(shape)) ** (1 / 3)
        self.n = [max(1, round(s * scale)) for s in shape]
        self.dx = self.size * d.one("spacing", [0.97, 1.0, 1.02, 1.1, 1.5])
        self.ratio = d.weighted("ratio", {1.0: 4, 0.9: 3, 0.5: 2, 0.2: 1, 0.05: 0.5})
        self.periodic, self.lower, self.upper, largest = [], [], [], 1e9
        for a in range(3):
            period = d.chance(f"periodic/{a}", 0.3)
            self.periodic.append(period)
            if period:
                least = math.ceil(3.2 * self.size / self.dx)
                self.n[a] = max(self.n[a], least)
                self.lower.append(0.0), self.upper.append(self.n[a] * self.dx)
                largest = min(largest, self.upper[a] / self.size)
            else:
                self.lower.append(-self.size * d.one(f"below/{a}", [0.0, 4.0, 8.0, 8.0, 30.0]))
                self.upper.append(self.n[a] * self.dx + self.size * d.one(f"above/{a}", [0.6, 4.0, 8.0, 8.0, 30.0]))
        self.skin = min(2.0, largest / 3.001 - 1)

    def domain(self):
        d = self.d
        out = {"lower": self.lower, "upper": self.upper}
        if any(self.periodic) or d.chance("say periods", 0.2):
            out["periodic"] = self.periodic
        if d.chance("gravity", 0.7):
            out["gravity"] = d.vector("g", self.speed**2 / self.size * d.log("weight", 1e-3, 0.3), 3)
        return out

    def material(self, d):
        out = {}
        if self.hertz:
            out["young_modulus"] = self.young * d.one("young", [1.0, 1.0, 0.5, 3.0])
            out["poisson_ratio"] = d.one("poisson", [0.3, 0.0, 0.5, -0.2])
        else:
            out["normal_stiffness"] = self.stiffness * d.one("k", [1.0, 1.0, 0.5, 3.0])
            if d.chance("kt", 0.3):
                out["tangential_stiffness"] = out["normal_stiffness"] * d.log("kt value", 0.1, 1)
        if not self.damped:
            out["restitution"] = d.one("latch", [1.0, 0.9, 0.7]) if self.latched else d.one("e", [1.0, 0.9, 0.5, 0.2])
        if self.rough and d.chance("rough", 0.9):
            out["friction"] = d.one("mu", [0.1, 0.5, 0.9, 2.0])
        if self.rolls and d.chance("rolls", 0.9):
            out["rolling_friction"] = d.one("mu_r", [0.01, 0.1, 0.5])
        return out

    def groups(self):
        d, out = self.d, []
        self.rough = d.chance("rough", 0.75)
        self.rolls = self.rough and d.chance("rolling", 0.5)
        names = ["sand", "gravel", "dust"][: d.weighted("kinds", {1: 3, 2: 3, 3: 1})]
        self.sizes = {}
        for k, name in enumerate(names):
            g = d.part("grains", k)
            top = self.size * (1.0 if k == 0 else g.real("top", self.ratio, 1))
            low = top * self.ratio
            self.sizes[name] = (low, top)
            out.append({"name": name, "kind": "grain", "density": self.rho * g.one("density", [1.0, 1.0, 0.5, 3.0]),
                        "diameter": top if self.ratio == 1 else [low, top]} | self.material(g))
        if d.chance("fixed", 0.25):
            glued = {"name": "glued", "kind": "grain", "density": self.rho, "diameter": self.size,
                     "fixed": True} | self.material(d.part("glued"))
            if d.chance("dragged", 0.6):
                glued["velocity"] = d.vector("drag", 0.5 * self.speed, 3)
            self.sizes["glued"] = (self.size, self.size)
            out.append(glued)
        elif d.chance("say loose", 0.1):
            out[0]["fixed"] = False
        out.append({"name": "steel", "kind": "grain"} | self.material(d.part("steel")))
        return out

    def contact(self):
        d = self.d
        out = {"law": "hertz" if self.hertz else "walton_braun" if self.latched else "linear"}
        if self.damped:
            out["normal_damping"] = d.real("damping", 0, 0.5) / self.contact_time
        if not self.latched and d.chance("tangential", 0.4):
            out["tangential_damping"] = d.real("tangential value", 0, 1)
        if d.chance("rolling", 0.4):
            out["rolling_damping"] = d.real("rolling value", 0, 1)
        if not self.latched and d.chance("pull", 0.4):
            out["pull"] = d.chance("pulls", 0.7)
        out["largest_overlap"] = d.one("overlap", [0.5, 0.5, 0.5, 0.2])
        if len(self.sizes) > 1 and d.chance("pairs", 0.4):
            pair = {"groups": list(self.sizes)[:2] if d.chance("two", 0.7) else ["sand", "sand"]}
            pair["friction"] = 0.3 if self.rough else 0.0
            if self.rolls:
                pair["rolling_friction"] = 0.05
            if not self.damped and d.chance("restitution", 0.5):
                pair["restitution"] = 0.7
            out["pair"] = [pair]
        return out

    def openings(self, scene, dt):
        """Faces that delete, drains, and boxes that grains come from, over periods, in walls and in what is there."""
        d, domain = self.d.part("openings"), scene["domain"]
        if not d.chance("any", 0.35):
            return
        faces = [f"{'xyz'[a]}{side}" for a in range(3) if not self.periodic[a] for side in (0, 1)]
        leaves = d.one("leaves", ["none", "delete", "delete", "stop", "some"])
        if leaves != "none":
            domain["leaves"] = [f for f in faces if d.chance(f"leaves/{f}", 0.5)] if leaves == "some" else leaves
        scene["outlet"] = [self.drain(d.part("drain", k), dt) for k in range(d.weighted("drains", {0: 2, 1: 3, 2: 1}))]
        scene["insertion"] = [i for k in range(d.weighted("insertions", {0: 1, 1: 3, 2: 2}))
                              if (i := self.insertion(d.part("insertion", k), dt))]
        for key in ("outlet", "insertion"):
            if not scene[key]:
                del scene[key]
        if d.chance("budget", 0.5) and ("insertion" in scene or "outlet" in scene or domain.get("leaves", "stop") not in ("stop", [])):
            scene["monitor"] = [{"kind": "budget"}]

    def drain(self, d, dt):
        out = dict(zip(("lower", "upper"), self.box(d, 0)))
        return {**out, "every": dt * d.log("every", 0.5, 60)} if d.chance("now and then", 0.4) else out

    def box(self, d, least):
        """Somewhere in the domain, so wide at least, or nothing."""
        lower, upper = [], []
        for a, (low, high) in enumerate(zip(self.lower, self.upper)):
            if high - low < 1.001 * least:
                return None
            width = d.real(f"width/{a}", 1.001 * least, high - low)
            at = d.real(f"at/{a}", low, high - width)
            lower.append(at), upper.append(at + width if width > 0 else at + 1e-3 * self.size)
        return lower, upper

    def insertion(self, d, dt):
        name = d.one("group", [n for n in self.sizes if n != "glued"])
        box = self.box(d, self.sizes[name][1])
        if box is None:
            return None
        every = dt * d.log("every", 0.5, 60)
        rate = self.mass / every * d.log("grains", 0.1, 40)
        if d.chance("in time", 0.4):
            rate = [[0, rate], [every * d.real("turn", 0.5, 3), rate * d.one("then", [0.0, 0.3, 2.0])]]
        return {"lower": box[0], "upper": box[1], "group": name, "rate": rate, "every": every,
                "velocity": d.vector("velocity", self.speed * d.one("speed", [0.0, 0.3, 0.7]), 3)}

    def walls(self):
        """A floor or a box close around the lattice, and planes of any direction that move or press."""
        d, out = self.d, []
        material = lambda p: p.one("material", ["steel", "sand"])
        free = [a for a in range(3) if not self.periodic[a]]
        if free and d.chance("box", 0.35):
            box = {"name": "box", "material": material(d.part("box")), "shape": "box",
                   "lower": [max(low, -0.02 * self.size) for low in self.lower],
                   "upper": [min(high, n * self.dx + 0.5 * self.size) for high, n in zip(self.upper, self.n)]}
            sides = [f"{'xyz'[a]}{s}" for a in free for s in "01"]
            left_out = [s for s in sides if d.chance(f"open/{s}", 0.25)]
            if left_out and len(left_out) < len(sides):
                box["open"] = left_out
            out.append(box)
        for k in range(d.weighted("planes", {0: 2, 1: 3, 2: 2, 3: 1})):
            if not free:
                break
            p = d.part("plane", k)
            axis, side = p.one("axis", free), p.one("side", [1, -1])
            normal = [0.0, 0.0, 0.0]
            normal[axis] = side * p.one("length", [1.0, 1.0, 7.0])
            for a in free:
                if a != axis and p.chance(f"tilted/{a}", 0.2):
                    normal[a] = p.real(f"tilt/{a}", -0.4, 0.4)
            point = [0.5 * n * self.dx for n in self.n]
            point[axis] = -0.02 * self.size if side > 0 else self.n[axis] * self.dx + 0.02 * self.size
            wall = {"name": f"plane{k}", "material": material(p), "point": point, "normal": normal}
            if p.chance("say plane", 0.2):
                wall["shape"] = "plane"
            way = p.weighted("way", {"rest": 2, "moves": 3, "servo": 3})
            if way == "moves":
                wall["velocity"] = p.vector("velocity", 0.3 * self.speed, 3)
            if way == "servo":
                force = self.mass * self.speed / self.contact_time * p.log("force", 0.01, 3)
                wall |= {"force": force, "servo_gain": 0.3 * self.speed / force * p.log("gain", 0.1, 10),
                         "largest_speed": 0.3 * self.speed}
            out.append(wall)
        return out

    def meshes(self):
        """A drum around the lattice and troughs below or in it, which turn, shake, move, come and go."""
        d, out = self.d, []
        if any(self.periodic) or not d.chance("meshes", 0.5):
            return out
        extent = [n * self.dx for n in self.n]
        middle, lasts = [0.5 * e for e in extent], 0.04 * self.contact_time * self.steps
        for k in range(d.weighted("number of meshes", {1: 3, 2: 2, 3: 1})):
            m = d.part("mesh", k)
            shape = m.one("shape", ["drum", "trough"])
            scale = m.one("scale", [0.5, 0.75, 1.0]) * max(extent)
            if shape == "drum":
                at = middle
            else:
                at = [middle[a] + m.real(f"at/{a}", -0.3, 0.3) * extent[a] for a in range(3)]
                at[2] = m.one("height", [0.0, 0.3 * scale, 0.3 * scale, 0.5 * extent[2]])
            mesh = {"name": f"mesh{k}", "material": m.one("material", ["steel", "sand"]),
                    "file": str(Path(__file__).resolve().parents[1] / "scenes" / f"{shape}.obj"), "scale": scale,
                    "origin": at}
            speed = 0.3 * self.speed
            if m.chance("smooth", 0.3):
                mesh["smooth_angle"] = m.one("angle", [0, 1, 16, 50, 89])
            if m.chance("driven", 0.25):
                mesh["direction"] = m.vector("direction", 1, 3)
                mesh["largest_speed"] = speed
                force = self.mass * self.speed / self.contact_time * m.log("force", 0.01, 3)
                if m.chance("servo", 0.5):
                    mesh |= {"force": force, "servo_gain": speed / force * m.log("gain", 0.1, 10)}
                else:
                    mesh["mass"] = m.log("mass", 0.5, 50) * self.mass
                    if m.chance("pushed", 0.5):
                        mesh["force"] = m.one("push", [-0.5, 1.0]) * force
                out.append(mesh)
                continue
            if m.chance("moves", 0.4):
                mesh["direction"] = m.vector("direction", 1, 3)
                mesh["velocity"] = m.one("velocity", [speed, [[0, 0], [0.5 * lasts, speed], [lasts, -speed]]])
            if m.chance("turns", 0.5):
                fast = speed / (2 * scale)
                mesh["spin"] = m.one("spin", [fast, [[0, fast], [0.3 * lasts, -fast]]])
                mesh["axis"] = m.one("axis", [[0, 1, 0], [0, 0, -2], [1, 1, 0.5]])
                mesh["centre"] = at
            if m.chance("shakes", 0.3):
                mesh["amplitude"] = m.vector("amplitude", 0.1 * self.size, 3)
                mesh["frequency"] = speed / self.size
            if m.chance("comes", 0.15):
                mesh["begin"] = 0.3 * lasts
            if m.chance("goes", 0.2):
                mesh["end"] = 0.6 * lasts
            out.append(mesh)
        return out

    def stages(self, walls, dt):
        d, out, gone = self.d, [], set()
        planes = [w for w in walls if w.get("shape") != "box"]
        if not planes or not d.chance("stages", 0.5):
            return out
        for k in range(d.whole("number of stages", 1, 3)):
            s, changes = d.part("stage", k), []
            for wall in planes:
                w = s.part(wall["name"])
                if wall["name"] in gone or not w.chance("changes", 0.6):
                    continue
                way = w.weighted("way", {"velocity": 3, "remove": 1, "force": 2})
                change = {"name": wall["name"]}
                if way == "force" and "force" in wall:
                    change["force"] = wall["force"] * w.log("force", 0.2, 5)
                elif way == "remove":
                    change["remove"] = True
                    gone.add(wall["name"])
                else:
                    change["velocity"] = w.vector("velocity", 0.3 * self.speed, 3)
                changes.append(change)
            if changes:
                out.append({"name": f"stage{k}", "begin": dt * self.steps * (k + 0.5) / 3, "wall": changes})
        return out

    def start(self):
        d = self.d
        out = {"spacing": self.dx, "lower": [0.0, 0.0, 0.0], "upper": [n * self.dx for n in self.n]}
        if d.chance("origin", 0.2):
            out["origin"] = [0.0, 0.0, 0.0]
        if d.chance("lattice", 0.1):
            out["lattice"] = "square"
        if jitter := d.one("jitter", [0.0, 0.02, 0.02, 0.1]):
            out["jitter"] = jitter
        if d.chance("seeded", 0.8):
            out["seed"] = d.whole("seed", 0, 2**31)
        if d.chance("moves", 0.85):
            out["velocity"] = d.vector("velocity", self.speed * d.one("fast", [0.1, 0.3, 1.0]), 3)
        elif d.chance("say rest", 0.3):
            out["velocity"] = "rest"
        out["region"] = [{"group": "sand"}]
        for k in range(d.whole("regions", 0, 3)):
            r = d.part("region", k)
            names = [name for name in self.sizes if name != "sand"]
            region = {"group": r.one("group", names + ["none"])}
            centre = [r.real(f"centre/{a}", 0, n * self.dx) for a, n in enumerate(self.n)]
            half = self.dx * r.log("half", 0.6, max(1.0, 0.4 * max(self.n)))
            if r.chance("ball", 0.5):
                region |= {"shape": "ball", "centre": centre, "radius": half}
            else:
                region |= {"shape": "box", "lower": [c - half for c in centre], "upper": [c + half for c in centre]}
            out["region"].append(region)
        return out

    def rows(self, d, n, lower):
        """One grain a lattice cell, each with its own radius, velocity and perhaps spin."""
        names, out = list(self.sizes), []
        speed = self.speed * d.one("speed", [0.1, 0.5, 1.0])
        spins = d.chance("spins", 0.5)
        thin = d.one("thin", [1.0, 1.0, 0.6])
        pieces = Pieces(d.part("pieces"), 3, speed) if d.chance("in pieces", 0.35) else None
        cells = [(i, j, k) for k in range(n[2]) for j in range(n[1]) for i in range(n[0])]
        for at, cell in enumerate(cells):
            v = pieces.velocity(cell) if pieces else d.vector(f"v/{at}", speed, 3)
            if v is None or not d.chance(f"there/{at}", thin):
                continue
            name = "sand" if d.chance(f"sand/{at}", 0.7) else d.one(f"group/{at}", names)
            low, high = self.sizes[name]
            x = [c + self.dx * (i + 0.5 + 0.05 * d.real(f"x/{at}/{a}", -1, 1))
                 for a, (i, c) in enumerate(zip(cell, lower))]
            row = {"id": 0} | dict(zip("xyz", x)) | dict(zip(("vx", "vy", "vz"), v))
            row |= {"group": name, "radius": 0.5 * low if low == high else 0.5 * min(high, d.real(f"r/{at}", low, high))}
            if spins:
                row |= dict(zip(("wx", "wy", "wz"), d.vector(f"w/{at}", speed / self.size, 3)))
            out.append(row)
        return out

    def from_file(self, case):
        d, start = self.d.part("from file"), case["scene"]["start"]
        rows = self.rows(d, self.n, [0.0, 0.0, 0.0])
        if not any(r["group"] != "glued" for r in rows):
            return
        for row, number in zip(rows, start_rows.ids(d, len(rows))):
            row["id"] = number
        for key in ("lattice", "origin", "lower", "upper", "region", "jitter", "velocity"):
            start.pop(key, None)
        case["rows of start"] = rows
        case["format"] = d.one("format", ["csv", "csv", "h5"])

    def from_tile(self, case):
        """A block that is repeated along periods, and along other axes that the domain ends with."""
        d, scene = self.d.part("tile"), case["scene"]
        start, domain = scene["start"], scene["domain"]
        repeat, n = [], []
        for a in range(3):
            copies = d.one(f"copies/{a}", [1, 2, 3]) if self.periodic[a] else 1
            while self.n[a] % copies:
                copies -= 1
            repeat.append(copies), n.append(self.n[a] // copies)
        rows = self.rows(d, n, [0.0, 0.0, 0.0])
        if not any(r["group"] != "glued" for r in rows):
            return
        domain["lower"] = [0.0 if repeat[a] > 1 else x for a, x in enumerate(domain["lower"])]
        for k, row in enumerate(rows):
            row["id"] = k
        for key in ("lattice", "origin", "lower", "upper", "region", "jitter", "velocity"):
            start.pop(key, None)
        case["rows of start"] = rows
        case["format"], case["repeat"] = d.one("format", ["csv", "h5"]), repeat
