"""Taylor-Green vortices in 3D, Re 100: the plane flow in a cube of periods, against exp(-8 pi^2 t / Re)."""

import taylor_green
from taylor_green import ERROR, FORMULATIONS, SCENE, measure  # noqa: F401

SIZES = (16, 24, 32)


def settings(n):
    """As thin across the flow as a period can be: three cells of the kernel's radius and the skin."""
    depth = 11 / n
    return (*taylor_green.settings(n), "dimension=3", "domain.lower=[0, 0, 0]", f"domain.upper=[1, 1, {depth}]",
            "domain.periodic=[true, true, true]")
