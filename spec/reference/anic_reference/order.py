# SPDX-License-Identifier: CC0-1.0
"""Chapter 09, section 1: order and neighbours of the vertices."""
from .entropy import lg


def graph_of(n, triangles):
    """Sets of neighbours by the coded triangles."""
    graph = [set() for _ in range(n)]
    for a, b, c in triangles:
        graph[a].update((b, c))
        graph[b].update((a, c))
        graph[c].update((a, b))
    for v in range(n):
        graph[v].discard(v)
    return graph


def is_dense(graph):
    """Whether the sum of the degrees is more than 16 |H|."""
    degrees = [len(line) for line in graph if line]
    return sum(degrees) > 16 * len(degrees)


class _Thinning:
    """Section 1.2. G is `graph`: {vertex: set of neighbours}."""

    def __init__(self, pose, triangles, regions):
        n = len(pose)
        low = [min(p[axis] for p in pose) for axis in range(3)]
        extent = max(max(p[axis] for p in pose) - low[axis] for axis in range(3))
        s = max(extent.bit_length() - 15, 0)
        self.g = [tuple(p[axis] - low[axis] >> s for axis in range(3)) for p in pose]
        self.regions = regions or [0] * n
        whole = graph_of(n, triangles)
        self.graph = dict(enumerate(whole))
        if is_dense(whole):
            self.link_all()
        elif regions:
            for v, line in self.graph.items():
                self.graph[v] = {w for w in line if regions[v] == regions[w]}

    def distance(self, v, w):
        x, y, z = self.g[v]
        a, b, c = self.g[w]
        return (x - a) ** 2 + (y - b) ** 2 + (z - c) ** 2

    def morton(self, v):
        code = 0
        for axis in range(3):
            x = self.g[v][axis] >> 5
            for i in range(10):
                code |= (x >> i & 1) << 3 * i + axis
        return code

    def link_all(self):
        sequence = sorted(self.graph, key=lambda v: (self.regions[v], self.morton(v), v))
        for v in sequence:
            self.graph[v] = set()
        for step in (1, 2):
            for v, w in zip(sequence, sequence[step:]):
                if self.regions[v] == self.regions[w]:
                    self.graph[v].add(w)
                    self.graph[w].add(v)

    def linked(self):
        """H"""
        return [v for v, line in self.graph.items() if line]

    def select(self):
        keys = []
        for v in self.linked():
            line = self.graph[v]
            keys.append((lg(min(self.distance(u, v) for u in line)), min(len(line), 15), v))
        removed, locked = [], set()
        for _, _, v in sorted(keys):
            if v not in locked and len(self.graph[v]) <= 32:
                removed.append(v)
                locked |= self.graph[v]
        return sorted(removed)

    def without(self, removed):
        """G'"""
        gone = set(removed)
        coarse = {v: line - gone for v, line in self.graph.items() if v not in gone}
        for v in removed:
            target = min(self.graph[v], key=lambda u: (self.distance(u, v), u))
            for u in self.graph[v]:
                if u != target:
                    coarse[target].add(u)
                    coarse[u].add(target)
        return coarse

    def nearest(self, v, coarse, colour, m):
        """neighbours(v)"""
        graph, first = self.graph, self.graph[v]
        second = set()
        for u in first:
            if len(coarse[u]) <= 32:
                second |= coarse[u]
        second -= first
        found = first | second
        if len(found) <= m:
            for u in second:
                if len(coarse[u]) <= 32:
                    found |= coarse[u]
        if colour[v] > 0:
            for u in first:
                if len(graph[u]) <= 32:
                    found |= {w for w in graph[u] if w in colour and colour[w] < colour[v]}
        return sorted(found, key=lambda u: (self.distance(u, v), u))[:m]

    def levels(self, colours, m):
        levels, neighbours = [], {}
        while True:
            linked = self.linked()
            if not linked:
                if len({self.regions[v] for v in self.graph}) == len(self.graph):
                    break
                self.link_all()
            elif sum(len(self.graph[v]) for v in linked) > 16 * len(linked):
                self.link_all()
            removed = self.select()
            if 16 * len(removed) < len(self.linked()):
                self.link_all()
                removed = self.select()
            coarse = self.without(removed)
            colour = {}
            for v in removed:
                used = set()
                for u in self.graph[v]:
                    if len(self.graph[u]) <= 32:
                        used.update(colour[w] for w in self.graph[u] if w in colour)
                colour[v] = next((k for k in range(colours - 1) if k not in used), colours - 1)
            for v in removed:
                neighbours[v] = self.nearest(v, coarse, colour, m)
            for k in range(colours - 1, -1, -1):
                level = [v for v in removed if colour[v] == k]
                if level:
                    levels.append(level)
            self.graph = coarse
        if self.graph:
            levels.append(sorted(self.graph))
        for v in self.graph:
            neighbours[v] = []
        return levels, neighbours


def decoding_order(pose, triangles, regions, colours, m):
    """Vertices by rank, numbers of vertices of the levels, neighbours (as ranks) of each rank."""
    levels, neighbours = _Thinning(pose, triangles, regions).levels(colours, m)
    levels.reverse()
    order = [v for level in levels for v in level]
    rank = {v: r for r, v in enumerate(order)}
    return order, [len(level) for level in levels], [[rank[w] for w in neighbours[v]] for v in order]
