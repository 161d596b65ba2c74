"""What blasts from a point or a small ball into a cold gas are measured against."""

import numpy as np
from scipy.integrate import solve_ivp

GAMMA = 1.4
COLD = 1e-5  # pressure of the gas around, density 1, energy 1
SPHERE = {2: 2 * np.pi, 3: 4 * np.pi}


def sedov(dim):
    """Of the similarity solution (Sedov 1959): xi of R = xi (E t^2 / rho)^(1 / (D + 2)), kinetic over total energy,
    and sum m (r^2 - r_0^2) over rho R^(D + 2), by which the radius of a blast is found that no width of a shock blurs."""
    g, start = GAMMA, 0.02

    def slopes(x, y):
        v, rho, p = y
        matrix = np.array([[rho, v - x, 0], [v - x, 0, 1 / rho], [0, -(v - x) * g / rho, (v - x) / p]])
        return np.linalg.solve(matrix, -np.array([rho * (dim - 1) * v / x, -0.5 * dim * v, -dim]))

    jump = [2 / (g + 1), (g + 1) / (g - 1), 2 / (g + 1)]
    solution = solve_ivp(slopes, (1, start), jump, method="LSODA", rtol=1e-9, atol=1e-14, dense_output=True)
    x = np.linspace(start, 1, 20001)
    v, rho, p = solution.sol(x)
    kinetic = np.trapz(0.5 * rho * v**2 * x**(dim - 1), x)
    internal = np.trapz(p * x**(dim - 1), x) / (g - 1) + p[0] / (g - 1) * start**dim / dim
    energy = SPHERE[dim] * (kinetic + internal) * (2 / (dim + 2))**2
    moment = SPHERE[dim] * (np.trapz(rho * x**(dim + 1), x) - 1 / (dim + 2))
    return energy**(-1 / (dim + 2)), kinetic / (kinetic + internal), moment


def kinetic_energy(dim, width, time, cells=2000, far=0.6):
    """Of the blast of a Gaussian exp(-r^2 / width^2) of energy, all of it 1: finite volumes in r, second order."""
    faces = np.linspace(0, far, cells + 1)
    middle, area, volume = 0.5 * (faces[1:] + faces[:-1]), faces**(dim - 1), np.diff(faces**dim) / dim
    heat = np.exp(-middle**2 / width**2)
    heat /= SPHERE[dim] * np.sum(heat * volume)
    state = np.array([np.ones(cells), np.zeros(cells), COLD / (GAMMA - 1) + heat])

    def primitive(s):
        u = s[1] / s[0]
        return np.array([s[0], u, np.maximum((GAMMA - 1) * (s[2] - 0.5 * s[1] * u), 1e-12)])

    def flux(w):
        energy = w[2] / (GAMMA - 1) + 0.5 * w[0] * w[1]**2
        return np.array([w[0] * w[1], w[0] * w[1]**2 + w[2], (energy + w[2]) * w[1]]), np.array([w[0], w[0] * w[1], energy])

    def rates(s):
        w = primitive(s)
        wide = np.concatenate([w[:, 1::-1] * np.array([[1], [-1], [1]]), w, w[:, -1:], w[:, -1:]], axis=1)
        below, above = np.diff(wide, axis=1)[:, :-1], np.diff(wide, axis=1)[:, 1:]
        least = np.minimum(np.minimum(2 * abs(below), 2 * abs(above)), 0.5 * abs(below + above))
        slope = np.where(below * above > 0, np.sign(below) * least, 0)
        left, right = (wide[:, 1:-1] + 0.5 * slope)[:, :-1], (wide[:, 1:-1] - 0.5 * slope)[:, 1:]
        (f_l, s_l), (f_r, s_r) = flux(left), flux(right)
        c_l, c_r = (np.sqrt(GAMMA * q[2] / q[0]) for q in (left, right))
        slow, fast = np.minimum(left[1] - c_l, right[1] - c_r), np.maximum(left[1] + c_l, right[1] + c_r)
        f = np.where(slow > 0, f_l, np.where(fast < 0, f_r, (fast * f_l - slow * f_r + slow * fast * (s_r - s_l)) / (fast - slow)))
        rate = -(area[1:] * f[:, 1:] - area[:-1] * f[:, :-1]) / volume
        rate[1] += w[2] * np.diff(area) / volume
        return rate, np.max(abs(w[1]) + np.sqrt(GAMMA * w[2] / w[0]))

    now = 0.0
    while now < time:
        rate, fastest = rates(state)
        dt = min(0.4 * (faces[1] - faces[0]) / fastest, time - now)
        half = state + dt * rate
        state = 0.5 * (state + half + dt * rates(half)[0])
        now += dt
    return SPHERE[dim] * float(np.sum(0.5 * state[1]**2 / state[0] * volume))


