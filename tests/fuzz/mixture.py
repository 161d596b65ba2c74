"""Grains in the fluid of a random scene, and planes that hold them."""

import math

class Mixture:
    def add_grains(self, scene):
        d = self.d.part("grains")
        size = self.h * d.one("size", [0.2, 0.35, 0.5, 0.7])
        ratio = d.one("ratio", [1.0, 1.0, 0.8, 0.5])
        rho = self.rho * d.one("density", [2.5, 1.0, 1.1, 0.5, 8.0])
        # Contacts that last some tens of the fluid's steps, or few.
        mass = rho * math.pi / 6 * size**3
        contact_time = 0.4 * self.h / self.c / d.one("fast", [0.04, 0.1, 0.4])
        stiffness = 0.5 * mass * (math.pi / contact_time) ** 2
        hertz = d.chance("hertz", 0.3)
        scene["contact"] = {"law": "hertz" if hertz else "linear", "largest_overlap": 0.5}
        scene["drag"] = {"law": d.weighted("law", {"di_felice": 4, "gidaspow": 3, "stokes": 2, "none": 1,
                                                   "richardson_zaki": 1, "beetstra": 1})}
        if scene["drag"]["law"] != "none" and d.chance("say own", 0.4):
            scene["drag"]["own_disturbance"] = d.chance("own", 0.5)
        sand = {"name": "sand", "kind": "grain", "density": rho, "restitution": d.one("e", [1.0, 0.9, 0.5]),
                "diameter": size if ratio == 1 else [ratio * size, size]}
        if hertz:
            sand |= {"young_modulus": 3 * stiffness / size, "poisson_ratio": 0.3}
        else:
            sand["normal_stiffness"] = stiffness
        if d.chance("rough", 0.7):
            sand["friction"] = d.one("mu", [0.1, 0.5])
            if d.chance("rolls", 0.4):
                sand["rolling_friction"] = 0.1
        names = ["sand"]
        scene["group"].append(sand)
        if d.chance("glued", 0.25):
            glued = dict(sand, name="glued", fixed=True)
            if d.chance("belt", 0.3):
                glued["velocity"] = d.vector("belt", 0.1 * self.c, 3)
            scene["group"].append(glued)
            names.append("glued")
        scene["start"]["grains"] = [self.fill(d.part("fill", k), scene, size, names)
                                    for k in range(d.weighted("fills", {1: 4, 2: 1}))]
        self.planes(d, scene)

    def fill(self, d, scene, size, names):
        box, spacing = scene["domain"], size * d.one("apart", [1.02, 1.1, 1.5, 2.0])
        most, lower, upper = d.one("many", [4, 8, 12]), [], []
        for a in range(3):
            low, high = box["lower"][a], box["upper"][a]
            n = min(most, max(1, int((high - low) / spacing) - 1))
            at = low + d.real(f"at/{a}") * max(high - low - n * spacing, 0.0)
            lower.append(at), upper.append(min(at + n * spacing, high))
        fill = {"group": d.one("group", names), "lower": lower, "upper": upper, "spacing": spacing}
        if d.chance("jitter", 0.3):
            fill["jitter"] = d.real("jitter is", 0, 0.2)
        return fill

    def planes(self, d, scene):
        box = scene["domain"]
        periodic = box.get("periodic", [False] * 3)
        out = []
        for a in range(3):
            for side, key in enumerate(("lower", "upper")):
                if periodic[a] or not d.chance(f"plane/{a}/{side}", 0.6):
                    continue
                normal = [0.0] * 3
                normal[a] = -1.0 if side else 1.0
                wall = {"name": f"plane{a}{side}", "material": "sand", "point": box[key], "normal": normal}
                if d.chance(f"moves/{a}/{side}", 0.3):
                    wall["velocity"] = d.vector(f"moves/{a}/{side}", 0.02 * self.c, 3)
                out.append(wall)
        if out:
            scene["wall"] = out
