"""What accuracy.py has found, kept in results.json, and its table in README.md: of each case and formulation, the error at
each size and what else SHOWN names, with the commit of the run."""

import importlib
import json
import re
import time
from pathlib import Path

import numpy as np

from runs import here, tables

RESULTS = here / "results.json"
# Beside the error: columns of measure(), by case.
SHOWN = {
    "taylor_green_1000": ("kinetic energy / exact at t = 2",), "poiseuille": ("at the end",),
    "gresho": ("peak of ring means",), "elliptic_drop": ("area", "central pressure, rms after 1 ms"),
    "rotating_patch": ("largest void / dx",), "sod": ("shock ahead / dx", "energy"),
    "shock_tube": ("shock ahead / dx",), "shock_tube_10": ("shock ahead / dx",),
    "hydrostatic": ("largest kinetic energy / MgH",), "cylinder": ("rise at 1 s [m]",),
    "rising_bubble": ("least circularity", "centre of mass at 3 s", "change of area"),
    "rising_bubble_2": ("first", "second", "centre of mass at 3 s"), "cavity": ("rms error / U",),
    "heat_decay": ("rate off", "steps"), "heat_layers": ("rate off", "steps"), "water_decay": ("rate off", "steps"),
    "barenblatt": ("front ahead / dx", "steps"),
    "convection": ("Nu", "largest u", "largest v"),
    "elastic_gate": ("outwards [mm]", "upwards [mm]"),
    "fragmentation": ("first breaks [s]", "broken at 13.6 s"),
}


def read():
    return json.loads(RESULTS.read_text()) if RESULTS.exists() else {}


def keep(case, runs, values, busy):
    """Enters runs by (formulation, size). Of a busy machine seconds are worth nothing: those of before stay."""
    results = read()
    for (name, n), run in runs.items():
        entries = results.setdefault(case, {}).setdefault(name, {})
        entry = {"stopped": run.failure} if run.failure else {
            **{k: float(f"{v:.4g}") for k, v in values[name, n].items() if v is not None and np.isfinite(v)},
            "commit": run.perf["build"]["git"],
            "date": time.strftime("%Y-%m-%d", time.localtime((run.folder / "perf.json").stat().st_mtime))}
        timed = {k: v for k, v in entries.get(str(n), {}).items() if k in ("cpu", "timed")}
        if not busy and not run.failure:
            timed = {"cpu": float(f"{run.cpu:.3g}"), "timed": f"{entry['commit']}, {tables.machine()}, {entry['date']}"}
        entries[str(n)] = entry | timed
    RESULTS.write_text(json.dumps(results, indent=1) + "\n")


def several(entries, key, digits=2):
    """Of all sizes; nothing where none has it."""
    found = [f"{e[key]:.{digits}g}" if key in e else "-" for e in entries]
    return ", ".join(found) if set(found) != {"-"} else ""


def order(sizes, entries, key):
    """Of convergence, between the two finest."""
    if len(sizes) < 2 or not min(e.get(key, 0) for e in entries[-2:]) > 0:
        return ""
    return f"{np.log(entries[-2][key] / entries[-1][key]) / np.log(int(sizes[-1]) / int(sizes[-2])):.1f}"


def title_of(module):
    return re.split(r"(?<! ): |\.?$", module.__doc__.strip().splitlines()[0])[0]


def lines():
    rows = []
    for case, formulations in read().items():
        module = importlib.import_module(case)
        title = title_of(module)
        for k, (name, by_size) in enumerate(formulations.items()):
            sizes = sorted(by_size, key=int)
            entries = [by_size[n] for n in sizes]
            if all("stopped" in e for e in entries):
                rows.append((title if k == 0 else "", name, ", ".join(sizes), "stopped by a guard", "", "", "", ""))
                continue
            also = [f"{key} {several(entries, key, 3)}" for key in SHOWN.get(case, ()) if several(entries, key)]
            rows.append((f"{title}; {module.ERROR}" if k == 0 else "", name, ", ".join(sizes),
                         several(entries, module.ERROR), order(sizes, entries, module.ERROR), "; ".join(also),
                         several(entries, "cpu"), ", ".join(sorted({e["commit"] for e in entries if "commit" in e}))))
    return tables.markdown(("case; error", "formulation", "sizes", "errors", "order", "also", "CPU s", "commit"), rows)


def write():
    entries = [e for case in read().values() for of_name in case.values() for e in of_name.values() if "commit" in e]
    commits, dates = (sorted({e[key] for e in entries}) for key in ("commit", "date"))
    timed = "; ".join(sorted({e["timed"] for e in entries if "timed" in e})) or "not measured anew on a quiet machine yet"
    tables.write(here / "README.md", "suite", tables.origin(", ".join(commits), f"CPU s: {timed}", dates[-1]), lines())