def start(n, dim, width):
    """A cold gas at rest, n particles a side of the unit square or cube, and a Gaussian of heat in the middle."""
    axis = (np.arange(n) + 0.5) / n
    x = np.stack([a.ravel() for a in np.meshgrid(*[axis] * dim, indexing="ij")], axis=1)
    heat = np.exp(-np.sum((x - 0.5)**2, axis=1) / width**2)
    mass = n**-dim
    return {"x": x, "v": np.zeros(dim), "rho": 1.0, "mass": mass,
            "u": COLD / (GAMMA - 1) + heat / (np.sum(heat) * mass)}


def settings(n, dim, growth):
    box = f"[{', '.join(['1'] * dim)}]"
    return (f"dimension={dim}", f"start.spacing={1 / n}", f"domain.lower=[{', '.join(['0'] * dim)}]", f"domain.upper={box}",
            f"domain.periodic=[{', '.join(['true'] * dim)}]", f"kernel.largest_growth={growth}")


def measure(run, dim):
    """The radius by the second moment of the mass, its exponent in time, shares of energy, at the last snapshot."""
    xi, share, moment = sedov(dim)
    times, radii = [], []
    shots = run.snapshots()
    n = round(len(shots[-1].mass)**(1 / dim))
    at_start = np.sum(((np.arange(n) + 0.5) / n - 0.5)**2) * dim / n
    for shot in shots:
        if shot.time == 0:
            continue
        gained = np.sum(shot.mass[:, None] * (shot.position - 0.5)**2) - at_start
        times.append(shot.time)
        radii.append((max(gained, 1e-30) / moment)**(1 / (dim + 2)))
    last = shots[-1]
    late = len(times) // 2
    exponent = np.polyfit(np.log(times[late:]), np.log(radii[late:]), 1)[0]
    r = np.sqrt(np.sum((last.position - 0.5)**2, axis=1))
    bins = np.linspace(0, 0.5, n + 1)
    where = np.digitize(r, bins)
    count = np.bincount(where, minlength=n + 2)[1:n + 1]
    mean = np.bincount(where, weights=last.density, minlength=n + 2)[1:n + 1] / np.maximum(count, 1)
    front = bins[np.nonzero((mean > 0.5 * (1 + mean.max())) & (count > 0))[0][-1] + 1]
    series = run.series()
    energy = series["energy_kinetic"] + series["energy_internal"]
    kinetic = last.kinetic
    worst = max(abs(radii[-1] / (xi * last.time**(2 / (dim + 2))) - 1), abs(kinetic / energy[-1] / share - 1))
    return {"worst": worst, "radius": radii[-1] / (xi * last.time**(2 / (dim + 2))) - 1, "exponent": exponent,
            "front": front / (xi * last.time**(2 / (dim + 2))) - 1, "KE/E": kinetic / energy[-1] / share - 1,
            "KE": kinetic, "peak density": mean.max(), "energy": energy[-1] / energy[0] - 1}
