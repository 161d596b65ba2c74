"""Angles of friction from runs of shear_sand.toml and shear_floor.toml."""

import numpy as np

# Sand on sand and on the floor, at the peak and after it [degrees]: what gallery.sh measured.
MEASURED = (33.2, 27.9), (15.6, 15.6)


class ShearBox:
    """Tangential over normal force on the plane over which the layer slides, or on the lid where it shears inside:
    there the load is least. Both smoothed over a tenth of a layer's height of sliding for the peak; what is left
    after it is the mean over the last third of the way."""

    def __init__(self, run):
        begin, velocity = run.drive("bottom")
        on_floor = run.wall("bottom")["material"] != run.wall("lid")["material"]
        name = "bottom" if on_floor else "lid"
        table = run.series
        moving = table["t"] > begin
        self.name = "floor" if on_floor else "sand"
        self.way = velocity[0] * (table["t"][moving] - begin)
        self.height = table["lid_z"][moving][0] if moving.any() else np.nan
        self.lift = table["lid_z"][moving] - self.height
        self.ratio = np.abs(table[f"{name}_fx"][moving] / np.where(table[f"{name}_fz"][moving] == 0, np.nan,
                                                                   table[f"{name}_fz"][moving]))
        self.smoothed = running_mean(self.ratio, self.way, 0.03 * self.height)
        early = self.way < 0.5 * self.way[-1]
        self.peak = np.degrees(np.arctan(np.nanmax(self.smoothed[early])))
        late = self.way > 2 / 3 * self.way[-1]
        self.residual = np.degrees(np.arctan(np.nanmean(self.ratio[late])))
        self.noise = np.degrees(np.nanstd(self.smoothed[late]))

    def text(self):
        return (f"{self.name}: friction angle {self.peak:.1f} deg at its peak, {self.residual:.1f} deg after "
                f"{self.way[-1] / self.height:.2f} layer heights (scatter {self.noise:.1f}), layer "
                f"{self.height * 1e3:.1f} mm, rises by {self.lift[-1] * 1e3:.2f} mm")


def running_mean(values, way, window):
    """Over the points within `window` of way around each."""
    total = np.concatenate([[0], np.cumsum(np.nan_to_num(values))])
    first = np.searchsorted(way, way - 0.5 * window)
    last = np.searchsorted(way, way + 0.5 * window, side="right")
    return (total[last] - total[first]) / np.maximum(1, last - first)


def angles(boxes):
    """(peak, residual) of the sand and of the floor; None where there is no such run."""
    found = {box.name: (box.peak, box.residual) for box in boxes}
    return found.get("sand"), found.get("floor")
