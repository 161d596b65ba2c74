"""One page of a run: report.html in its folder, which needs no network and nothing beside it.

    python3 -m peperite.report DIR [DIR ...]
"""

import base64
import contextlib
import re
import tomllib
import warnings
from pathlib import Path

import jinja2
import numpy as np
from markupsafe import Markup

from ..drawing import draw_run
from ..errors import Error
from ..run import Run

HERE = Path(__file__).resolve().parent
CHARTS = (Path("/usr/share/javascript/dygraphs"), HERE / "dygraphs")  # of Debian's libjs-dygraphs
MOST_POINTS = 2000  # of a curve; of longer ones the extremes between


def data_uri(path):
    return "data:image/png;base64," + base64.b64encode(Path(path).read_bytes()).decode()


def quantity_of(column, kind):
    """What the columns of a chart have in common: components along x, y, z; what a budget has and what of it came in; of a line of
    gauges one quantity at all its points."""
    if kind == "gauge" and column[0].isdigit():
        return column.partition("_")[2]
    first = column.split("_")[0]
    if kind == "contacts":  # whose z is a number of neighbours
        return column
    if first in ("x", "y", "z"):
        return "position"
    return first[0] if len(first) == 2 and first[1] in "xyz" else first


def monitors_of(scene, series):
    """Columns by monitor, whose names may hold underscores themselves; what no monitor has by its first word."""
    names = sorted((m["name"] for m in scene.get("monitor", []) if "name" in m), key=len, reverse=True)
    found = {}
    for column in series:
        if column in ("step", "t"):
            continue
        monitor = next((name for name in names if column.startswith(name + "_")), column.partition("_")[0])
        found.setdefault(monitor, []).append(column)
    return found


def charts_of(scene, series):
    """(monitor, title, columns) of each chart."""
    kinds = {m.get("name"): m["kind"] for m in scene.get("monitor", [])}
    for monitor, columns in monitors_of(scene, series).items():
        if kinds.get(monitor) in ("energy", "momentum"):
            yield monitor, monitor, columns
            continue
        charts = {}
        for column in columns:
            charts.setdefault(quantity_of(column[len(monitor) + 1:], kinds.get(monitor)), []).append(column)
        for quantity, chosen in charts.items():
            yield monitor, f"{monitor}: {quantity}", chosen


