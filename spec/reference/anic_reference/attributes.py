# SPDX-License-Identifier: CC0-1.0
"""Chapter 07a: attributes."""
import numpy as np
from .conventions import check, floor_log2, int32
from .entropy import Bit, RangeDecoder, integers, defaultdict

VERTICES, CORNERS, POLYGONS = 0, 1, 2                   # domains
MOST_STEPS_BACK = 255
mean = lambda a, z: [(x + y) >> 1 for x, y in zip(a, z)]

class MeshCorners:  # Section 1: the corners of all polygons in canonical order
    def __init__(self, faces):
        self.polygons, self.polygon, self.vertex, self.next, self.previous = [], [], [], [], []
        for p, polygon in enumerate(faces.polygons):
            first, n = len(self.vertex), len(polygon)
            self.polygons.append(range(first, first + n))
            self.polygon += [p] * n
            self.vertex += polygon
            self.next += [first + (i + 1) % n for i in range(n)]
            self.previous += [first + (i - 1) % n for i in range(n)]
        self.coded = [faces.coded[v] for v in self.vertex]
        sides = [(v, self.coded[following]) for v, following in zip(self.coded, self.next)]
        smallest = {side: c for c, side in reversed(list(enumerate(sides)))}
        across = [smallest.get((b, a)) for a, b in sides]
        earlier = [d is not None and self.polygon[d] < p for d, p in zip(across, self.polygon)]
        self.across = [d if before else None for d, before in zip(across, earlier)]
    def polygons_across(self, p):
        return [self.polygon[self.across[c]] for c in self.polygons[p] if self.across[c] is not None]

def read_labels(decoder, corners, labels):              # Section 2: the label of each polygon; 0 is none
    same, other, found = defaultdict(Bit), defaultdict(Bit), []
    for p in range(len(corners.polygons)):
        g, k = found[-1] if found else 0, 0
        for n in (found[d] for d in corners.polygons_across(p)):
            g, k = n, 1 if k == 0 or n == g else 2
        found.append(g if decoder.bit(same[k]) else decoder.unsigned(other))
        check(found[-1] <= labels, "INDEX_RANGE", "a label that does not exist")
    return found

