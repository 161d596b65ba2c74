"""Heat, gas that flows and viscosities that follow the state in random scenes of fluids and updated solids."""

import math


class Exchanges:
    def exchanges(self, scene):
        """Rates up to what steps of explicit exchange allow, and beyond where the scene chooses its steps."""
        d, groups = self.d.part("exchanges"), scene["group"]
        fixed = "dt" in scene["time"]
        matter = [g for g in groups if g["kind"] in ("fluid", "solid")]
        walls = [g for g in groups if g["kind"] == "wall"]
        warm = d.chance("heat", 0.2)
        terms = scene.setdefault("terms", {})
        at_end = {key: d.chance(key, 0.35) for key in ("implicit_conduction", "implicit_gas_flow")}
        if warm:
            self.heat(d, matter, walls, 30.0 if at_end["implicit_conduction"] else 0.02 if fixed else 3.0)
        flows = self.gas_flow(d, matter, walls, 30.0 if at_end["implicit_gas_flow"] else 0.02 if fixed else 1.0)
        for key, there in (("implicit_conduction", warm), ("implicit_gas_flow", flows)):
            if there and (at_end[key] or d.chance(f"say {key}", 0.1)):
                terms[key] = at_end[key]
        if (terms.get("implicit_conduction") or terms.get("implicit_gas_flow")) and d.chance("exchange tolerance", 0.5):
            terms["exchange_tolerance"] = d.log("exchange tolerance value", 1e-9, 1e-3)
        if self.laws(d, matter, warm) and self.kernel != "quintic":
            terms.pop("artificial_viscosity", None)
            terms["viscosity"] = "laplacian"
        if warm and d.chance("friction", 0.3):
            terms["viscous_heat"] = True
        spreads = any("water_diffusivity" in g for g in matter)
        limited = fixed or spreads or flows or not terms.get("implicit_conduction")
        if (warm or flows or spreads) and limited and d.chance("still", 0.2):
            terms["motion"] = False
            terms.pop("viscous_heat", None)
        elif d.chance("say motion", 0.1):
            terms["motion"] = True
        if d.chance("say escape", 0.2):
            terms["gas_escape"] = d.chance("escape", 0.5)
        if not terms:
            del scene["terms"]
        self.means(d, matter)
        renewed = self.resets(d, scene, matter, warm)
        if (warm or flows or spreads or renewed) and d.chance("budget", 0.3):
            scene["monitor"] = [{"kind": "budget"}]
        self.background(d, scene)

    def means(self, d, matter):
        for k, g in enumerate(matter):
            for row in g.get("becomes", []):
                if d.chance(f"means/{k}", 0.3):
                    row["average"] = d.part("mean", k).log("over", 0.1, 20) * self.h / self.c

    def resets(self, d, scene, matter, warm):
        gas = [g["gas_content"] for g in matter if g.get("eos") == "bubbly"]
        boxes, domain = [], scene["domain"]
        presses = (any(g["kind"] == "fluid" for g in matter) and scene.get("terms", {}).get("motion", True)
                   and d.chance("presses", 0.15))
        number = d.weighted("resets", {0: 5, 1: 2, 2: 1}) if warm or gas else 0
        for k in range(max(number, 1) if presses else number):
            b_d, box = d.part("reset", k), {"lower": [], "upper": []}
            for a, (low, high) in enumerate(zip(domain["lower"], domain["upper"])):
                ends = sorted(b_d.real(f"{a}/{side}", low, high) for side in "lu")
                box["lower"].append(ends[0]), box["upper"].append(ends[1] + 1e-3 * self.dx)
            if presses and b_d.chance("flows in", 0.4):
                volume = math.prod(u - l for l, u in zip(box["lower"], box["upper"]))
                rate = self.rho * volume * b_d.log("inflow", 1e-5, 1e-2) * self.c / self.h
                end = b_d.log("inflow until", 1, 300) * self.h / self.c
                box["inflow"] = [[0, rate], [end, 0.0]] if b_d.chance("inflow ends", 0.5) else rate
            elif presses:
                box["pressure"] = self.rho * self.c**2 * b_d.log("p", 1e-5, 0.1)
                if b_d.chance("rises", 0.5):
                    box["rise_time"] = b_d.log("rise", 1, 300) * self.h / self.c
            if b_d.chance("ends", 0.2):
                box["until"] = b_d.log("until", 1, 300) * self.h / self.c
            if warm and (not gas or b_d.chance("warm", 0.7)):
                box["temperature"] = matter[0]["temperature"] * b_d.real("T", 0.7, 1.4)
            if gas and (not ("temperature" in box or presses) or b_d.chance("gas", 0.5)):
                box["gas_content"] = gas[0] * b_d.one("m", [0.0, 0.8, 1.1, 1.5])
            boxes.append(box)
        if boxes:
            scene["reset"] = boxes
        return bool(boxes)

    def background(self, d, scene):
        """Where there is no surface."""
        box, gas = self.box, any(g.get("eos") == "bubbly" for g in scene["group"])
        along = [g for g, end in zip(self.gravity, box.ends) if end == "periodic" and g]
        closed = all(end == "wall" or (end == "periodic" and n == high - low) for end, n, low, high in
                     zip(box.ends, box.n, box.lower, box.upper))
        empty = any(r["group"] == "none" for r in scene["start"]["region"])
        if not closed or empty or self.pulled or not any(self.gravity) or (gas and along) or not d.chance("background", 0.5):
            return
        scene["domain"]["background_density"] = self.rho * d.one("background is", [1.0, 1.0, 0.5, 1.3])
        if gas:
            g = math.sqrt(sum(x * x for x in self.gravity))
            highest = sum(max(-pull * low, -pull * high) for pull, low, high in
                          zip(self.gravity, scene["domain"]["lower"], scene["domain"]["upper"])) / g
            scene["domain"]["background_surface"] = highest + d.one("deep", [0.0, 5.0, 30.0]) * self.dx

    def heat(self, d, matter, walls, fastest):
        alike = d.chance("alike", 0.4)
        capacity, mean = d.one("capacity", [1.0, 1200.0]), d.one("temperature", [1.0, 1000.0])
        for k, g in enumerate(matter):
            g_d = d.part("heat", 0 if alike else k)
            kappa = self.c * self.h * g_d.one("kappa", [0.0, 1e-3, 0.02, fastest])
            heat = {"specific_heat": capacity * g_d.one("its capacity", [1.0, 1.0, 1.5]),
                    "conductivity": kappa * self.rho * capacity}
            if g_d.chance("melts", 0.4):
                heat |= {"latent_heat": capacity * mean * g_d.log("latent", 0.01, 1), "solidus": mean * 0.9,
                         "liquidus": mean * g_d.one("liquidus", [0.91, 1.1])}
            if g_d.chance("rises", 0.4):
                heat |= {"expansion": g_d.log("expansion", 1e-2, 3) / mean, "reference_temperature": mean}
            g |= {"heat": heat, "temperature": mean * d.part("start", k).real("T", 0.7, 1.4)}
        for k, g in enumerate(matter):
            others = [o["name"] for o in matter if o is not g]
            c_d = d.part("changes", k)
            if others and c_d.chance("changes", 0.25):
                row = {"group": c_d.one("into", others),
                       c_d.one("limit", ["temperature_above", "temperature_below"]): mean * c_d.real("at", 0.7, 1.4)}
                if c_d.chance("hold", 0.3):
                    row["hold"] = c_d.log("hold is", 0.1, 5) * self.h / self.c
                g["becomes"] = [*g.get("becomes", []), row]
        for k, w in enumerate(walls):
            way = d.part("wall", k).one("wall", ["tight", "temperature", "flux", "face"])
            if way == "temperature":
                w["temperature"] = mean * d.part("wall", k).real("T", 0.7, 1.4)
            elif way == "face":
                self.face(d.part("wall", k), w, capacity, mean)
            elif way == "flux":
                w["heat_flux"] = 1e-3 * self.rho * capacity * mean * self.c * d.part("wall", k).real("q", -0.1, 1)

    def face(self, d, wall, capacity, mean):
        rate = self.rho * capacity * self.c
        both = d.chance("both", 0.3)
        if both or d.chance("linear", 0.5):
            wall["heat_transfer"] = {"coefficient": rate * d.log("h", 1e-4, 1e3), "temperature": mean * d.real("T", 0, 2)}
        if both or "heat_transfer" not in wall:
            wall["radiation"] = {"emissivity": d.real("e", 0.05, 1), "temperature": mean * d.real("T_a", 0, 3)}

    def gas_flow(self, d, matter, walls, fastest):
        flows = False
        for k, g in enumerate(matter):
            if g.get("eos") != "bubbly" or not d.chance(f"flows/{k}", 0.6):
                continue
            law = d.part("law", k).one("law", ["power", "percolation", "kozeny_carman"])
            eta = d.part("law", k).one("eta", [2e-5, 1e-3])
            # D = k p / (eta psi) or so.
            rate = d.part("law", k).log("rate", 1e-4, fastest)
            made = {"law": law, "coefficient": rate * self.c * self.h * eta / self.vapour, "gas_viscosity": eta}
            if law != "kozeny_carman" and d.chance(f"exponent/{k}", 0.5):
                made["exponent"] = d.part("law", k).one("exponent", [1.0, 2.0, 3.4])
            if law == "percolation":
                made["threshold"] = d.part("law", k).one("threshold", [0.0, 0.01, 0.1, 0.3])
                if d.chance(f"latch/{k}", 0.4):
                    made["closing_threshold"] = made["threshold"] * d.part("law", k).one("closing", [0.0, 0.5, 1.0])
            if d.chance(f"inertia/{k}", 0.3):
                made["inertial_coefficient"] = d.part("law", k).log("inertia", 1e-4, 1) * made["coefficient"]
                made["inertial_exponent"] = d.part("law", k).one("inertial exponent", [0.0, 0.3])
            g["permeability"], flows = made, True
        for k, w in enumerate(walls):
            if flows and d.chance(f"open/{k}", 0.5):
                w["gas_pressure"] = self.vapour * d.one(f"beyond/{k}", [-0.2, 0.0, 0.3, 1.0])
        return flows

    def laws(self, d, matter, warm):
        """Clipped, so that steps are not much shorter than without."""
        made = False
        for k, g in enumerate(matter):
            bubbly, d_k = g.get("eos") == "bubbly", d.part("viscosity law", k)
            choices = ["constant", "hess_dingwell"] * bubbly + ["exponential", "vogel"] * warm
            if g["kind"] != "fluid" or not choices or not d_k.chance("law", 0.25):
                continue
            eta = g.get("viscosity") or 0.01 * self.c * self.h * self.rho
            mean = g.get("temperature", 1100.0)
            law = {"law": d_k.one("which", choices), "most": eta * d_k.one("most", [1.5, 10.0])}
            if d_k.chance("least", 0.3):
                law["least"] = eta * d_k.one("least is", [0.0, 0.5])
            if law["law"] == "exponential":
                law |= {"fall": d_k.real("fall", 0, 10) / mean, "reference_temperature": mean}
            elif law["law"] == "vogel":
                law |= {"a": math.log10(eta) - 1, "b": 0.5 * mean, "c": 0.5 * mean}
            elif not warm and law["law"] == "hess_dingwell":
                law["temperature"] = d_k.real("T", 900, 1400)
            if "latent_heat" in g.get("heat", {}) and d_k.chance("crystals", 0.5):
                law["crystals"] = "einstein_roscoe"
                if d_k.chance("packing", 0.3):
                    law["maximum_packing"] = d_k.real("packing is", 0.3, 1)
            if bubbly and (law["law"] == "constant" or d_k.chance("bubbles", 0.4)):
                law["bubbles"] = d_k.one("bubbles are", ["round", "stretched"])
            g.pop("viscosity", None)
            if law["law"] in ("constant", "exponential"):
                g["viscosity"] = eta
            g["viscosity_law"], made = law, True
        return made
