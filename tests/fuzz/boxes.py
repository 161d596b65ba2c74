"""Where a scene of SPH has matter: a lattice of n cells along each axis, what ends it on each side, and regions."""

import functools
import math
from pathlib import Path

RING = Path(__file__).resolve().parents[1] / "scenes/ring.obj"
ENDS = {2: {"open": 3, "wall": 3, "floor": 2, "periodic": 4}, 3: {"open": 4, "wall": 3, "floor": 2, "periodic": 2}}


def counts(d, dim, most):
    """Cells of the lattice along each axis: from one particle to `most`, from slabs to needles."""
    total = d.log("particles", 1, most) if d.chance("some", 0.9) else float(most)
    if d.chance("one", 0.03):
        return [1] * dim
    shape = [d.log(f"shape/{a}", 1, 6) for a in range(dim)]
    scale = (total / math.prod(shape)) ** (1 / dim)
    return [max(1, round(s * scale)) for s in shape]


class Box:
    """Lengths in spacings. `reach`: range of the lists without a skin; `radius`: of the kernel."""

    def __init__(self, d, dim, radius, reach, ends, most, least=1):
        self.dim, self.radius, self.reach = dim, radius, reach
        self.n = [max(least, n) for n in counts(d, dim, most)]
        self.ends, self.lower, self.upper, self.layers = [], [], [], []
        # A row of the lattice lies in the middle of the domain, where it is most often cut.
        self.centred = d.chance("centred", 0.2)
        period = math.ceil(3.02 * (reach + 0.2 * radius))
        largest = 1e9
        for a in range(dim):
            end = d.weighted(f"end/{a}", {e: w for e, w in ENDS[dim].items() if e in ends})
            room = [d.one(f"room/{a}/{s}", [2.0] + 6 * [10.0] + 6 * [20.0] + 3 * [60.0]) for s in "lu"]
            if self.centred:
                room = [room[0]] * 2
                self.n[a] += 1 - self.n[a] % 2
            if end == "periodic":
                filled = d.chance(f"filled/{a}", 0.8)
                roomy = d.one(f"period/{a}", [0, 0, 5, 20])
                length = max(self.n[a], period + roomy)
                if filled and length * math.prod(self.n) / self.n[a] <= 4 * most:
                    self.n[a] = length
                self.lower.append(0.0), self.upper.append(float(length))
                self.layers.append((0, 0))
                largest = min(largest, length)
            else:
                thick = d.one(f"layers/{a}", [math.ceil(radius), math.ceil(radius), 1, 2])
                low = thick if end in ("wall", "floor") else 0
                high = thick if end == "wall" else 0
                self.lower.append(-low - (room[0] if low == 0 else d.one(f"gap/{a}", [0.5, 1.0, 5.0])))
                self.upper.append(self.n[a] + high + (room[1] if high == 0 else d.one(f"gap/{a}", [0.5, 1.0, 5.0])))
                self.layers.append((low, high))
            self.ends.append(end)
        self.skin = min(2.0, (largest / 3.001 - reach) / radius)

    def walled(self):
        return any(end in ("wall", "floor") for end in self.ends)

    def outer(self):
        """The lattice with its walls."""
        return ([-float(low) for low, _ in self.layers], [n + float(high) for n, (_, high) in zip(self.n, self.layers)])

    def fluid(self):
        """As far as the domain goes where there is no wall."""
        return [0.0] * self.dim, [float(n) for n in self.n]

    def regions(self, d, groups, least=0.6):
        """Balls and boxes of these groups, painted over each other."""
        out = []
        for k in range(d.weighted("regions", {0: 3, 1: 4, 2: 2, 3: 1})):
            r = d.part("region", k)
            group = r.one("group", groups + ["none"])
            centre = [r.real(f"centre/{a}", 0, n) for a, n in enumerate(self.n)]
            size = r.log("size", least, max(least, 0.4 * max(self.n)))
            shape = r.weighted("shape", {"ball": 3, "box": 3, "cylinder": 1, "cone": 1, "polygon" if self.dim == 2 else "mesh": 1})
            if shape == "ball":
                out.append({"group": group, "shape": "ball", "centre": centre, "radius": size})
            elif shape == "polygon":
                corners = r.whole("corners", 3, 7)
                turned = [2 * math.pi * r.whole("step", 1, 2) * c / corners for c in range(corners)]
                out.append({"group": group, "shape": shape, "points": [
                    [centre[0] + size * r.log(f"reach/{c}", 0.5, 2) * math.cos(a), centre[1] + size * math.sin(a)]
                    for c, a in enumerate(turned)]})
            elif shape == "mesh":
                out.append({"group": group, "shape": shape, "file": str(RING), "scale": size, "origin": centre})
            elif shape != "box":
                axis = r.whole("axis", 0, self.dim - 1)
                end = [c + size * r.one("way", [-1.5, 1.5]) * (a == axis) for a, c in enumerate(centre)]
                out.append({"group": group, "shape": shape, "from": centre, "to": end, "radius": size})
                if shape == "cone" and r.chance("blunt", 0.5):
                    out[-1]["top_radius"] = 0.5 * size
            else:
                half = [size * r.log(f"half/{a}", 0.5, 2) for a in range(self.dim)]
                out.append({"group": group, "shape": "box", "lower": [c - s for c, s in zip(centre, half)],
                            "upper": [c + s for c, s in zip(centre, half)]})
        return out


