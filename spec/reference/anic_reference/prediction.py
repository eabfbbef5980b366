# SPDX-License-Identifier: CC0-1.0
"""Chapter 09, sections 2 to 6: coefficients from residuals, in exact binary32, a level of vertices at a time.

The last axis of each array counts vertices; every element goes through the operations of the text in their order."""
import numpy as np

F = np.float32
SCHEDULES = ((), (1, 4, 12, 36, 108, 324),
             (0, 1, 2, 3, 5, 8, 12, 18, 26, 36, 50, 70, 100, 140, 200, 280, 400, 560))
RENEWALS = (1, 3, 7, 9)
RIDGE = {m: F(1e-5 / m) for m in (8, 12, 16, 20, 24)}
OMEGA = np.array([0x3F800000, 0x3F9837F0, 0x3FB504F3, 0x3FD744FD], np.uint32).view(F)
SIXTH, REACH = np.array([0x3E2AAAAB, 0x3E8F5C29], np.uint32).view(F)


def omega_of(byte):
    return F(OMEGA[byte % 4] * F(2.0 ** (byte // 4 - 32)))


def ordered_sum(terms):
    """One accumulator from 0 to which terms[0], terms[1], .. are added."""
    total = np.zeros(terms.shape[1:], F)
    for t in terms:
        total = total + t
    return total


def limit(x):
    big = F(2 ** 20)
    return np.where(x < big, np.where(x > -big, x, -big), big)


def finite(x):
    return np.where(np.isfinite(x), x, F(0))


class Factor:
    """Section 3. `a` is [m, m, vertices], of which the part with row >= column counts."""

    def __init__(self, a, e):
        a = a.copy()
        self.m = m = len(a)
        for j in range(m):
            a[j, j] = a[j, j] + e
        self.inverse = np.zeros(a.shape[1:], F)
        for j in range(m):
            d = a[j, j]
            self.inverse[j] = F(1) / d
            a[j + 1:, j] = a[j + 1:, j] * self.inverse[j]
            t = a[j + 1:, j] * d                                # t[j] of each later row
            a[j + 1:, j + 1:] -= a[j + 1:, j][:, None] * t      # only row >= column is used
        self.lower = a

    def solve(self, b):
        x, lower = b.copy(), self.lower
        for p in range(self.m):
            x[p + 1:] = x[p + 1:] - lower[p + 1:, p] * x[p]
        x = x * self.inverse
        for i in range(self.m - 1, -1, -1):
            for p in range(i + 1, self.m):
                x[i] = x[i] - lower[p, i] * x[p]
        return x


class Prior:
    """Sections 4 and 5.1, of the vertices of a level."""

    def __init__(self, pose, neighbours, ranks, radius, alike):
        """pose: float32 [rank, axis], with one more row for none; neighbours: [vertex, m], the last row for none."""
        none = len(pose) - 1
        self.m = neighbours.shape[1]
        self.valid = (neighbours != none).T.astype(F)
        self.radius, self.alike = F(radius), F(alike)
        x = (pose[neighbours] - pose[ranks][:, None, :]).transpose(1, 2, 0)
        x = np.where(self.valid[:, None, :] > 0, x, F(0))
        l = np.sqrt(x[:, 0] * x[:, 0] + x[:, 1] * x[:, 1] + x[:, 2] * x[:, 2])
        length, self.number = ordered_sum(l), ordered_sum(self.valid)
        scale = np.where(length > 0, self.number / length, F(1))
        self.x, self.l = x * scale, l * scale
        self.i, self.reach = F(1) / self.radius, REACH / self.radius

    def phi(self, z):
        t = z * self.i
        u = F(1) - t
        u = np.where(u > 0, u, F(0))
        w = u * u
        return (w * w) * (F(4) * t + F(1))

    def psi(self, q):
        z = np.sqrt(q) * self.reach
        u = F(1) + z
        u2 = u * u
        u4 = u2 * u2
        u8 = u4 * u4
        return (F(1) + F(16) * z) / (u8 * u8)

    def weights(self, own, between):
        """w0 by the near parts: own [m, vertices], and between(a) -> [a + 1, vertices] of a and 0 .. a."""
        m, x, valid = self.m, self.x, self.valid
        b = valid * (F(100) + F(10) * own)
        matrix = np.zeros((m, m) + valid.shape[1:], F)
        for a in range(m):
            k = slice(0, a + 1)
            dot = x[a, 0] * x[k, 0] + x[a, 1] * x[k, 1] + x[a, 2] * x[k, 2]
            matrix[a, k] = (valid[a] * valid[k]) * ((F(100) + F(10) * dot) + F(10) * between(a))
        self.matrix = matrix
        return finite(Factor(matrix, F(0.02)).solve(b))

    def _squares(self, a):
        e = self.x[a] - self.x[:a + 1]
        return e[:, 0] * e[:, 0] + e[:, 1] * e[:, 1] + e[:, 2] * e[:, 2]

    def first(self):
        """w0 of section 4."""
        return self.weights(self.phi(self.l), lambda a: self.phi(np.sqrt(self._squares(a))))

    def renewed(self, around, at):
        """w0 of section 5.1; samples: around [s, m, vertices] of the neighbours, at [s, vertices]."""
        d = np.zeros(self.valid.shape, F)
        for y, own in zip(around, at):
            e = y - own
            d = d + e * e
        mean = ordered_sum(self.valid * np.sqrt(d)) / self.number
        spread = mean * mean
        rest = spread - SIXTH * F(len(at))
        v = (self.alike * self.alike / F(64)) * np.where(rest > 0, rest / (spread * spread), F(0))

        def between(a):
            total = np.zeros((a + 1,) + self.number.shape, F)
            for y in around:
                e = y[a] - y[:a + 1]
                total = total + e * e
            return self.psi(self._squares(a) + v * total)
        x = self.x
        own = self.psi(x[:, 0] * x[:, 0] + x[:, 1] * x[:, 1] + x[:, 2] * x[:, 2] + v * d)
        return self.weights(own, between)


def refits_of(schedule, alike, components):
    """Components after which the weights are refitted, and those before whose refits the prior is renewed."""
    renewals = {j for j in RENEWALS if alike and j < components - 1}
    return {j for j in SCHEDULES[schedule] if j < components - 1} | renewals, renewals


def reconstruct(pose, levels, neighbours, residuals, omegas, m, radius, schedule, alike):
    """Section 6. pose: [rank][axis]; residuals: [component, rank, channel]. Returns y, float32, of the same shape."""
    components, n, channels = residuals.shape
    lines = np.array([list(line) + [n] * (m - len(line)) for line in neighbours], np.int64).reshape(n, m)
    pose = np.concatenate((np.array(pose, F).reshape(n, 3), np.zeros((1, 3), F)))
    y = np.zeros((components, channels, n + 1), F)
    refits, renewals = refits_of(schedule, alike, components)
    last, start = max(refits, default=-1), 0
    for count in levels:
        ranks, around = slice(start, start + count), lines[start:start + count]
        prior = Prior(pose, around, ranks, radius, alike)
        w0 = prior.first()
        w = w0
        a, g = np.zeros((m, m, count), F), np.zeros((m, count), F)
        for j in range(components):
            omega = omega_of(omegas[j])
            for k in range(channels):
                x = y[j, k][around].T
                p, p0 = np.zeros(count, F), np.zeros(count, F)
                for i in range(m):
                    p = p + w[i] * x[i]
                    p0 = p0 + w0[i] * x[i]
                u = limit(p) * F(64)
                u = (u + F(12582912)) - F(12582912)
                value = limit(u * F(1 / 64) + residuals[j, ranks, k].astype(F))
                y[j, k, ranks] = value
                if j <= last:
                    e = value - p0
                    z = x * omega
                    a += z[:, None] * x[None]
                    g += z * e
            if j in renewals:
                before, samples = w0, y[:j + 1].reshape((j + 1) * channels, n + 1)
                w0 = prior.renewed(samples[:, around].transpose(0, 2, 1), samples[:, ranks])
                change = before - w0
                for b in range(m):
                    for i in range(m):
                        g[i] = g[i] + a[max(i, b), min(i, b)] * change[b]
            if j in refits:
                trace = ordered_sum(a[range(m), range(m)])
                d = Factor(a, F(0.3) + trace * RIDGE[m]).solve(g)
                w = finite(w0 + d)
        start += count
    return y[:, :, :n].transpose(0, 2, 1)
