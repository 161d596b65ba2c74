"""Matter in pieces that move as one, with gaps between them that close: nothing near has gone apart until they meet."""

import math


class Pieces:
    """Blocks of cells of a lattice, each with a velocity of its own, some of them empty."""

    def __init__(self, d, dim, speed):
        self.d, self.dim, self.speed = d, dim, speed
        self.width = [d.whole(f"width/{a}", 2, 8) for a in range(dim)]
        self.empty = d.one("empty", [0.0, 0.3, 0.6])

    def velocity(self, place):
        """Of the piece that has this place, in cells; None where it is empty."""
        piece = self.d.part("piece", *(math.floor(x / w) for x, w in zip(place, self.width)))
        if piece.chance("empty", self.empty):
            return None
        return piece.vector("velocity", self.speed * piece.real("fast"), self.dim)
