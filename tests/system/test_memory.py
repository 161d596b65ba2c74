#!/usr/bin/python3
"""What a particle takes at the peak of a run, lists made anew and files written: growth from a smaller scene to a larger one;
and that `peperite check` says so.

    test_memory.py --programs build/bin --source .
"""
import json
import re

from runner import Case, main

GRAINS = """
dimension = 3

[domain]
lower = [0, 0, 0]
upper = ["{edge} mm", "{edge} mm", "{edge} mm"]
periodic = [true, true, false]
gravity = [0, 0, -9.81]

[contact]
law = "linear"

[[group]]
name = "sand"
kind = "grain"
density = 2500
diameter = "1 mm"
normal_stiffness = "1000 N/m"
friction = 0.5
restitution = 0.5

[[wall]]
name = "floor"
material = "sand"
point = [0, 0, 0]
normal = [0, 0, 1]

[start]
spacing = "0.995 mm"

[[start.region]]
group = "sand"

[time]
dt = "4 us"
steps = 8

[decomposition]
rebuild_every = 3
"""


class Memory(Case):
    def assert_takes(self, at_most, *scenes):
        """Bytes that a particle more takes, from the smaller to the larger scene."""
        particles, peaks, forecasts = [], [], []
        for number, (scene, settings) in enumerate(scenes):
            out, words = f"{scene.stem}_{number}", [word for setting in settings for word in ("--set", setting)]
            self.run_of.run(1, "peperite", "run", scene, "--out", out, "--steps", 8, *words)
            perf = json.loads((self.folder / out / "perf.json").read_text())
            self.assertGreater(perf["rebuilds"], 2)
            said = self.run_of.run(1, "peperite", "check", scene, *words).out
            particles.append(perf["particles"])
            peaks.append(perf["peak_rank_bytes"])
            forecasts.append(1e6 * float(re.search(r"^memory: about (\S+) MB", said, re.M)[1]))
        more, taken, forecast = (last - first for first, last in (particles, peaks, forecasts))
        self.assertLess(taken / more, at_most)
        self.assertAlmostEqual(forecast / taken, 1, delta=0.25)

    def test_grains(self):
        scenes = []
        for edge in (49.75, 79.6):
            scenes.append((self.folder / f"grains_{edge}.toml", ()))
            scenes[-1][0].write_text(GRAINS.format(edge=edge))
        self.assert_takes(650, *scenes)

    def test_fluid(self):
        scene = self.source / "benchmarks/scenes/dam_break.toml"

        def settings(spacing):
            wall = 3 * spacing
            return (f"start.spacing={spacing}", f"start.lower={[-wall] * 3}",
                    f"start.upper={[2.001 + wall, 0.6105 + wall, 0.7]}", "decomposition.rebuild_every=3",
                    'precision="mixed"')

        self.assert_takes(760, (scene, settings(0.0145)), (scene, settings(0.008)))


if __name__ == "__main__":
    main()
