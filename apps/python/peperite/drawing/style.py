"""What all pictures share: style, round particles, units that fit the numbers, small files."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection
from matplotlib.colors import to_rgb
from PIL import Image

WALL, SPRAY = "#9a9a9a", "#1b2a49"
GROUPS = ("#f4c89a", "#4fa3a5", "#c97b84", "#a7b957", "#8d7fb8")  # in the order of the scene
RUNS = ("#1b6ca8", "#c8553d", "#3a7d44", "#7a4f9e", "#8a6d1d", "#444444")
LINES = {"white": "#ffffff", "red": "#d62839"}  # over fields
TENSION, COMPRESSION = "#d62839", "#1d3557"

STYLE = {
    "font.size": 10, "axes.titlesize": 11, "axes.titlelocation": "left",
    "axes.edgecolor": "#555555", "axes.linewidth": 0.8, "axes.axisbelow": True, "grid.color": "#dddddd",
    "xtick.color": "#333333", "ytick.color": "#333333", "legend.frameon": False, "figure.dpi": 110,
}
PREFIXES = (("G", 1e9), ("M", 1e6), ("k", 1e3), ("", 1.0), ("m", 1e-3), ("µ", 1e-6))


def nice(value):
    """The largest of 1, 2, 5 times a power of ten that is not above value."""
    if not value > 0:
        return 1.0
    power = 10.0 ** np.floor(np.log10(value))
    return power * max(f for f in (1, 2, 5) if f * power <= value * 1.0000001)


def unit_for(largest, name):
    """The size of the unit in which `largest` is a number from 1 to 1000, and the unit: "kPa". Metres, seconds and what
    is measured in them only become smaller."""
    known = [(prefix, size) for prefix, size in PREFIXES if size <= 1 or name[0] not in "ms"]
    if not (np.isfinite(largest) and largest > 0):
        return 1.0, name
    prefix, size = next((p for p in known if largest >= 0.9995 * p[1]), known[-1])
    return size, prefix + name


def text_with_unit(value, name):
    size, unit = unit_for(abs(value), name)
    return f"{value / size:g} {unit}"


def time_text(time):
    return text_with_unit(float(f"{time:.4g}"), "s")


def clock_text(time, clock):
    """`clock`: name and size of a unit, or None for seconds."""
    return time_text(time) if clock is None else f"{time / clock[1]:.3g} {clock[0]}"


def circles(axes, position, diameter, **options):
    collection = EllipseCollection(diameter, diameter, 0, units="xy", offsets=position,
                                   offset_transform=axes.transData, **options)
    # Of no circles matplotlib draws one.
    return axes.add_collection(collection) if len(position) else collection


def exact_colours(figure):
    """What must not be mixed with anything: our own colours, which may be rare, and the levels of the colour scales."""
    own = np.array([to_rgb(c) for c in (WALL, SPRAY, TENSION, COMPRESSION, *GROUPS, *RUNS)])
    tints = [share * own + 1 - share for share in (1, 0.7, 0.4, 0.3)]
    scales = {m.get_cmap().name: m.get_cmap() for m in figure.findobj(lambda m: isinstance(m, ScalarMappable)) if m.get_array() is not None}
    number = min(48, 144 // max(1, len(scales)))
    levels = [scale(np.linspace(0, 1, min(scale.N, number)))[:, :3] for scale in scales.values()]
    return np.unique((255 * np.concatenate([*tints, *levels])).round().astype(np.uint8), axis=0)


def to_palette(rgb, exact):
    """A picture of few colours, a quarter as large: the exact ones, the most frequent ones, and some for the edges of discs and letters."""
    packed = rgb.astype(np.uint32) @ np.array([1 << 16, 1 << 8, 1], dtype=np.uint32)
    colours, where, count = np.unique(packed, return_inverse=True, return_counts=True)
    channels = np.stack([colours >> 16, colours >> 8 & 255, colours & 255], axis=1).astype(np.uint8)
    order = np.argsort(-count, kind="stable")
    flat = (256 - len(exact)) // 2
    palette, rest = np.concatenate([exact, channels[order[:flat]]]), order[flat:]
    if rest.size:
        others = 256 - len(palette)
        edges = np.repeat(channels[rest], np.ceil(np.sqrt(count[rest])).astype(int), axis=0)
        chosen = Image.fromarray(edges[None]).quantize(others).getpalette()[: 3 * others]
        palette = np.concatenate([palette, np.reshape(chosen, (-1, 3)).astype(np.uint8)])
    distance = sum((channels[:, None, c].astype(np.int32) - palette[None, :, c]) ** 2 for c in range(3))
    nearest = distance.argmin(axis=1)
    picture = Image.fromarray(nearest.astype(np.uint8)[where].reshape(rgb.shape[:2]), mode="P")
    picture.putpalette(palette.tobytes())
    return picture


def save(figure, path):
    canvas = FigureCanvasAgg(figure)  # whatever the backend of who draws
    canvas.draw()
    to_palette(np.asarray(canvas.buffer_rgba())[:, :, :3], exact_colours(figure)).save(path, optimize=True)
    plt.close(figure)
