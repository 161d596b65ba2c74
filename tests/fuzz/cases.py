"""A case: a scene, perhaps its start file, and rows, each another way to run it. Drawn from a seed and a number."""

import json
import math
from pathlib import Path

import grain_scene
import melt_scene
import sph_scene
import start_rows
from draw import Draw

CUTS = {"fixed": 3, "chaos": 4, "replay": 2, "quasi_newton": 2, "hybrid": 1, "literal": 1}
SKINS = [0.0, 0.0, 1e-4, 1e-3, 0.002, 0.01, 0.05, 0.2, 0.59, 1.0, 2.0]
GRAINS = 0.2
MELTS = 0.08


def make(seed, number, only=None):
    d = Draw(seed, number)
    grains = d.chance("grains", GRAINS) if only is None else only == "grains"
    melts = d.chance("melts", MELTS) if only is None else only == "melts"
    kind = melt_scene if melts else grain_scene if grains else sph_scene
    case = kind.make(d.part("scene"))
    case["name"] = f"{seed}/{number}"
    add_output(d.part("output"), case, kind)
    last = case["scene"]["time"]["steps"]
    case["steps"] = sorted({1, d.whole("compared", 1, last), last})
    case["rows"] = [row(d.part("row", k), case) for k in range(d.weighted("rows", {1: 1, 2: 4, 3: 2}))]
    return case


def skin_of_rows(d, case):
    """Lists that reach over whole spacings: to the rows of the lattice that lie exactly one reach from a face where
    the faces are in rows too (boxes.py)."""
    reach, radius = case["reach"], case["radius"]
    least, most = math.ceil(reach), math.floor(reach + min(2.0, max(0.0, case["skin"])) * radius)
    return (d.whole("rows", least, max(least, most)) - reach) / radius


def row(d, case):
    """Everything that may change no bit."""
    last, most = case["steps"][-1], case["skin"]
    out = {"ranks": 1 if d.chance("alone", 0.08) else d.whole("ranks", 2, 8), "seed": d.whole("seed", 1, 2**40)}
    skin = d.one("skin", SKINS) if d.chance("usual skin", 0.8) else d.real("any skin", 0, 2)
    if "reach" in case and d.chance("on rows", 0.7):
        skin = skin_of_rows(d, case)
        out["ranks"] = d.one("halved", [2, 4, 8])
    if skin > most:
        skin = max(0.0, most) * d.one("less", [1.0, 0.5, 0.1, 0.0])
    values = {"skin": skin}
    if every := d.one("every", [0, 0, 0, 1, 2, 7]):
        values["rebuild_every"] = every
    if d.chance("say overlap", 0.5):
        values["overlap"] = "true" if d.chance("overlap", 0.3) else "false"
    cuts = d.weighted("cuts", CUTS)
    if cuts in ("chaos", "replay"):
        out["cuts"] = cuts
    else:
        values["balance"] = cuts
    if d.chance("say cost", 0.4):
        values["cost"] = d.one("cost", ["time", "counts"])
    if d.chance("axes", 0.2):
        axes = "xyz"[: case["scene"].get("dimension", 3)]
        first = d.one("first axis", axes)
        values["cut_axes"] = json.dumps([first, d.one("second axis", axes.replace(first, ""))])
    if d.chance("slow", 0.05):
        values |= {"slow_rank": d.whole("slow rank", 0, 7), "slowness": d.real("slowness", 1, 2)}
    out["set"] = [f"decomposition.{key}={value}" for key, value in values.items()]
    if last > 1 and d.chance("restart", 0.3):
        out["restart"] = {"at": d.whole("at", 1, last - 1), "ranks": d.whole("resumed", 1, 8),
                          "files": d.one("files", [0, 1, 2, 5])}
    from_regions = "drag" in case["scene"] or "melt" in case["scene"]  # mixtures and melts start from no file
    if "rows of start" not in case and not from_regions and d.chance("shuffle", 0.25):
        out["shuffle"] = True
    return out


