# SPDX-License-Identifier: CC0-1.0
"""Chapter 09: the order of the vertices, the prediction of coefficients.

From section 2 on all is exact arithmetic in binary32. The last axis of arrays are the vertices, by rank:
numpy rounds each operation on its own, so vertices side by side are the same as one after the other."""
from types import SimpleNamespace
import numpy as np
from numpy import float32
from .conventions import floor_log2, total

MANY, DENSE = 32, 16    # neighbours: with more, vertices are not removed or looked at; of a dense mesh

def linked(count, triangles):  # The graph that the levels begin with: the set of neighbours of each vertex
    graph = {v: set() for v in range(count)}
    for triangle in triangles:
        for v in triangle:
            graph[v].update(w for w in triangle if w != v)
    return graph

joined = lambda graph: [v for v, others in graph.items() if others]    # H of the text
is_dense = lambda graph: sum(map(len, graph.values())) > DENSE * len(joined(graph))
few = lambda graph, vertices: {w for u in vertices if len(graph[u]) <= MANY for w in graph[u]}

def decoding_order(pose, triangles, regions, wanted, colours):
    """The vertex of each rank, the sizes of the levels, and the ranks of the neighbours of each rank."""
    low, levels, neighbours, graph = pose.min(0), [], {}, linked(len(pose), triangles)
    grid = ((pose - low) >> max(int((pose.max(0) - low).max()).bit_length() - 15, 0)).tolist()
    distance = lambda v, w: sum((a - b) ** 2 for a, b in zip(grid[v], grid[w]))
    morton = lambda v: sum((grid[v][axis] >> i + 5 & 1) << 3 * i + axis for i in range(10)
                           for axis in range(3))
    nearest = lambda v, others: sorted(others, key=lambda w: (distance(v, w), w))
    cost = lambda v: (floor_log2(min(distance(u, v) for u in graph[v])), min(len(graph[v]), 15), v)
    def link_all():
        order, links = sorted(graph, key=lambda v: (regions[v], morton(v), v)), {v: set() for v in graph}
        for v, w in (pair for apart in (1, 2) for pair in zip(order, order[apart:])):
            if regions[v] == regions[w]:
                links[v].add(w)
                links[w].add(v)
        return links
    def select():                                       # The vertices of a level, ascending
        removed, locked = set(), set()
        for v in sorted(joined(graph), key=cost):
            if v not in locked and len(graph[v]) <= MANY:
                removed.add(v)
                locked |= graph[v]
        return sorted(removed)
    apart = {v: {w for w in others if regions[v] == regions[w]} for v, others in graph.items()}
    graph = link_all() if is_dense(graph) else apart
    while joined(graph) or len({regions[v] for v in graph}) < len(graph):
        graph, removed = link_all() if not joined(graph) or is_dense(graph) else graph, select()
        if DENSE * len(removed) < len(joined(graph)):
            graph = link_all()
            removed = select()
        target = {**{v: v for v in graph}, **{v: nearest(v, graph[v])[0] for v in removed}}
        thinner, colour = {v: set() for v in graph if target[v] == v}, {}
        for v, w in ((target[v], target[w]) for v in graph for w in graph[v]):
            thinner[v].update({w} - {v})
        for v in removed:
            used = {colour.get(w) for w in few(graph, graph[v])}
            colour[v] = next((c for c in range(colours - 1) if c not in used), colours - 1)
        for v in removed:
            second = few(thinner, graph[v]) - graph[v]
            found = graph[v] | second
            found |= few(thinner, second) if len(found) <= wanted else set()
            found |= {w for w in few(graph, graph[v]) if colour.get(w, colours) < colour[v]}
            neighbours[v] = nearest(v, found)[:wanted]
        parts = [[v for v in removed if colour[v] == c] for c in range(colours - 1, -1, -1)]
        levels, graph = levels + [part for part in parts if part], thinner
    levels = [sorted(graph)] * bool(graph) + levels[::-1]
    vertex = [v for level in levels for v in level]
    rank = {v: r for r, v in enumerate(vertex)}
    return SimpleNamespace(vertex=vertex, levels=[len(level) for level in levels],
                           neighbours=[[rank[w] for w in neighbours.get(v, [])] for v in vertex])

SCHEDULES = ((), (1, 4, 12, 36, 108, 324),
             (0, 1, 2, 3, 5, 8, 12, 18, 26, 36, 50, 70, 100, 140, 200, 280, 400, 560))
RENEWALS = (1, 3, 7, 9)
ZERO, ONE, TEN, HUNDRED, ROUNDER, LIMIT = map(float32, (0, 1, 10, 100, 12582912, 2**20))
OMEGAS = np.array([0x3F800000, 0x3F9837F0, 0x3FB504F3, 0x3FD744FD], np.uint32).view(float32)

limit = lambda x: np.where(x < LIMIT, np.where(x > -LIMIT, x, -LIMIT), LIMIT)
finite = lambda x: np.where(np.isfinite(x), x, ZERO)
add = lambda terms: total(terms, ZERO)
dot3 = lambda x, y: x[0] * y[0] + x[1] * y[1] + x[2] * y[2]

def solve(a, ridge, b):                                 # Section 3: factor(A, ridge), then solve(b)
    m, x, lower, diagonal, inverse = len(a), b.copy(), np.zeros_like(a), np.zeros_like(b), np.zeros_like(b)
    for j in range(m):
        t, column = lower[j, :j] * diagonal[:j], a[j:, j].copy()
        column[0] = column[0] + ridge
        for p in range(j):
            column = column - lower[j:, p] * t[p]
        diagonal[j], inverse[j] = column[0], ONE / column[0]
        lower[j + 1:, j] = column[1:] * inverse[j]
    for p in range(m):
        x[p + 1:] = x[p + 1:] - lower[p + 1:, p] * x[p]
    x = x * inverse
    for i, p in ((i, p) for i in range(m - 1, -1, -1) for p in range(i + 1, m)):
        x[i] = x[i] - lower[p, i] * x[p]
    return x

