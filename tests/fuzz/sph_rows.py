"""The matter of a scene of SPH from a file, where each particle may have a velocity and a density of its own."""

import math

import boxes
import start_rows
from pieces import Pieces


class FromFile:
    def from_file(self, case):
        d, start = self.d.part("from file"), case["scene"]["start"]
        jitter, rows = start.get("jitter", 0.0) * self.dx, []
        count = math.prod(round((u - l) / self.dx) or 1 for l, u in zip(start["lower"], start["upper"]))
        if count > 1200:
            return
        kinds = {g["name"]: g for g in case["scene"]["group"]}
        way = d.weighted("way", {"all": 3, "streams": 3, "any": 2, "apart": 1, "pieces": 3})
        speed = self.c * self.mach(d)
        along = d.vector("along", speed, self.dim)
        pieces = Pieces(d.part("pieces"), self.dim, speed)
        across = d.whole("across", 0, self.dim - 1)
        middle = [0.5 * (a + b) for a, b in zip(start["lower"], start["upper"])]
        thin = 1.0 if self.family == "total" else d.one("thin", [1.0, 1.0, 1.0, 0.7, 0.3])
        columns = d.one("columns", [(), ("rho",), ("rho", "extra")])
        for k, x in enumerate(boxes.lattice(start["lower"], start["upper"], self.dx)):
            group = boxes.painted(start["region"], x)
            if group is None or not d.chance(f"there/{k}", thin):
                continue
            mobile = kinds[group]["kind"] != "wall"
            own = pieces.velocity([(c - l) / self.dx for c, l in zip(x, start["lower"])])
            if way == "pieces" and mobile and own is None:
                continue
            v = [0.0] * self.dim
            if mobile:
                x = [c + jitter * d.real(f"x/{k}/{a}", -1, 1) for a, c in enumerate(x)]
                v = {"all": along, "pieces": own, "streams": along if x[across] > middle[across] else [-w for w in along],
                     "any": d.vector(f"v/{k}", speed, self.dim),
                     "apart": [speed * (c - m) / (self.dx * max(self.box.n)) for c, m in zip(x, middle)]}[way]
            row = {"id": 0} | dict(zip("xyz", x)) | dict(zip(("vx", "vy", "vz"), v)) | {"group": group}
            rho = kinds[group].get("density", self.rho)
            if "rho" in columns:
                row["rho"] = rho * (1 + 0.002 * d.real(f"rho/{k}", -1, 1))
            if "extra" in columns and any(g.get("eos") == "bubbly" for g in kinds.values()):
                row["m"] = kinds[group].get("gas_content", 0.001) * d.real(f"m/{k}", 0.5, 1.5)
            if "extra" in columns and self.family == "gas":
                gas = kinds[group]
                u = gas["start_pressure"] / (gas["heat_ratio"] - 1) / rho if mobile else 1.0
                row |= {"u": u * d.real(f"u/{k}", 0.8, 1.2), "mass": rho * self.dx**self.dim}
            if "extra" in columns and mobile and "heat" in kinds[group]:
                row["T"] = kinds[group]["temperature"] * d.real(f"T/{k}", 0.8, 1.2)
            elif "extra" in columns and any("heat" in g for g in kinds.values()):
                row["T"] = 0.0
            rows.append(row)
        if not any(kinds[r["group"]]["kind"] != "wall" for r in rows):
            return
        for row, number in zip(rows, start_rows.ids(d, len(rows))):
            row["id"] = number
        for key in ("lattice", "origin", "lower", "upper", "region", "jitter"):
            start.pop(key, None)
        if "background_density" in case["scene"]["domain"]:
            start["free_surface"] = False
        elif d.chance("surface", 0.3):
            start["free_surface"] = d.chance("free", 0.5)
        case["rows of start"] = rows
        case["format"] = d.one("format", ["csv", "csv", "h5"])
