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
        if d.chance("velocity", 0.4):
            out["start_velocity"] = d.vector("its velocity", 0.1 * self.c, self.dim)
        if d.chance("spin", 0.5):
            spin = d.vector("its spin", 0.05 * self.c / self.dx, 3)
            out["start_spin"] = spin if self.dim == 3 else spin[2]
        if d.chance("held", 0.3):
            out["held"] = [m for m in ["x", "y", "z"][: self.dim] + ["rotation"] if d.chance(f"held/{m}", 0.4)]
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
