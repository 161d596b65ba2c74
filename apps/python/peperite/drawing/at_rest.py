"""Pressure of the scene's layers of fluid at rest: dp/dd = (rho(p) - background_density) g along the depth d, with each layer's
equation of state."""

import numpy as np


def density_of(group, surface_pressure):
    """rho(p) of a group of the resolved scene, p above the surface pressure [Pa]; bubbly: Ida eqs. (13) to (15)."""
    rho0, modulus = group["density"], group["bulk_modulus"]

    def liquid(p):
        return rho0 * (1 + (p + surface_pressure) / modulus)

    def bubbly(p):
        absolute, m = max(p + surface_pressure, 0), group["gas_content"]
        dissolved = (absolute / group["solubility_pressure"]) ** group["solubility_exponent"]
        if m <= dissolved:
            return liquid(p)
        free, gas = (m - dissolved) / (1 + m), absolute / group["gas_rt"]
        return liquid(p) * gas / (gas + free * (liquid(p) - gas)) if gas > 0 else 0.0

    return bubbly if group.get("eos") == "bubbly" else liquid


def layers_of(scene, surface, filling):
    """Groups and heights of their tops, from the surface downwards. A scene that names no layers has one, of the group of the
    number `filling`, up to `surface`."""
    groups = {g["name"]: g for g in scene["group"]}
    named = [(groups[layer["group"]], layer["top"]) for layer in scene["start"].get("layer", [])]
    return named or [(scene["group"][filling], surface)]


def height_of(scene, position):
    """Against gravity [m]; None without gravity."""
    gravity = np.array(scene["domain"].get("gravity", [0]))
    size = np.linalg.norm(gravity)
    return None if size == 0 else -position @ (gravity / size)


def pressure_at_rest(scene, position, surface, filling=0):
    """Above the surface pressure [Pa], at each position; None where nothing can be at rest so: without gravity, or of
    ideal gases. Above the highest layer it goes on as a straight line."""
    height = height_of(scene, position)
    layers = layers_of(scene, surface, filling)
    if height is None or not len(height) or any("bulk_modulus" not in group for group, _ in layers):
        return None
    g = np.linalg.norm(scene["domain"]["gravity"])
    atmosphere, around = (scene["domain"].get(key, 0) for key in ("surface_pressure", "background_density"))

    def weight(group):
        density = density_of(group, atmosphere)
        return lambda p: density(p) - around
    top, first = layers[0][1], weight(layers[0][0])
    above = max(height.max() - top, 0) + 1
    heights, pressures = [np.array([top + above])], [np.array([-first(0) * g * above])]
    for k, (group, upper) in enumerate(layers):
        lower = layers[k + 1][1] if k + 1 < len(layers) else min(height.min(), upper)
        down, pressure = integrate(weight(group), g, pressures[-1][-1] if k else 0.0, upper - lower)
        heights.append(upper - down)
        pressures.append(pressure)
    return np.interp(-height, -np.concatenate(heights), np.concatenate(pressures))


def integrate(density, g, top, depth, steps=2000):
    """Depths and pressures from `top` down, by the classical Runge-Kutta rule."""
    h, pressure = depth / steps, [top]
    for _ in range(steps):
        p = pressure[-1]
        a = g * density(p)
        b = g * density(p + 0.5 * h * a)
        c = g * density(p + 0.5 * h * b)
        pressure.append(p + h / 6 * (a + 2 * b + 2 * c + g * density(p + h * c)))
    return np.linspace(0, depth, steps + 1), np.array(pressure)