def thinned(time, columns):
    """Rows that show every extreme of every column, at most MOST_POINTS or so of each."""
    n = len(time)
    if n <= MOST_POINTS:
        return np.arange(n)
    edges = np.linspace(0, n, MOST_POINTS // 2 + 1).astype(int)
    rows = {0, n - 1}
    for values in columns:
        low_values, high_values = (np.where(np.isfinite(values), values, other) for other in (np.inf, -np.inf))
        for low, high in zip(edges, edges[1:]):
            rows |= {low + int(np.argmin(low_values[low:high])), low + int(np.argmax(high_values[low:high]))}
        rows |= set(np.flatnonzero(np.diff(np.isfinite(values))) + 1)  # where a gap begins or ends
    return np.array(sorted(rows))


def curves_of(run):
    """What report.js draws: title, labels and rows of each chart."""
    try:
        series = run.series
    except Error:
        return []
    charts = []
    for monitor, title, columns in charts_of(run.scene, series):
        values = [series[name] for name in columns]
        if not any(np.isfinite(v).any() for v in values):
            continue
        rows = thinned(series["t"], values)
        table = np.array([series["t"][rows], *(v[rows] for v in values)]).T
        units = {series.unit(name) for name in columns} - {""}
        unit = f" ({units.pop()})" if len(units) == 1 else ""
        charts.append({"title": title + unit, "labels": ["t", *(name[len(monitor) + 1:] for name in columns)],
                       "rows": [[x if np.isfinite(x) else None for x in row] for row in table.tolist()]})
    return charts


def chart_code():
    """The library that draws the curves, and what couples their zoom; or None where it is not installed."""
    for folder in CHARTS:
        files = [folder / name for name in ("dygraph.min.js", "src-es5/extras/synchronizer.js", "dygraph.min.css")]
        if all(path.is_file() for path in files):
            code, couple, style = (path.read_text() for path in files)
            return {"script": Markup(code + "\n" + couple), "style": Markup(re.sub(r"/\*#.*?\*/", "", style))}
    return None


def timings_of(perf):
    """Phase, seconds of a rank on average and at most, share; longest first."""
    seconds = perf.get("seconds", {})
    whole = sum(phase["mean"] for phase in seconds.values()) or 1.0
    rows = [{"name": name, "mean": phase["mean"], "max": phase["max"], "share": phase["mean"] / whole,
             "computation": phase["computation"]} for name, phase in seconds.items() if phase["max"] > 0]
    return sorted(rows, key=lambda row: -row["mean"])


def number(value, form):
    return "no" if value is None else format(value, form)  # of nothing there is no mean


def step_of_crash(run):
    """Of the state that a run left when it stopped at what none may be; -1 without one."""
    return max((int(path.stem.rpartition("_")[2]) for path in (run.folder / "crash").glob("snapshot_*.h5")
                if path.stem.rpartition("_")[2].isdigit()), default=-1)


def facts_of(run):
    """Label and text of what a run was; without its end what is known."""
    perf, last = run.perf, run[-1] if run.files else None
    if (stopped := step_of_crash(run)) > (perf["end"]["step"] if perf else -1) and not run.goes_on:
        return [("state", f"stopped by an error in step {stopped}: see crash/"),
                ("last snapshot", f"{last.time:g} s, step {last.step}" if last else "none")]
    if perf is None or run.goes_on or (last and last.step > perf["end"]["step"]):
        return [("state", "not finished"), ("last snapshot", f"{last.time:g} s, step {last.step}" if last else "none")]
    end, build, wanted = perf["end"], perf["build"], run.scene["time"]
    done = end["time"] >= wanted.get("until", np.inf) or end["step"] >= wanted.get("steps", np.inf)
    return [("state", "finished" if done else "stopped before its end; `peperite resume` goes on"),
            ("fingerprint", perf["fingerprint"]), ("end", f"{end['time']:g} s, step {end['step']}"),
            ("particles", f"{perf['particles']:,}".replace(",", " ")), ("ranks", perf["ranks"]),
            ("precision, formulation", f"{perf['precision']}, {perf['formulation']}"),
            ("elapsed", f"{perf['wall_seconds']:.1f} s, of it {perf['setup_seconds']:.1f} s before the first step"),
            ("particle steps", f"{number(perf['particle_steps_per_second'], '.3g')} a second"),
            ("imbalance", f"{number(perf['imbalance'], '.3f')} (largest over mean of the ranks)"),
            ("lists", f"{perf['rebuilds']} times, {number(perf['neighbours_per_particle'], '.1f')} neighbours a particle"),
            ("balance", f"{perf['balance']['moves']} moves of the cuts, {perf['migrated']} particles migrated"),
            ("memory", f"{perf['peak_rank_bytes'] / 2**20:.0f} MiB a rank at most"),
            ("program", f"peperite {build['version']} {build['git']}, {build['compiler']}, {build['flags'].strip()}, {build['mpi']}")]


def pictures_of(run, work):
    """As many as there can be: a run that has just begun has no series yet."""
    found = []
    with warnings.catch_warnings(), contextlib.suppress(Error):
        warnings.simplefilter("ignore")  # what it has no picture of, it has none of
        for path in draw_run(run, work):
            found.append({"name": path.stem, "uri": data_uri(path)})
    return found


def write(folder, out=None):
    """Writes the report of the run in `folder` to `out` (default: report.html in it); the path."""
    import tempfile
    run = Run(folder)
    path = Path(out) if out else run.folder / "report.html"
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, undefined=jinja2.StrictUndefined)
    scene = run.folder / "scene.toml"
    library = chart_code()
    with tempfile.TemporaryDirectory() as work:
        try:
            facts, timings = facts_of(run), timings_of(run.perf or {})
        except (KeyError, TypeError, ValueError, AttributeError) as error:
            raise Error(f"{run.folder / 'perf.json'}: not the report of a run of this version: {error}") from None
        page = environment.get_template("page.html").render(
            title=run.title, folder=run.folder.resolve().name, facts=facts, pictures=pictures_of(run, work),
            curves=curves_of(run), library=library,
            timings=timings, scene=scene.read_text(encoding="utf-8", errors="replace") if scene.is_file() else "",
            style=Markup((HERE / "page.css").read_text()), script=Markup((HERE / "page.js").read_text()))
    path.write_text(page, encoding="utf-8", errors="replace")
    return path
