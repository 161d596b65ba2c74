"""What a scene of SPH says in [terms]: only what is compiled and allowed together."""


class Terms:
    def terms(self, scene):
        d, out = self.d, {}
        if self.family == "total":
            if self.stretch != 1.2:
                out["largest_stretch"] = self.stretch
            if d.chance("hourglass", 0.4):
                out["hourglass"] = d.real("hourglass value", 0, 1)
            if d.chance("reach", 0.3):
                reach = min(d.one("reach value", [1.5, 1.9, 2.4, 3.0]), 0.999 * 3 * self.ratio)
                if reach >= 1.5:
                    out["bond_reach"] = reach
            if self.wet:
                self.wet_terms(out)
            return out
        if self.family == "gas":
            for key in ("artificial_viscosity", "quadratic_viscosity", "artificial_conduction"):
                if d.chance(key, 0.3):
                    out[key] = d.real(f"{key} value", 0, 3)
            return out
        if d.chance("artificial", 0.25):
            out["artificial_viscosity"] = d.log("alpha", 0.01, 0.5)
        if self.family == "ida":
            return out
        if d.chance("diffusion", 0.3):
            out["density_diffusion"] = d.one("delta", [0.0, 0.05, 0.1, 0.3])
        alpha = "artificial_viscosity" in out
        same = len({g.get("viscosity", 0) for g in scene["group"]}) == 1 and len(scene["group"]) == 1
        if self.kernel != "quintic":
            if alpha and not same:
                del out["artificial_viscosity"]
        if d.chance("form", 0.4) and not (self.kernel != "quintic" and "artificial_viscosity" in out):
            out["viscosity"] = d.one("viscosity form", ["laplacian", "symmetric"])
        if self.family == "solid" and d.chance("against clumps", 0.3):
            out["artificial_stress"] = d.one("eps of tension", [0.1, 0.3, 1.0])
        if self.family == "fluid":
            self.fluid_terms(scene, out)
        return out

    def wet_terms(self, out):
        d = self.d
        if d.chance("artificial", 0.25):
            out["artificial_viscosity"] = d.log("alpha", 0.01, 0.5)
        if d.chance("diffusion", 0.3):
            out["density_diffusion"] = d.one("delta", [0.0, 0.05, 0.1, 0.3])
        if d.chance("form", 0.4):
            out["viscosity"] = d.one("viscosity form", ["laplacian", "symmetric"])
        if d.chance("shifting", 0.3):
            out["shifting"] = True

    def fluid_terms(self, scene, out):
        d = self.d
        quintic = self.kernel == "quintic"
        if d.chance("shifting", 0.4):
            out["shifting"] = True
        elif d.chance("say unshifted", 0.1):
            out["shifting"] = False
        if d.chance("xsph", 0.25):
            out["xsph"] = d.one("eps", [0.1, 0.5, 1.0])
        if quintic and not self.pulled and d.chance("weighted", 0.3):
            out["pressure_weights"] = "density"
        elif d.chance("say volume", 0.1):
            out["pressure_weights"] = "volume"
        sprays = {row["group"] for g in scene["group"] for row in g.get("becomes", []) if "void_fraction_above" in row}
        fluids = [m for m in self.movers if m not in sprays]
        if quintic and not self.pulled and len(fluids) > 1 and d.chance("tension", 0.4):
            out.pop("artificial_viscosity", None)
            out["surface_tension"] = {"between": fluids[:2],
                                      "coefficient": self.rho * self.c**2 * self.dx * d.log("sigma", 1e-4, 0.1)}
            if len(fluids) == 2 and d.chance("tension form", 0.6):
                out["surface_tension"]["form"] = d.one("tension form value", ["jump", "jump", "stress"])
        slips = any(g.get("slip") for g in scene["group"])
        if not slips and d.chance("implicit", 0.25):
            out.pop("artificial_viscosity", None)
            out["implicit_viscosity"] = True
            if not quintic:
                out["viscosity"] = "laplacian"
            if d.chance("tolerance", 0.5):
                out["viscosity_tolerance"] = d.log("tolerance value", 1e-5, 0.05)
        elif d.chance("say explicit", 0.1):
            out["implicit_viscosity"] = False
