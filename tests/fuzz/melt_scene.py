"""A random scene of melts that flow slowly on a grid."""


import math


class MeltScene:
    def __init__(self, d):
        self.d, self.dim = d, d.weighted("dim", {2: 1, 3: 1})
        self.axes = "xyz"[: self.dim]

    def make(self):
        d, dim = self.d, self.dim
        least = [d.one(f"m/{a}", [4, 5, 6, 7]) for a in self.axes]
        halvings = d.one("k", [1, 2, 3]) if dim == 2 else d.weighted("k3", {1: 12, 0: 1})
        cells = [m * 2**halvings for m in least]
        edge = d.log("edge", 1e-3, 1e3)
        stretch = [d.real(f"stretch/{a}", 1, 1.2) for a in self.axes]
        lower = [d.real(f"lower/{a}", -3, 3) * edge for a in self.axes]
        upper = [lower[a] + cells[a] * edge * stretch[a] for a in range(dim)]
        self.periodic = [d.chance(f"periodic/{a}", 0.25) for a in self.axes]
        self.heat = d.chance("heat", 0.7)
        viscosity, density = d.log("viscosity", 1e-2, 1e8), d.log("density", 1, 1e4)
        weight = d.log("weight", 0.1, 20)
        speed = density * weight * edge**2 / viscosity  # of a blob of some cells, about
        gravity = [0.0] * dim
        gravity[dim - 1] = -weight
        if d.chance("tilted", 0.3):
            gravity[0] = d.real("tilt", -1, 1) * weight
        melt = {"cells": cells, "tolerance": d.one("tolerance", [1e-2, 1e-3, 1e-4])}
        if d.chance("courant", 0.5):
            melt["courant"] = d.real("courant is", 0.05, 0.5)
        if d.chance("most", 0.3):
            melt["most_iterations"] = d.one("most is", [3, 50, 1000])
        if d.chance("wave", 0.5):
            closed = [a for a in range(dim - 1) if self.periodic[a]]
            length = (upper[closed[0] if closed else 0] - lower[closed[0] if closed else 0]) * d.one("waves", [1, 0.5] if closed else [1, 2])
            if len(closed) < 2:  # periods of different lengths have no wave in common
                melt |= {"wave_height": d.real("height", -2, 2) * edge, "wave_length": length}
        groups = [{"name": "first", "kind": "melt", "density": density, "viscosity": viscosity}]
        if d.chance("second", 0.7):
            groups.append({"name": "second", "kind": "melt", "density": density * d.real("ratio", 0.8, 1.2),
                           "viscosity": viscosity * d.log("contrast", 1e-2, 1e2)})
        if self.heat:
            self.add_heat(melt, groups, speed * edge)
        melt["side"] = [self.side(k) for k in range(2 * dim) if not self.periodic[k // 2] and d.chance(f"side/{k}", 0.5)]
        if melt.get("profile") == "conductive":
            self.close(melt)
        regions = [{"group": "first"}]
        if len(groups) > 1:
            regions.append(self.region(lower, upper))
            if not self.periodic[-1] and d.chance("mixed", 0.2):
                melt["mixture"] = "linear"
        time = {"steps": d.whole("steps", 1, 6)}
        if not self.heat or d.chance("dt", 0.7):
            time["dt"] = d.log("dt is", 0.01, 100) * edge / speed
        scene = {"dimension": dim, "domain": {"lower": lower, "upper": upper, "gravity": gravity}, "melt": melt,
                 "group": groups, "start": {"region": regions}, "time": time}
        if any(self.periodic):
            scene["domain"]["periodic"] = self.periodic
        if dim == 3 and d.chance("grains", 0.7):
            self.add_grains(scene, min((upper[a] - lower[a]) / cells[a] for a in range(dim)))
        # Three cells of the lists fit into each period.
        reach = min((upper[a] - lower[a]) / cells[a] for a in range(dim))
        periods = [upper[a] - lower[a] for a in range(dim) if self.periodic[a]]
        return {"scene": scene, "skin": min([2.0] + [0.99 * (p / (3 * reach) - 1) for p in periods])}

    def add_grains(self, scene, edge):
        """Grains in the melts, and planes that hold them."""
        d = self.d.part("grains")
        first, box = scene["group"][0], scene["domain"]
        size = edge * d.one("size", [0.2, 0.35, 0.5, 0.9])
        ratio = d.one("ratio", [1.0, 1.0, 0.7])
        rho = first["density"] * d.one("density", [1.0, 1.2, 1.1, 0.7, 3.0])
        weight = math.pi / 6 * size**3 * abs(rho - first["density"] or 0.1 * rho) * abs(box["gravity"][-1])
        stiffness = weight / size * d.log("stiff", 1, 1e3)
        hertz = d.chance("hertz", 0.3)
        scene["contact"] = {"law": "hertz" if hertz else d.one("law", ["linear", "linear", "walton_braun"]),
                            "largest_overlap": 0.5}
        scene["drag"] = {"law": d.one("drag", ["richardson_zaki", "beetstra", "stokes", "di_felice", "gidaspow"])}
        if d.chance("say own", 0.4):
            scene["drag"]["own_disturbance"] = d.chance("own", 0.5)
        if d.chance("packed", 0.4):
            scene["drag"]["packed_fraction"] = d.real("packed is", 0.4, 0.9)
        sand = {"name": "sand", "kind": "grain", "density": rho,
                "diameter": size if ratio == 1 else [ratio * size, size]}
        if hertz:
            sand |= {"young_modulus": 10 * stiffness / size, "poisson_ratio": 0.3}
        else:
            sand["normal_stiffness"] = stiffness
        if scene["contact"]["law"] == "walton_braun":
            sand["restitution"] = d.one("e", [1.0, 0.9, 0.5])
        if d.chance("rough", 0.7):
            sand["friction"] = d.one("mu", [0.1, 0.5])
            if d.chance("rolls", 0.4):
                sand["rolling_friction"] = 0.1
        scene["group"].insert(d.whole("first", 0, len(scene["group"])), sand)
        scene["start"]["seed"] = d.whole("seed", 0, 1000)
        scene["start"]["grains"] = [self.fill(d.part("fill", k), box, size) for k in range(d.weighted("fills", {1: 4, 2: 1}))]
        scene["time"]["steps"] = d.whole("steps", 1, 40)
        walls = []
        for a in range(3):
            for side, key in enumerate(("lower", "upper")):
                if self.periodic[a] or not d.chance(f"plane/{a}/{side}", 0.8):
                    continue
                normal = [0.0] * 3
                normal[a] = -1.0 if side else 1.0
                walls.append({"name": f"plane{a}{side}", "material": "sand", "point": box[key], "normal": normal})
        if walls:
            scene["wall"] = walls

    def fill(self, d, box, size):
        spacing, lower, upper = size * d.one("apart", [1.02, 1.1, 1.5, 2.5]), [], []
        most = d.one("many", [1, 4, 8, 12])
        for a in range(3):
            low, high = box["lower"][a], box["upper"][a]
            n = min(most, max(1, int((high - low) / spacing) - 1))
            at = low + d.real(f"at/{a}") * max(high - low - n * spacing, 0.0)
            lower.append(at), upper.append(min(at + n * spacing, high))
        fill = {"group": "sand", "lower": lower, "upper": upper, "spacing": spacing}
        if d.chance("jitter", 0.5):
            fill["jitter"] = d.real("jitter is", 0, 0.2)
        if d.chance("sparse", 0.3):
            fill["occupied"] = d.real("share", 0.2, 1)
        return fill

    def add_heat(self, melt, groups, diffusivity):
        d = self.d.part("heat")
        melt["diffusivity"] = diffusivity * d.log("diffusivity", 1e-4, 10)
        if d.chance("expands", 0.8):
            melt["expansion"] = d.log("expansion", 1e-6, 1e-3)
        if d.chance("reference", 0.5):
            melt["reference_temperature"] = d.real("reference is", -500, 500)
        if d.chance("thins", 0.5):
            melt["viscosity_fall"] = d.log("fall", 1e-4, 1e-2)
        if not self.periodic[-1] and d.chance("conductive", 0.4):
            melt["profile"] = "conductive"
        else:
            if d.chance("profile", 0.2):
                melt["profile"] = "groups"
            for k, g in enumerate(groups):
                if d.chance(f"of/{k}", 0.8):
                    g["temperature"] = d.real(f"is/{k}", -500, 500)

    def side(self, k):
        d = self.d.part("side", k)
        out = {"side": f"{self.axes[k // 2]}{k % 2}"}
        if d.chance("slip", 0.6):
            out["slip"] = d.chance("slips", 0.3)
        what = d.one("what", ["nothing", "temperature", "heat_flux"]) if self.heat else "nothing"
        if what == "temperature":
            out["temperature"] = d.real("temperature", -500, 500)
        if what == "heat_flux":
            out["heat_flux"] = d.real("flux", -1, 1) * d.log("much", 1e-6, 1e-2)
        return out

    def close(self, melt):
        """The two sides that heat is conducted between have temperatures."""
        for k in (2 * self.dim - 2, 2 * self.dim - 1):
            name = f"{self.axes[k // 2]}{k % 2}"
            found = next((s for s in melt["side"] if s["side"] == name), None)
            if found is None:
                found = {"side": name}
                melt["side"].append(found)
            found.pop("heat_flux", None)
            found.setdefault("temperature", self.d.real(f"closed/{k}", -500, 500))

    def region(self, lower, upper):
        d = self.d.part("region")
        span = [u - l for l, u in zip(lower, upper)]
        if d.chance("ball", 0.5):
            return {"group": "second", "shape": "ball", "radius": 0.3 * min(span),
                    "centre": [l + s * d.real(f"centre/{a}", 0.2, 0.8) for a, (l, s) in enumerate(zip(lower, span))]}
        top = list(upper)
        top[-1] = lower[-1] + span[-1] * d.real("top", 0.2, 0.8)
        return {"group": "second", "shape": "box", "lower": [l - s for l, s in zip(lower, span)],
                "upper": [t + s * (a < self.dim - 1) for a, (t, s) in enumerate(zip(top, span))]}


def make(d):
    return MeltScene(d).make()
