#!/usr/bin/python3
"""What a particle takes at the peak of a run, lists made anew and files written: growth from a smaller scene to a larger one;
and that `peperite check` says so.

    test_memory.py --programs build/bin --source .
"""
import json
import re

from runner import Case, main

PROGRAM = 28e6  # bytes without particles
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
    def bytes_a_particle(self, *scenes):
        runs = []
        for number, (scene, settings) in enumerate(scenes):
            words = [word for setting in settings for word in ("--set", setting)]
            self.run_of.run(1, "peperite", "run", scene, "--out", f"{scene.stem}_{number}", "--steps", 8, *words)
            runs.append(json.loads((self.folder / f"{scene.stem}_{number}/perf.json").read_text()))
            said = self.run_of.run(1, "peperite", "check", scene, *words).out
            forecast = 1e6 * float(re.search(r"^memory: about (\S+) MB", said, re.M)[1])
            self.assertAlmostEqual((forecast + PROGRAM) / runs[-1]["peak_rank_bytes"], 1, delta=0.15)
        small, large = runs
        self.assertGreater(large["rebuilds"], 2)
        return (large["peak_rank_bytes"] - small["peak_rank_bytes"]) / (large["particles"] - small["particles"])

    def test_grains(self):
        scenes = []
        for edge in (49.75, 79.6):
            scenes.append((self.folder / f"grains_{edge}.toml", ()))
            scenes[-1][0].write_text(GRAINS.format(edge=edge))
        self.assertLess(self.bytes_a_particle(*scenes), 560)

    def test_fluid(self):
        scene = self.source / "benchmarks/scenes/dam_break.toml"

        def settings(spacing):
            wall = 3 * spacing
            return (f"start.spacing={spacing}", f"start.lower={[-wall] * 3}",
                    f"start.upper={[2.001 + wall, 0.6105 + wall, 0.7]}", "decomposition.rebuild_every=3",
                    'precision="mixed"')

        self.assertLess(self.bytes_a_particle((scene, settings(0.0145)), (scene, settings(0.01))), 750)


if __name__ == "__main__":
    main()
