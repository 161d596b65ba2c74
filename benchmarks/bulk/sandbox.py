"""Buiter et al. (2016), experiment 2, with the sandbox: seeds, half the speed, four times the stiffness."""

import numpy as np

from grain_run import Run
from history import History
from runs import source

SANDBOX = source / "apps/sandbox/sandbox.toml"
HALF_SPEED = ["stage.shorten.wall.back.velocity=[0.008, 0, 0]", "time.until=13 s", "output.snapshot_interval=0.25 s"]
STIFF = ["group.sand.normal_stiffness=1280", "group.plate.normal_stiffness=1280", "time.dt=8.75e-6"]
VARIANTS = {"seed 0": [], "seed 1": ["start.seed=1"], "seed 2": ["start.seed=2"], "half speed": HALF_SPEED,
            "4 k": STIFF}


def measure(runner):
    futures = {name: runner.start("sandbox_" + name.replace(" ", "_"), SANDBOX, *settings)
               for name, settings in sorted(VARIANTS.items(), key=lambda v: -len(v[1]))}
    lines = ["variant      taper  forward dips   back dips   thrusts at [cm]"]
    histories = {}
    for name in VARIANTS:
        history = histories[name] = History(Run(futures[name].result()))
        (forward, spread), (back, back_spread) = history.dips()
        thrusts = " ".join(f"{100 * t.shortening:.1f}" for t in history.thrusts)
        lines.append(f"{name:12} {history.moments[-1].taper:5.1f} {forward:6.1f} +- {spread:3.1f} "
                     f"{back:5.1f} +- {back_spread:3.1f}   {thrusts}")
    tapers = [histories[name].moments[-1].taper for name in VARIANTS if name.startswith("seed")]
    lines.append(f"taper over the seeds {np.mean(tapers):.1f} +- {np.std(tapers, ddof=1):.1f}; expected 4 to 8, forward "
                 "dips 20 to 30, the same at half the speed")
    return lines, histories


def draw(axes, histories):
    for name, history in histories.items():
        axes.plot([100 * m.shortening for m in history.moments], [m.taper for m in history.moments], label=name)
    axes.axhspan(4, 8, color="#dddddd")
    axes.set(xlabel="shortening [cm]", ylabel="taper [degrees]", title="Sandbox: taper (grey: 4 to 8)", ylim=(0, 35))
    axes.legend()