class Predictor:  # The weights of all vertices, which start from the pose and learn
    def __init__(self, pose, neighbours, p):
        self.m, self.alike, self.radius = p.neighbours, float32(p.alike or 0), float32(p.radius)
        count, self.samples = len(neighbours), []
        self.near = np.full((self.m, count), count)     # `count`: the place of a neighbour that there is not
        for r, ranks in enumerate(neighbours):
            self.near[:len(ranks), r] = ranks
        place, there = np.vstack([pose, [[0] * 3]]).astype(float32).T, self.near < count
        self.valid, apart = there.astype(float32), place[:, self.near] - place[:, None, :count]
        self.x = np.where(there, apart, ZERO)           # axis, neighbour, vertex
        lengths = np.sqrt(dot3(self.x, self.x))
        length, self.number = add(lengths), add(self.valid)
        scale = np.where(length > 0, self.number / length, ONE)
        self.x, lengths = self.x * scale, lengths * scale
        self.a, self.g = np.zeros((self.m, self.m, count), float32), np.zeros((self.m, count), float32)
        self.prior = self.weights = self.prior_of(lambda a: self.phi(lengths[a]),
                                                  lambda a, k: self.phi(np.sqrt(self.apart(a, k))))
    def phi(self, z):
        t = z * (ONE / self.radius)
        u = np.where(ONE - t > 0, ONE - t, ZERO)
        return (u * u) * (u * u) * (float32(4) * t + ONE)
    def apart(self, a, k):
        e = self.x[:, a] - self.x[:, k]
        return dot3(e, e)
    def prior_of(self, own, mutual):
        """Section 4: the prior weights; `own` and `mutual` are the local parts of the covariance."""
        valid, x, covariance = self.valid, self.x, np.zeros_like(self.a)
        b = np.array([valid[a] * (HUNDRED + TEN * own(a)) for a in range(self.m)])
        for a, k in ((a, k) for a in range(self.m) for k in range(a + 1)):
            linear = HUNDRED + TEN * dot3(x[:, a], x[:, k])
            covariance[a, k] = (valid[a] * valid[k]) * (linear + TEN * mutual(a, k))
        return finite(solve(covariance, float32(0.02), b))
    def renew(self):  # Section 5.1: the prior weights from how vertices have moved so far
        near, x, before = [sample[self.near] for sample in self.samples], self.x, self.prior
        difference = lambda pairs: add((p - q) * (p - q) for p, q in pairs)
        def psi(q):
            z = np.sqrt(q) * (float32(0.28) / self.radius)
            u = (ONE + z) * (ONE + z)
            return (ONE + float32(16) * z) / (((u * u) * (u * u)) * ((u * u) * (u * u)))
        moved = [difference((y[a], sample[:-1]) for y, sample in zip(near, self.samples))
                 for a in range(self.m)]
        mean = add(valid * np.sqrt(d) for valid, d in zip(self.valid, moved)) / self.number
        rest = mean * mean - float32(1 / 6) * float32(len(near))
        v = np.where(rest > 0, rest / ((mean * mean) * (mean * mean)), ZERO)
        v = (self.alike * self.alike / float32(64)) * v
        self.prior = self.prior_of(lambda a: psi(dot3(x[:, a], x[:, a]) + v * moved[a]), lambda a,
                k: psi(self.apart(a, k) + v * difference((y[a], y[k]) for y in near)))
        for a, b in ((a, b) for a in range(self.m) for b in range(self.m)):
            self.g[a] = self.g[a] + self.a[max(a, b), min(a, b)] * (before[b] - self.prior[b])
    def refit(self):
        ridge = float32(0.3) + add(self.a[i, i] for i in range(self.m)) * float32(1e-5 / self.m)
        self.weights = finite(self.prior + solve(self.a, ridge, self.g))
    def channel(self, residuals, levels, omega, more_refits):
        """The coefficients of a channel of a component; `more_refits`: whether weights still learn."""
        y, first = np.zeros(len(residuals) + 1, float32), 0
        for size in levels:
            part, first = slice(first, first + size), first + size
            u = limit(add(self.weights[a, part] * y[self.near[a, part]] for a in range(self.m))) * float32(64)
            y[part] = limit(((u + ROUNDER) - ROUNDER) * float32(1 / 64) + residuals[part])
        x = y[self.near]
        e = y[:-1] - add(self.prior[a] * x[a] for a in range(self.m))
        for a in range(self.m if more_refits else 0):
            z = x[a] * omega
            self.a[a, :a + 1] = self.a[a, :a + 1] + z * x[:a + 1]
            self.g[a] = self.g[a] + z * e
        self.samples.append(y)
        return y[:-1]

def reconstruct(residuals, pose, order, parameters):
    """Section 6: the coefficients [component, channel, rank]. `residuals`: [component, rank, channel]."""
    last, predictor, coefficients = len(residuals) - 1, Predictor(pose, order.neighbours, parameters), []
    renewals = [j for j in RENEWALS if parameters.alike and j < last]
    refits = renewals + [j for j in SCHEDULES[parameters.schedule] if j < last]
    for j, component in enumerate(residuals):
        omega = OMEGAS[parameters.omega[j] % 4] * float32(2.0 ** (parameters.omega[j] // 4 - 32))
        channels = np.array(component).astype(float32).T
        coefficients.append([predictor.channel(q, order.levels, omega, j <= max(refits, default=-1))
                             for q in channels])
        if j in renewals:
            predictor.renew()
        if j in refits:
            predictor.refit()
    return np.array(coefficients, float32)