def scaled(region, dx, offset):
    """In metres."""
    out = dict(region)
    for key in ("lower", "upper", "centre", "from", "to", "origin"):
        if key in out:
            out[key] = [dx * x + o for x, o in zip(out[key], offset)]
    if "points" in out:
        out["points"] = [[dx * x + o for x, o in zip(point, offset)] for point in out["points"]]
    for key in ("radius", "top_radius", "scale"):
        if key in out:
            out[key] *= dx
    return out


def odd(corners, point):
    """Whether a ray along x crosses the edges between these corners an odd number of times."""
    inside = False
    for u, v in zip(corners, corners[1:] + corners[:1]):
        if (u[1] > point[1]) != (v[1] > point[1]):
            inside ^= point[0] < u[0] + (point[1] - u[1]) * (v[0] - u[0]) / (v[1] - u[1])
    return inside


@functools.cache
def ring():
    lines = [line.split() for line in RING.read_text().splitlines()]
    corners = [[float(x) for x in words[1:]] for words in lines if words[0] == "v"]
    return [[corners[int(k) - 1] for k in words[1:]] for words in lines if words[0] == "f"]


def in_ring(point):
    """A ray along z: its facets are flat."""
    inside = False
    for facet in ring():
        if not odd([corner[:2] for corner in facet], point[:2]):
            continue
        p, q, r = facet[:3]
        a, b = [y - x for x, y in zip(p, q)], [y - x for x, y in zip(p, r)]
        normal = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        inside ^= point[2] < p[2] - sum((x - y) * n for x, y, n in zip(point[:2], p[:2], normal[:2])) / normal[2]
    return inside


def painted(regions, point):
    """The group of the last region that contains the point, None for an empty place."""
    group = None
    for r in regions:
        shape = r.get("shape", "everywhere")
        inside = shape == "everywhere"
        if shape == "box":
            inside = all(low <= x < high for x, low, high in zip(point, r["lower"], r["upper"]))
        if shape == "ball":
            inside = sum((x - c) ** 2 for x, c in zip(point, r["centre"])) < r["radius"] ** 2
        if shape in ("cylinder", "cone"):
            axis = next(a for a, (x, y) in enumerate(zip(r["from"], r["to"])) if x != y)
            part = (point[axis] - r["from"][axis]) / (r["to"][axis] - r["from"][axis])
            top = r["radius"] if shape == "cylinder" else r.get("top_radius", 0)
            inside = 0 <= part < 1 and sum((x - c) ** 2 for a, (x, c) in enumerate(zip(point, r["from"])) if a != axis) < (
                r["radius"] + (top - r["radius"]) * part) ** 2
        if shape == "polygon":
            inside = odd(r["points"], point)
        if shape == "mesh":
            inside = in_ring([(x - o) / r["scale"] for x, o in zip(point, r["origin"])])
        if inside:
            group = None if r["group"] == "none" else r["group"]
    return group


def lattice(lower, upper, dx):
    """Centres of the cells."""
    points = [[]]
    for low, high in zip(lower, upper):
        n = max(1, round((high - low) / dx))
        points = [p + [low + (k + 0.5) * dx] for k in range(n) for p in points]
    return points
