"""Pictures of any run: flat of two dimensions, solid of three, melts of slow flow on a grid."""

import importlib

from ..errors import Error
from .command import drawn


def module_for(*scenes):
    """The one that draws all of them."""
    names = {"melts" if any(group["kind"] == "melt" for group in scene["group"]) else
             "flat" if scene["dimension"] == 2 else "solid" for scene in scenes}
    if len(names) > 1:
        raise Error("runs of different kinds: draw one after the other")
    return importlib.import_module(f".{names.pop()}", __name__)


def draw_run(run, out=None, options=()):
    """Draws a run into `out` or into its folder; paths of the pictures. `options`: those of the module's command line."""
    words = [str(run.folder), *(["--out", str(out)] if out else [])]
    for name, value in dict(options).items():
        words += [f"--{name}"] if value is True else [f"--{name}={value}"]
    return list(drawn(module_for(run.scene), words))
