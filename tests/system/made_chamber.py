"""A run of a magma chamber that no program has made: cells, and grains that sink onto the interface and leak through."""

import h5py
import numpy as np

SCENE = """title = "Made chamber"
dimension = 3
[domain]
lower = [0.0, 0.5, -0.2]
upper = [0.96, 1.46, 1.0]
periodic = [false, true, false]
gravity = [0.0, 0.0, -9.8]
[[group]]
name = "upper melt"
kind = "melt"
density = 2000.0
[[group]]
name = "lower melt"
kind = "melt"
density = 2300.0
[[group]]
name = "crystal"
kind = "grain"
density = 2600.0
[melt]
cells = [16, 16, 20]
diffusivity = {diffusivity}
[[melt.side]]
side = "z0"
temperature = 1250.0
[[melt.side]]
side = "z1"
temperature = 1200.0
[[monitor]]
name = "flow"
kind = "melt"
"""
CELLS, LOW, HIGH = np.array([16, 16, 20]), np.array([0, 0.5, -0.2]), np.array([0.96, 1.46, 1.0])
FLOOR = 0.4  # height of the interface
HOUR = 3600.0


def centres():
    """Of the cells, x fastest."""
    z, y, x = np.meshgrid(*(LOW[a] + (HIGH[a] - LOW[a]) / CELLS[a] * (np.arange(CELLS[a]) + 0.5) for a in (2, 1, 0)),
                          indexing="ij")
    return np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)


def write(folder, times, grains=4000, radius=0.012, heat=True, shuffled=False):
    """Snapshots at these times [s] and a series. Returns heights of the grains at each time."""
    folder.mkdir()
    generator = np.random.default_rng(7)
    start = LOW + 0.02 + (HIGH - LOW - 0.04) * generator.random((grains, 3))
    start[:, 2] = FLOOR + (HIGH[2] - FLOOR - 0.02) * generator.random(grains)
    heights = []
    for step, time in enumerate(times):
        place = start.copy()
        place[:, 2] = FLOOR + np.maximum(start[:, 2] - FLOOR - 0.05 * time / HOUR, 0.1 * (start[:, 2] - FLOOR))
        leaked = np.arange(grains) < 40 * time / HOUR
        place[leaked, 2] = LOW[2] + 0.05 + 0.1 * generator.random(leaked.sum())
        heights.append(place[:, 2])
        _snapshot(folder / f"snapshot_{step:09}.h5", step, time, place, radius, heat, shuffled)
    rows = [f"{k},{t},{8 + k % 3},1e-4,{1e-4 * (1 + np.sin(k))},1225,{0.2},{0.3}" for k, t in enumerate(times)]
    heated = ",flow_temperature,flow_heat_z0,flow_heat_z1"
    (folder / "series.csv").write_text("\n".join(
        [f"step,t [s],flow_iterations,flow_residual,flow_v_rms{heated if heat else ''}",
         *(row if heat else row.rsplit(",", 3)[0] for row in rows)]) + "\n")
    return heights


def _snapshot(path, step, time, place, radius, heat, shuffled):
    cells, grains = centres(), len(place)
    n = len(cells)
    wave = 0.06 * np.cos(2 * np.pi * cells[:, 0] / 0.96) * np.cos(2 * np.pi * cells[:, 1] / 0.96)
    columns = {
        "id": np.append(np.arange(n), n + 3 * np.arange(grains)).astype("u8"),
        "position": np.concatenate([cells, place]),
        "velocity": np.concatenate([_flow(cells), np.zeros((grains, 3))]),
        "group": np.repeat(np.array([0, 2], dtype="u4"), [n, grains]),
        "radius": np.append(np.zeros(n), np.full(grains, radius)),
        "composition": np.append((cells[:, 2] < FLOOR + wave * time / (6 * HOUR)).astype(float), np.zeros(grains)),
    }
    if heat:
        columns["temperature"] = np.append(1250 - 50 * (cells[:, 2] - LOW[2]) / (HIGH[2] - LOW[2]) + 100 * wave,
                                           np.zeros(grains))
    order = np.random.default_rng(step).permutation(n + grains) if shuffled else np.arange(n + grains)
    with h5py.File(path, "w") as file:
        file.attrs.update({"time": time, "step": step, "scene": SCENE.format(diffusivity=1e-6 if heat else 0.0)})
        for name, values in columns.items():
            file[f"particles/{name}"] = values[order]


def _flow(cells):
    """Rolls in the planes of x and z, at the lower faces across them."""
    edge = (HIGH - LOW) / CELLS
    x, z = (np.pi * (cells[:, a] - LOW[a]) / (HIGH[a] - LOW[a]) for a in (0, 2))
    lower_x, lower_z = x - 0.5 * np.pi * edge[0] / 0.96, z - 0.5 * np.pi * edge[2] / 1.2
    return 2e-4 * np.stack([np.sin(lower_x) * np.cos(z), 0 * x, -np.cos(x) * np.sin(lower_z)], axis=1)