def add_output(d, case, kind):
    """What a run writes beside its state: seen by the rows that the program itself runs."""
    scene, dt = case["scene"], case["scene"]["time"].get("dt", 1.0)
    grains, melts = kind is grain_scene, kind is melt_scene and "drag" not in case["scene"]
    out = {}
    for key, values in {"snapshot_interval": [0, 3 * dt], "series_interval": [0, 2 * dt],
                        "checkpoint_interval": [0, 600], "status_interval": [0.1, 2], "average_time": [0, 4 * dt],
                        "sort_limit": [0, 10, 100_000_000], "compression": [0, 1, 9], "checkpoint_files": [0, 1, 3]}.items():
        if d.chance(key, 0.2):
            out[key] = d.one(f"{key} value", values)
    mixture = "drag" in scene
    for key in ["contacts"] * (grains or mixture) + ["average_space"] * (not grains and "melt" not in scene):
        if d.chance(key, 0.2):
            out[key] = d.chance(f"{key} value", 0.8)
    if out:
        scene["output"] = out
    if melts:
        scene["monitor"] = [{"kind": "melt"}] * d.chance("monitor", 0.5)
        return
    monitors = [{"kind": "energy"}, {"kind": "momentum", "name": "push"},
                {"kind": "group", "group": scene["group"][0]["name"]},
                {"kind": "particle", "nearest_to": scene["domain"]["lower"]}]
    if "rows of start" in case:
        monitors.append({"kind": "particle", "name": "one", "id": min(case["rows of start"][0]["id"], 2**63 - 1)})
    if "melt" in scene:
        monitors.append({"kind": "melt"})
    if grains or mixture:
        monitors.append({"kind": "contacts"})
        if scene.get("wall") and scene["wall"][0].get("shape") != "box":
            monitors.append({"kind": "wall", "wall": scene["wall"][0]["name"]})
    if rigid := [g["name"] for g in scene["group"] if g.get("rigid")]:
        monitors.append({"kind": "body", "group": rigid[0]})
    if any(g["kind"] == "fluid" for g in scene["group"]):
        lower, upper = scene["domain"]["lower"], scene["domain"]["upper"]
        at = [d.real(f"gauge {a}", lo, hi) for a, (lo, hi) in enumerate(zip(lower, upper))]
        to = [d.real(f"gauge to {a}", lo, hi) for a, (lo, hi) in enumerate(zip(lower, upper))]
        monitors.append({"kind": "gauge", "at": at} | ({"to": to} if d.chance("gauge line", 0.5) else {}))
        if "to" in monitors[-1] and d.chance("gauge points", 0.5):
            monitors[-1]["points"] = d.one("gauge points value", [2, 5])
        if any(scene["domain"].get("gravity", [0])):
            monitors.append({"kind": "level", "at": at})
    if not melts:
        lower, upper = (list(scene["domain"][side]) for side in ("lower", "upper"))
        axis = d.one("flux axis", list(range(len(lower))))
        lower[axis] = upper[axis] = d.real("flux at", lower[axis], upper[axis])
        monitors.append({"kind": "flux", "lower": lower, "upper": upper})
    scene["monitor"] = scene.get("monitor", []) + [m for k, m in enumerate(monitors) if d.chance(f"monitor/{k}", 0.3)]


def toml(table, path=""):
    """Values first, then tables; JSON's values are TOML's."""
    plain, tables = "", ""
    for key, value in table.items():
        name = f"{path}{key}"
        if isinstance(value, dict):
            tables += f"\n[{name}]\n" + toml(value, f"{name}.")
        elif isinstance(value, list) and any(isinstance(v, dict) for v in value):
            for v in value:
                tables += f"\n[[{name}]]\n" + toml(v, f"{name}.")
        elif value != []:
            plain += f"{key} = {json.dumps(value)}\n"
    return plain + tables


def write(case, folder):
    """The scene and its start file; returns the scene's path."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    scene = case["scene"]
    if "rows of start" in case:
        name = f"start.{case['format']}"
        rows, dim = case["rows of start"], scene.get("dimension", 3)
        if case["format"] == "csv":
            (folder / name).write_text(start_rows.csv(rows))
        else:
            start_rows.write_hdf5(folder / name, rows, [g["name"] for g in scene["group"]], dim)
        entry = {"tile": {"file": name, "repeat": case["repeat"]}} if "repeat" in case else {"file": name}
        scene = scene | {"start": scene["start"] | entry}
    path = folder / "scene.toml"
    path.write_text(toml(scene))
    return path


def keys(table, path=""):
    """Every key of a scene, with its table as scene/keys names it."""
    for key, value in table.items():
        yield f"{path}{key}"
        inner = value if isinstance(value, list) else [value]
        for v in inner:
            if isinstance(v, dict):
                yield from keys(v, f"{path}{key}.")
