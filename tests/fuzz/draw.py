"""Random numbers of a case: each is a hash of the seed, the case and what it is for, so that none depends on how many
were drawn before it."""

import hashlib
import math


class Draw:
    def __init__(self, *names):
        self.names = names

    def part(self, *names):
        return Draw(*self.names, *names)

    def whole(self, purpose, least, most):
        """A whole number, least <= n <= most."""
        text = "/".join(map(str, (*self.names, purpose)))
        number = int.from_bytes(hashlib.blake2b(text.encode(), digest_size=16).digest(), "little")
        return least + number % (most - least + 1)

    def real(self, purpose, least=0.0, most=1.0):
        return least + (most - least) * self.whole(purpose, 0, 2**53) / 2**53

    def log(self, purpose, least, most):
        return math.exp(self.real(purpose, math.log(least), math.log(most)))

    def chance(self, purpose, probability):
        return self.real(purpose) < probability

    def one(self, purpose, values):
        return values[self.whole(purpose, 0, len(values) - 1)]

    def weighted(self, purpose, weights):
        """A key of {key: weight}."""
        at = self.real(purpose) * sum(weights.values())
        for key, weight in weights.items():
            at -= weight
            if at < 0:
                return key
        return key

    def vector(self, purpose, length, dim):
        """Of this length, in a random direction."""
        parts = [self.real(f"{purpose}/{a}", -1, 1) for a in range(dim)]
        norm = math.sqrt(sum(x * x for x in parts)) or 1.0
        return [length * x / norm for x in parts]

    def shuffled(self, purpose, values):
        return sorted(values, key=lambda v: self.whole(f"{purpose}/{v}", 0, 2**63))
