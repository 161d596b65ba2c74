"""Inlets, outlets and faces that delete, of scenes of fluids and bodies in them."""

import math

import boxes


class Openings:
    def openings(self, scene):
        d = self.d.part("openings")
        if self.mixed or self.family in ("ida", "gas") or (self.family == "total" and not self.wet):
            return
        if not scene.get("terms", {}).get("motion", True) or not d.chance("any", 0.2):
            return
        free = [a for a in range(self.dim) if self.box.ends[a] != "periodic"]
        if free:
            faces = [f"{'xyz'[a]}{side}" for a in free for side in (0, 1)]
            leaves = d.one("leaves", ["none", "delete", "delete", "stop", "some"])
            if leaves != "none":
                scene["domain"]["leaves"] = ([f for f in faces if d.chance(f"leaves/{f}", 0.5)]
                                             if leaves == "some" else leaves)
        if d.chance("drain", 0.4):
            scene["outlet"] = [self.drain(d, scene["domain"])]
        if free and d.chance("led", 0.4):
            scene.setdefault("outlet", []).append(self.led_outlet(d, scene["domain"], free))
        if inlet := self.inlet(d, scene, free):
            scene["inlet"] = [inlet]
        if d.chance("budget", 0.5) and ("inlet" in scene or "outlet" in scene or scene["domain"].get("leaves", "stop") not in ("stop", [])):
            scene["monitor"] = [{"kind": "budget"}]

    def curve(self, d, values):
        """A value, or some of them in time."""
        if d.chance("constant", 0.6):
            return values(d)
        times = sorted(d.log(f"t/{k}", 0.1, 300) * self.h / self.c for k in range(d.whole("points", 1, 3)))
        return [[t + k * 1e-6 * self.h / self.c, values(d.part("point", k))] for k, t in enumerate(times)]

    def pressures(self, d):
        return self.rho * self.c**2 * d.one("p", [0.0, d.log("high", 1e-5, 0.05)])

    def drain(self, d, domain):
        out = {"lower": [], "upper": []}
        for a, (low, high) in enumerate(zip(domain["lower"], domain["upper"])):
            ends = sorted(d.real(f"drain/{a}/{side}", low, high) for side in "lu")
            out["lower"].append(ends[0]), out["upper"].append(min(ends[1] + 1e-3 * self.dx, high))
        return out

    def led_outlet(self, d, domain, free):
        """Along the whole of a side."""
        a = d.one("led axis", free)
        up = d.chance("led up", 0.5)
        out = {"lower": list(domain["lower"]), "upper": list(domain["upper"]),
               "direction": f"{'+' if up else '-'}{'xyz'[a]}", "pressure": self.curve(d.part("led"), self.pressures)}
        length = self.box.radius * self.dx * d.real("led length", 1.01, 1.6)
        fluid = [self.offset[a], self.offset[a] + self.dx * self.box.n[a]]
        if up:
            out["lower"][a] = max(domain["lower"][a], min(fluid[1], domain["upper"][a]) - length)
            out["upper"][a] = min(domain["upper"][a], out["lower"][a] + length)
        else:
            out["upper"][a] = min(domain["upper"][a], max(fluid[0], domain["lower"][a]) + length)
            out["lower"][a] = max(domain["lower"][a], out["upper"][a] - length)
        if out["upper"][a] - out["lower"][a] < self.box.radius * self.dx * 1.001:
            out["lower"][a], out["upper"][a] = domain["lower"][a], domain["upper"][a]
        if d.chance("settles", 0.4):
            out["settle_time"] = d.log("settle", 1, 500) * self.h / self.c
        return out

    def inlet(self, d, scene, free):
        """A box of cells of the lattice, painted last."""
        start, box = scene["start"], self.box
        fluids = [g for g in scene["group"] if g["kind"] == "fluid"]
        layers = math.ceil(box.radius * (1 - 1e-9)) + d.one("more layers", [0, 0, 1])
        long = [a for a in free if box.n[a] > layers]
        if not fluids or not long or start.get("lattice", "square") != "square" or "origin" in start or not d.chance("inlet", 0.6):
            return None
        a, group = d.one("axis", long), d.one("inlet group", fluids)
        up = d.chance("up", 0.5)
        lower, upper = [0.0] * self.dim, [float(n) for n in box.n]
        for b in range(self.dim):
            if b == a:
                lower[b] = 0.0 if up else float(box.n[b] - layers)
                upper[b] = lower[b] + layers
            elif d.chance(f"part/{b}", 0.5):
                lower[b] = float(d.whole(f"from/{b}", 0, box.n[b] - 1))
                upper[b] = float(d.whole(f"to/{b}", int(lower[b]) + 1, box.n[b]))
        region = boxes.scaled({"group": group["name"], "shape": "box", "lower": lower, "upper": upper},
                              self.dx, self.offset)
        start["region"].append(region)
        out = {"lower": region["lower"], "upper": region["upper"], "group": group["name"],
               "direction": f"{'+' if up else '-'}{'xyz'[a]}"}
        if d.chance("by pressure", 0.3):
            out["pressure"] = self.curve(d.part("inlet"), self.pressures)
        else:
            out["velocity"] = self.curve(d.part("inlet"), lambda p: self.c * p.one("v", [0.0, p.log("speed", 0.01, 0.5)]))
        if d.chance("parabolic", 0.4):
            out["profile"] = "parabolic"
        if "heat" in group and d.chance("warm", 0.5):
            out["temperature"] = group["temperature"] * d.real("T", 0.7, 1.4)
        if group.get("eos") == "bubbly" and d.chance("gas", 0.5):
            out["gas_content"] = group["gas_content"] * d.one("m", [0.0, 0.8, 1.1])
        return out
