"""What a scene of SPH says of total-Lagrangian solids: elastic, rigid and breaking, alone and in a fluid."""


class TotalBodies:
    def bodies(self):
        d, out = self.d, []
        for k in range(d.weighted("bodies", {1: 2, 2: 3, 3: 1})):
            group = self.solid(d.part("body", k), ["beam", "ball", "bar"][k])
            group["lagrangian"] = "total"
            if nu := self.viscosity(d.part("body", k)):
                group["viscosity"] = min(nu, 0.1 * self.c * self.h * self.rho)
            out.append(group)
        for k in range(len(out)):
            # The first is painted everywhere: along a period it has no end.
            if (k > 0 or "periodic" not in self.box.ends) and d.chance(f"rigid/{k}", 0.3):
                out[k] = self.rigid(d.part("rigid", k), out[k], [g for g in out[:k] if g.get("rigid")])
            whole = [g["name"] for g in out[:k] if not g.get("rigid") and "part_of" not in g]
            if whole and not out[k].get("rigid") and d.chance(f"layer/{k}", 0.25):
                out[k]["part_of"] = d.one(f"layer of/{k}", whole)
        if d.chance("in a fluid", 0.65):
            out.append(self.around(d.part("around")))
            for k, body in enumerate(out[:-1]):
                if not body.get("rigid") and d.chance(f"fails/{k}", 0.6):
                    body["becomes"] = [self.failure(d.part("failure", k), body, out[-1])]
        return out

    def rigid(self, d, like, others):
        """What does not deform; the sums of its forces, which ranks share, move it."""
        out = {key: like[key] for key in ("name", "kind", "density", "bulk_modulus", "sound_speed") if key in like}
        out["rigid"] = True
        if d.chance("say total", 0.2):
            out["lagrangian"] = "total"
        whole = [g["name"] for g in others if "part_of" not in g]
        if whole and d.chance("part", 0.4):
            return out | {"part_of": d.one("of", whole)}
        if d.chance("told", 0.3):
            return out | {"motion": self.motion(d.part("motion"))}
        if d.chance("velocity", 0.4):
            out["start_velocity"] = d.vector("its velocity", 0.1 * self.c, self.dim)
        if d.chance("spin", 0.5):
            spin = d.vector("its spin", 0.05 * self.c / self.dx, 3)
            out["start_spin"] = spin if self.dim == 3 else spin[2]
        if d.chance("held", 0.3):
            out["held"] = [m for m in ["x", "y", "z"][: self.dim] + ["rotation"] if d.chance(f"held/{m}", 0.4)]
        return out

    def motion(self, d):
        """As it is told: along, to and fro, and about a point in or beside it."""
        out, time = {}, lambda p: self.dx / self.c * p.log("time", 0.3, 100)
        speeds = lambda top: lambda p: top * p.real("v", -1, 1)
        if d.chance("velocity", 0.6):
            out["velocity"] = self.steps_in_time(d.part("along"), speeds(0.1 * self.c), time)
            if d.chance("direction", 0.7):
                out["direction"] = d.vector("direction", d.one("length", [1.0, 3.0]), self.dim)
        if d.chance("swings", 0.5):
            out["frequency"] = 1 / time(d.part("period")) / 6
            out["amplitude"] = d.vector("amplitude", 0.05 * self.c / out["frequency"] / 6, self.dim)
        if not out or d.chance("spin", 0.6):
            out["spin"] = self.steps_in_time(d.part("about"), speeds(0.03 * self.c / self.dx), time)
            if self.dim == 3 and d.chance("axis", 0.7):
                out["axis"] = d.vector("axis", 1.0, 3)
            if d.chance("centre", 0.7):
                out["centre"] = [d.real(f"centre/{a}", -1, 5) * self.dx for a in range(self.dim)]
        return out

    def steps_in_time(self, d, values, time):
        if d.chance("constant", 0.4):
            return values(d)
        t, out = 0.0, []
        for k in range(d.whole("points", 1, 3)):
            out.append([t, values(d.part("point", k))])
            t += time(d.part("span", k))
        return out

    def failure(self, d, body, fluid):
        """What a body bears: of next to nothing to so much that it may never fail."""
        strength = self.rho * self.c**2 * d.log("strength", 1e-5, 0.1)
        row = {"group": fluid["name"]}
        kind = d.one("kind", ["toughness", "tensile_strength", "cohesion", "both"])
        if kind == "toughness":
            row["toughness"] = strength * self.dx**0.5
        if kind in ("tensile_strength", "both"):
            row["tensile_strength"] = strength
        if kind in ("cohesion", "both"):
            row["cohesion"] = strength * d.log("cohesion", 0.3, 3)
            if d.chance("angle", 0.6):
                row["friction_angle"] = d.one("phi", [0.0, 20.0, 30.0, 60.0])
        if body["density"] != fluid["density"] or d.chance("of volume", 0.5):
            row["keeps"] = "volume"
        elif d.chance("of both", 0.4):
            row["keeps"] = "both"
        if d.chance("mean", 0.3):
            row["average"] = d.log("mean over", 0.3, 100) * self.dx / self.c
        return row

    def around(self, d):
        """A fluid in which bodies are: one that keeps its gas and has one viscosity."""
        group = {"name": "melt", "kind": "fluid", "density": self.rho * d.one("density", [1.0, 0.5, 1.7])}
        group |= self.stiffness(d, group["density"])
        self.viscosities(d, group)
        return group

    @property
    def wet(self):
        """Bodies in a fluid."""
        return self.family == "total" and "melt" in self.movers