class Entries:  # Sections 3 and 4: `of`, the entry of each element, and the `numbers` of entries that were read
    def __init__(self, decoder, faces, corners, attribute):
        self.decoder, self.corners, self.newest, self.older, self.numbers = decoder, corners, {}, [], {}
        self.same, self.new, self.walk, self.residuals = defaultdict(Bit), Bit(), defaultdict(Bit), integers()
        self.last, self.h, self.by_corner = [0] * attribute.components, 0, attribute.domain == CORNERS
        self.element = corners.vertex if attribute.domain == VERTICES else range(len(corners.vertex))
        if attribute.domain == POLYGONS:
            self.of, self.older = range(len(corners.polygons)), [None] * len(corners.polygons)
            for p in self.of:
                near = [self.numbers[d] for d in corners.polygons_across(p)][:2]
                self.read_numbers(p, 5 - len(near), mean(near[0], near[-1]) if near else self.last)
            return
        self.of = [None] * len(corners.vertex if self.by_corner else faces.coded)
        for polygon in corners.polygons:
            self.read_polygon(polygon)
        for e, v in enumerate([] if self.by_corner else faces.coded):
            if self.of[e] is None and self.choose(e, v, self.newest.get(v), 0):  # a vertex in no polygon
                self.read_numbers(self.of[e], 5, self.last)
    entry = lambda self, c: None if c is None else self.of[self.element[c]]             # E(c) of the text
    known = lambda self, c: self.entry(c) in self.numbers
    def read_polygon(self, polygon):
        corners, b, n = self.corners, 0, len(polygon)
        for c in (c for c in polygon if self.entry(c) is None):
            k, newest, over = 0, self.newest.get(corners.coded[c]), corners.across[c]
            x = self.entry(corners.next[over]) if self.by_corner and over is not None else None
            y = self.entry(corners.across[corners.previous[c]]) if self.by_corner else None
            if x is not None or y is not None:
                k = 1 if x == y else 3 if x is None or y is None else 2
            g = x if x is not None else y if y is not None else newest
            self.choose(self.element[c], corners.coded[c], g, 3 * k + b)
            b = b if newest is None else 1 if self.entry(c) == g else 2
        first = next((i for i, c in enumerate(polygon) if self.known(c)), 0)
        for c in (polygon[(first + i) % n] for i in range(n) if self.last):
            if not self.known(c):
                self.read_numbers(self.entry(c), *self.guess(corners.previous[c], corners.next[c], n))
    def choose(self, e, v, g, k):  # Finds the entry of element e at coded vertex v; whether it is a new one
        x, before = g, self.newest.get(v)
        if g is not None and not self.decoder.bit(self.same[k]):
            x = before if self.older[before] is not None and not self.decoder.bit(self.new) else None
            for _ in range(min(self.decoder.unsigned(self.walk), MOST_STEPS_BACK) if x is not None else 0):
                x = x if self.older[x] is None else self.older[x]
        if x is None:
            self.newest[v] = self.of[e] = len(self.older)
            self.older.append(before)
        self.of[e] = self.newest[v] if x is None else x
        return x is None
    def guess(self, a, z, n):
        """Section 4: the rule and the prediction of a corner between a and z in a polygon of n."""
        corners, known, entry, numbers = self.corners, self.known, self.entry, self.numbers
        behind, over, both = corners.previous[a], corners.across[z], known(a) and known(z)
        across, beyond = corners.across[behind], corners.next[z]
        if not known(a) and not known(z):
            return 5, self.last
        if n == 4 and both and known(beyond):
            return 0, self.sum(a, z, beyond)
        joined = over is not None and entry(over) == entry(a) and entry(corners.next[over]) == entry(z)
        if n == 3 and both and joined:
            return 1, self.sum(a, z, corners.next[corners.next[over]])
        if n > 3 and known(a) and known(behind) and across is not None and entry(across) == entry(a):
            return 2, self.sum(a, a, corners.previous[across])
        if both:
            return 3, mean(numbers[entry(a)], numbers[entry(z)])
        return 4, numbers[entry(a if known(a) else z)]
    def sum(self, *added_and_less):
        return [int32(x + y - z) for x, y, z in zip(*(self.numbers[self.entry(c)] for c in added_and_less))]
    def read_numbers(self, entry, rule, guess):
        numbers = []
        for i, g in enumerate(guess):
            d = self.decoder.signed(self.residuals[rule, min(i, 3), self.h], modelled=True)
            numbers.append(int32(g + d))
            self.h = min(floor_log2(abs(d) + 1) // 2, 3)
        self.numbers[entry] = self.last = numbers

def read_attributes(stream, faces, corners, attributes):
    """The values of all attributes in canonical order: `labels_of` polygons, or `entries` and `values` of
    elements; `moves`: the values of all frames, if a segment moves them."""
    decoder = RangeDecoder(stream)
    for attribute in attributes:
        attribute.labels_of = attribute.entries = attribute.values = attribute.moves = None
        if attribute.components is None:
            attribute.labels_of = read_labels(decoder, corners, len(attribute.labels))
            continue
        found = Entries(decoder, faces, corners, attribute)
        attribute.entries, attribute.entry_count = list(found.of), len(found.older)
        if attribute.components:
            numbers = np.array([found.numbers[e] for e in found.of], float).reshape(-1, attribute.components)
            grids = np.array([(grid.origin, grid.scale) for grid in attribute.grids]).T
            attribute.values = (grids[0] + numbers / grids[1]).astype(np.float32)
            check(np.isfinite(attribute.values).all(), "NON_FINITE", f"values of attribute {attribute.name}")
    decoder.end()

def surface_of_entries(attribute, faces, corners, pose):
    """Chapter 09a, section 8: pose and triangles of the entries of an attribute that moves."""
    entry_of, domain = attribute.entries, attribute.domain
    element = (corners.vertex, range(len(corners.vertex)), corners.polygon)[domain]
    of_corners = zip((entry_of[e] for e in element), corners.coded)
    places = zip(entry_of, faces.coded) if domain == VERTICES else of_corners
    sums, counts = (np.zeros((attribute.entry_count, size), np.int64) for size in (3, 1))
    for entry, v in places:
        sums[entry], counts[entry] = sums[entry] + pose[v], counts[entry] + 1
    other = corners.across if domain == POLYGONS else corners.next
    pairs = [(entry_of[element[c]], entry_of[element[d]]) for c, d in enumerate(other) if d is not None]
    return sums // np.maximum(counts, 1), [(a, b, b) for a, b in pairs if a != b]
