#!/usr/bin/python3
"""peperite report: one page that a browser without a network shows as it is meant, wide and on a phone.

    test_report.py --programs build/bin --source .
"""
import html.parser
import json
import os
import re
import shutil
import subprocess
import sys
import unittest.mock

import h5py
import numpy as np

from runner import Case, given, main

# What the page says of itself when all of it is drawn; put behind its own scripts.
CHECK = """<script>
window.addEventListener("load", () => setTimeout(() => {
  const ink = (canvas) => canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.some((v) => v > 0);
  document.documentElement.setAttribute("data-seen", JSON.stringify({
    wide: window.innerWidth, needs: document.documentElement.scrollWidth,
    pictures: [...document.images].map((i) => i.complete && i.naturalWidth),
    charts: [...document.querySelectorAll(".chart")].map((c) => [...c.querySelectorAll("canvas")].some(ink)),
    titles: [...document.querySelectorAll("#charts h3")].map((h) => h.textContent),
    smallest: Math.min(...[...document.querySelectorAll("dd, td, th, dt, p")].map((e) => parseFloat(getComputedStyle(e).fontSize))),
  }));
}, 500));
</script>"""


class Links(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.outside = []

    def handle_starttag(self, tag, attrs):
        self.outside += [value for name, value in attrs if name in ("src", "href") and not value.startswith("data:")]


class Report(Case):
    @classmethod
    def setUpClass(cls):
        cls.programs = given.programs
        super().setUpClass()
        sys.path.insert(0, str(cls.source / "apps/python"))
        import peperite.report
        cls.report, cls.series = peperite.report, peperite.Series
        cls.run_of.run(2, "peperite", "run", cls.source / "apps/buoyant_cylinder/gas.toml", "--steps", 40, "--out", "gas",
                       "--set", "output.series_interval=0", "--set", 'title="Bubbles </script> & <b>fire</b>"')
        cls.run_of.run(2, "peperite", "run", cls.source / "tests/scenes/grains_pour.toml", "--steps", 20, "--out", "grains")

    def peperite(self, *words):
        return subprocess.run([self.programs / "peperite", *words], cwd=self.folder, capture_output=True, text=True)

    def page(self, run):
        done = self.peperite("report", run)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, f"{run}/report.html\n", ""))
        return (self.folder / run / "report.html").read_text()

    def seen(self, text, width, height):
        """What a browser shows of it; what it writes on its console is an error."""
        page = self.folder / "page.html"
        page.write_text(text.replace("</body>", CHECK + "</body>"))
        done = subprocess.run(["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", f"--window-size={width},{height}",
                               f"--user-data-dir={self.folder / 'browser'}", "--enable-logging=stderr", "--dump-dom",
                               "--virtual-time-budget=10000", page.as_uri()], capture_output=True, text=True, timeout=120)
        self.assertEqual([line for line in done.stderr.splitlines() if "CONSOLE" in line], [])
        found = re.search(r'data-seen="([^"]*)"', done.stdout)
        self.assertIsNotNone(found, done.stderr[-2000:])
        return json.loads(html.unescape(found[1]))

    def test_in_a_browser(self):
        for run, charts in (("gas", True), ("grains", False)):
            text = self.page(run)
            for width, height in ((1280, 900), (500, 900)):  # Chromium makes no narrower window
                seen = self.seen(text, width, height)
                self.assertEqual(seen["wide"], width)
                self.assertLessEqual(seen["needs"], width, "nothing is wider than the screen")
                self.assertTrue(seen["pictures"] and all(seen["pictures"]), seen)
                self.assertEqual(len(seen["charts"]) > 3, charts)
                self.assertTrue(all(seen["charts"]), "every chart is drawn")
                self.assertGreaterEqual(seen["smallest"], 12, "letters that can be read")

    def test_stands_alone(self):
        text = self.page("gas")
        links = Links()
        links.feed(text)
        self.assertEqual(links.outside, [])
        self.assertNotIn("<b>fire", text)
        self.assertIn("Bubbles &lt;/script&gt; &amp; &lt;b&gt;fire&lt;/b&gt;", text)
        fingerprint = json.loads((self.folder / "gas/perf.json").read_text())["fingerprint"]
        self.assertIn(fingerprint, text)
        self.assertIn("lower = ", text, "the resolved scene is in it")

    def test_curves_are_those_of_the_series(self):
        series = self.series(self.folder / "gas/series.csv")
        curves = json.loads(re.search(r'<script id="curves"[^>]*>(.*?)</script>', self.page("gas"))[1])
        drawn = {}
        for curve in curves:
            monitor, unit = re.fullmatch(r"([^:]*?)(?::.*?)?(?: \((.*)\))?", curve["title"]).groups()
            self.assertEqual({series.unit(f"{monitor}_{label}") for label in curve["labels"][1:]}, {unit or ""})
            table = np.array(curve["rows"], dtype=float)
            self.assertTrue(np.array_equal(table[:, 0], series["t"]))
            for k, label in enumerate(curve["labels"][1:], 1):
                drawn[f"{monitor}_{label}"] = table[:, k]
        known = {name for name in series if np.isfinite(series[name]).any()}  # a group without particles has no mean
        self.assertEqual(set(drawn), known - {"step", "t"})
        for name, values in drawn.items():
            self.assertTrue(np.array_equal(values, series[name], equal_nan=True), name)

    def test_long_series_keep_their_extremes(self):
        time = np.arange(100_000.0)
        spike, flat = np.sin(time / 3000), np.zeros(100_000)
        spike[[777, 54_321]] = 40, -40
        rows = self.report.thinned(time, [spike, flat])
        self.assertLess(len(rows), 5000)
        self.assertTrue({0, 777, 54_321, 99_999} <= set(rows))
        self.assertTrue(np.all(np.diff(rows) > 0))

    def test_a_run_that_is_not_finished(self):
        early = self.folder / "early"
        shutil.copytree(self.folder / "gas", early)
        (early / "perf.json").unlink()
        self.assertIn("not finished", self.page("early"))
        for path in [*early.glob("snapshot_*"), early / "series.csv"]:
            path.unlink()
        self.assertIn("not finished", self.page("early"))

    def test_what_state_a_run_is_in(self):
        on = self.folder / "on"
        shutil.copytree(self.folder / "gas", on)
        fingerprint = json.loads((on / "perf.json").read_text())["fingerprint"]

        def state():
            text = self.page("on")
            return re.search("<dt>state</dt><dd>(.*?)</dd>", text)[1], fingerprint in text
        self.assertEqual(state(), ("finished", True))
        (on / "run.lock").touch()
        self.assertEqual(state(), ("not finished", False), "the fingerprint was that of the part before")
        (on / "run.lock").unlink()
        last = max(on.glob("snapshot_*.h5"))
        with h5py.File(last, "r+") as file:  # as if the machine had stopped it
            file.attrs["scene"] = file.attrs["scene"].replace("\nsteps = 40\n", "\nsteps = 400\n")
        self.assertEqual(state(), ("stopped before its end; `peperite resume` goes on", True))
        shutil.copy(last, on / "snapshot_000000099.h5")
        with h5py.File(on / "snapshot_000000099.h5", "r+") as file:
            file.attrs["step"] = 99
        self.assertEqual(state(), ("not finished", False))
        (on / "crash").mkdir()
        (on / "crash/snapshot_000000120.h5").touch()
        self.assertEqual(state(), ("stopped by an error in step 120: see crash/", False))

    def test_a_module_where_somebody_stands_is_not_run(self):
        for name in ("numpy", "json", "peperite"):
            (self.folder / f"{name}.py").write_text("raise SystemExit(9)")
        try:
            for path in (None, "", ":/nowhere", "/nowhere:"):
                with unittest.mock.patch.dict(os.environ, {} if path is None else {"PYTHONPATH": path}):
                    self.page("gas")
        finally:
            for name in ("numpy", "json", "peperite"):
                (self.folder / f"{name}.py").unlink()

    def test_charts_hold_what_belongs_together(self):
        quantity = self.report.quantity_of
        self.assertEqual([quantity(c, "particle") for c in ("x", "y", "vx", "vy", "p", "rho")],
                         ["position", "position", "v", "v", "p", "rho"])
        self.assertEqual([quantity(c, "contacts") for c in ("z", "number")], ["z", "number"])

    def test_gaps_stay_gaps(self):
        values = np.ones(100_000)
        values[40_000:40_003] = np.nan
        rows = self.report.thinned(np.arange(100_000.0), [values])
        self.assertTrue({40_000, 40_003} <= set(rows))

    def test_a_report_of_a_run_that_is_damaged(self):
        broken = self.folder / "broken"
        for content in (b"", b"{", b"[1]", b"{}", b"\xff", b'{"end": {"time": null}}'):
            shutil.copytree(self.folder / "gas", broken, dirs_exist_ok=True)
            (broken / "perf.json").write_bytes(content)
            done = self.peperite("report", "broken")
            self.assertEqual((done.returncode, done.stdout, len(done.stderr.splitlines())), (2, "", 1), done.stderr)
            self.assertIn("perf.json", done.stderr)

    def test_without_the_library_of_charts(self):
        there = self.report.CHARTS
        try:
            self.report.CHARTS = ()
            text = self.report.write(self.folder / "gas", self.folder / "plain.html").read_text()
        finally:
            self.report.CHARTS = there
        self.assertIn("libjs-dygraphs", text)
        self.assertNotIn("<script", text)

    def test_refusals(self):
        for words, says in ((["report", "nowhere"], "no such folder"), (["report"], "DIR"), (["plot", "nowhere"], "no such folder"),
                            (["plot"], "DIR"), (["plot", "gas", "--draw", "stars"], "stars")):
            done = self.peperite(*words)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn(says, done.stderr)
        done = self.peperite("plot", "grains", "--out", "side")
        self.assertEqual((done.returncode, done.stdout), (0, "side/side.png\n"), done.stderr)


if __name__ == "__main__":
    main()
