# SPDX-License-Identifier: CC0-1.0
"""Recursive regression in exact binary64: 08, section 6.3, as 09b, section 4 and 09d, section 4 use it too."""
import math


def divide(a, b):
    """a / b of IEEE 754."""
    if b:
        return a / b
    if a == 0 or a != a or b != b:
        return math.nan
    return math.copysign(math.inf, a) * math.copysign(1.0, b)


def root(x):
    """Square root of IEEE 754."""
    return math.sqrt(x) if x >= 0 else math.nan


class Filter:
    """Weights u and a symmetric matrix, with a forgetting factor."""

    def __init__(self, u, diagonal, forget):
        self.u, self.diagonal, self.forget, self.inverse = list(u), diagonal, forget, 1 / forget
        self._reset()

    def _reset(self):
        n = len(self.u)
        self.matrix = [[self.diagonal if i == j else 0.0 for j in range(n)] for i in range(n)]

    def y(self, z):
        t = 0.0
        for a, b in zip(self.u, z):
            t += a * b
        return t

    def learn(self, z, error, d):
        """error: the value less y(z); d: what the denominator begins with."""
        gain = []
        for line in self.matrix:
            g = 0.0
            for p, x in zip(line, z):
                g += p * x
            gain.append(g)
        for x, g in zip(z, gain):
            d += x * g
        s = divide(1.0, d)
        self.u = [a + g * s * error for a, g in zip(self.u, gain)]
        inverse, trace = self.inverse, 0.0
        self.matrix = [[(p - a * b * s) * inverse for p, b in zip(line, gain)]
                       for line, a in zip(self.matrix, gain)]
        for i, line in enumerate(self.matrix):
            trace += line[i]
        if not trace < 1e12:
            self._reset()
