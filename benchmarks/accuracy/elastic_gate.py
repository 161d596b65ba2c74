"""Dam break through an elastic gate (Antoci, Gallati & Sibilla 2007): how far its free end moves at most.

SPHinXsys's own record of its test of the same gate, 2 particles across, is 45.7 mm outwards and 20.2 mm upwards
(its regression test, GateTipDisplacement: the largest positions 0.395 and 0.02107 m
of a particle that starts at 0.3493 and 0.0009 m). Two rows of particles have 1 - 1/2^2 of the plate's second moment: with
three quarters of the modulus this gate comes to 43.6 mm outwards and 17.5 mm upwards, 4 across.
"""

SCENE = "elastic_gate.toml"
SIZES = (2, 4, 6)  # particles across the gate
ERROR = "moves outwards / SPHinXsys's"
OUTWARDS, UPWARDS = 0.0457, 0.0202
FORMULATIONS = {"default": ()}


def settings(n):
    dx = 0.005 / n
    end = round(0.079 / dx) * dx
    return (f"start.spacing={dx!r}", f"start.region.4.upper=[0.105, {end!r}]", f"start.region.5.lower=[0.1, {end!r}]",
            f"monitor.end.nearest_to=[{0.105 - dx / 2!r}, {dx / 2!r}]", "time.until=0.2")


def measure(run):
    series = run.series()
    out = series["end_x"].max() - series["end_x"][0]
    return {ERROR: abs(out / OUTWARDS - 1), "outwards [mm]": 1e3 * out, "upwards [mm]": 1e3 * (series["end_y"].max() - series["end_y"][0])}
