# SPDX-License-Identifier: CC0-1.0
"""Chapter 06, section 10: the record ATTR; chapter 07a: values of attributes."""
import numpy as np
from types import SimpleNamespace as Record
from .common import Reader, need, signed32
from .entropy import Models, RangeDecoder, bit_model, bits, integers, lg

VERTICES, CORNERS, POLYGONS = 0, 1, 2


def _read_look(r):
    look = Record(flags=r.u8())
    if look.flags == 0:
        return look
    alpha = look.flags >> 2
    need(look.flags & 1 and alpha <= 2, 'RECORD', 'flags of a look')
    look.base_colour = [r.finite(0, 'f32') for _ in range(4)]
    look.metallic, look.roughness = r.finite(0, 'f32'), r.finite(0, 'f32')
    look.emissive = [r.finite(0, 'f32') for _ in range(3)]
    look.alpha_cutoff = r.finite(0, 'f32') if alpha == 1 else None
    textures = r.u8()
    need(textures < 32, 'RECORD', 'textures')
    look.images = {}
    for i in range(5):
        if textures >> i & 1:
            look.images[i] = r.text()
            need(look.images[i], 'RECORD', 'name of an image')
    return look


def _read_attribute(r, labels_left):
    a = Record(kind=r.u8())
    need(a.kind <= 6, 'FEATURE', 'kind of an attribute')
    a.domain = r.u8()
    need(a.domain <= 2, 'FEATURE', 'domain of an attribute')
    need(a.kind < 5 or a.domain == POLYGONS, 'RECORD', 'domain of an attribute')
    a.name, a.labels, a.looks, a.components, a.grids = r.text(), [], None, 0, []
    if a.kind >= 5:
        count = r.varint()
        need(count <= r.left() and count <= labels_left, 'RECORD', 'labels')
        a.labels = [r.text() for _ in range(count)]
        if a.kind == 5:
            looks = r.u8()
            need(looks <= 1 and (count or not looks), 'RECORD', 'looks')
            a.looks = [_read_look(r) for _ in range(count)] if looks else None
    else:
        a.components = r.varint(16, 0 if a.domain == CORNERS else 1)
        for _ in range(a.components):
            a.grids.append((r.finite(error='QUANTIZER'), r.finite(error='QUANTIZER')))
            need(a.grids[-1][1] > 0, 'QUANTIZER', 'scale')
    return a


def read_attributes(data, limits, mesh):
    """The attributes of a mesh, with `values` by vertex or corner, `entry_of` or `label_of`, in the canonical order."""
    r = Reader(data)
    attributes, labels, numbers = [], 0, 0
    elements = (mesh.source, len(mesh.vertex), len(mesh.starts) - 1)
    for _ in range(limits.attributes):
        a = _read_attribute(r, limits.labels - labels)
        labels += len(a.labels)
        numbers += elements[a.domain] * max(1, a.components)
        attributes.append(a)
    need((r.at, labels, numbers) == (limits.head, limits.labels, limits.numbers), 'RECORD', 'attributes in LIMI')
    stream, corners = RangeDecoder(r.rest()), Around(mesh)
    mesh.around = corners
    for a in attributes:
        if a.kind >= 5:
            a.label_of = _read_labels(stream, mesh, corners, len(a.labels))
        else:
            Entries(stream, mesh, corners, a)
    stream.end()
    for a in attributes:
        if a.components:
            n = np.array(a.numbers, np.float64).reshape(-1, a.components)
            origin, scale = np.array(a.grids).T
            values = (origin + n / scale).astype(np.float32)
            need(np.isfinite(values).all(), 'NON_FINITE', 'value of an attribute')
            a.values = values[a.entry_of]
    return attributes


class Around:
    """Section 1: neighbours of the corners."""

    def __init__(self, mesh):
        n = len(mesh.vertex)
        self.coded = [mesh.coded_of[v] for v in mesh.vertex]
        self.next, self.previous = list(range(1, n + 1)), list(range(-1, n - 1))
        for a, b in zip(mesh.starts, mesh.starts[1:]):
            if b > a:
                self.next[b - 1], self.previous[a] = a, b - 1
        first = {}
        for c in range(n):
            first.setdefault((self.coded[c], self.coded[self.next[c]]), c)
        self.across = []
        for c in range(n):
            d = first.get((self.coded[self.next[c]], self.coded[c]))
            self.across.append(d if d is not None and mesh.polygon_of[d] < mesh.polygon_of[c] else None)


def _read_labels(stream, mesh, corners, labels):
    """Section 2."""
    same, number, found = Models(bit_model), bits(), []
    for p in range(len(mesh.starts) - 1):
        g, k = found[p - 1] if p else 0, 0
        for c in range(mesh.starts[p], mesh.starts[p + 1]):
            d = corners.across[c]
            if d is not None:
                n = found[mesh.polygon_of[d]]
                k = 1 if k == 0 or n == g else 2
                g = n
        label = g if stream.bit(same[k]) else stream.unsigned(number)
        need(label <= labels, 'INDEX_RANGE', 'label')
        found.append(label)
    return found


class Entries:
    """Sections 3 and 4."""

    def __init__(self, stream, mesh, corners, attribute):
        self.stream, self.bits, self.models = stream, Models(bit_model), integers()
        self.corners, self.components = corners, attribute.components
        by_corner = attribute.domain == CORNERS
        self.element = range(len(mesh.vertex)) if by_corner else mesh.vertex
        self.entry = [None] * (len(mesh.vertex) if by_corner else mesh.source)
        self.newest, self.older = [None] * mesh.coded, []
        self.numbers, self.last, self.h = [], [0] * self.components, 0
        if attribute.domain == POLYGONS:
            self.read_polygons(mesh)
        else:
            self.read_entries(mesh, by_corner)
        attribute.entry_of, attribute.numbers = self.entry, self.numbers

    def read_polygons(self, mesh):
        """Section 4, where each polygon has an entry of its own."""
        count = len(mesh.starts) - 1
        self.entry, self.numbers = list(range(count)), [None] * count
        for p in range(count):
            across = [self.corners.across[c] for c in range(mesh.starts[p], mesh.starts[p + 1])]
            near = [self.numbers[mesh.polygon_of[d]] for d in across if d is not None][:2]
            if len(near) == 2:
                self.read_numbers(p, 3, [i + j >> 1 for i, j in zip(*near)])
            else:
                self.read_numbers(p, 5 - len(near), near[0] if near else self.last)

    def read_entries(self, mesh, by_corner):
        corners = self.corners
        across, following, previous = corners.across, corners.next, corners.previous
        for p in range(len(mesh.starts) - 1):
            first_new, b = len(self.older), 0
            polygon = range(mesh.starts[p], mesh.starts[p + 1])
            for c in polygon:
                e = self.element[c]
                if self.entry[e] is not None:
                    continue
                v, k = corners.coded[c], 0
                g = self.newest[v]
                first = g is None
                if by_corner:
                    d = across[c]
                    x = None if d is None else self.entry[following[d]]
                    d = across[previous[c]]
                    y = None if d is None else self.entry[d]
                    k = 0 if x is None and y is None else 1 if x == y else 3 if x is None or y is None else 2
                    g = x if x is not None else y if y is not None else g
                self.choose(e, v, g, 3 * k + b)
                if not first:
                    b = 1 if self.entry[e] == g else 2
            if self.components and len(self.older) > first_new:
                self.read_polygon(polygon, first_new)
        if not by_corner:
            for e in range(mesh.source):
                if self.entry[e] is None:
                    v = mesh.coded_of[e]
                    if self.choose(e, v, self.newest[v], 0) and self.components:
                        self.read_numbers(self.entry[e], 5, self.last)

    def choose(self, e, v, g, k):
        if g is not None:
            if self.stream.bit(self.bits['same', k]):
                self.entry[e] = g
                return False
            x = self.newest[v]
            if self.older[x] is not None and not self.stream.bit(self.bits['new']):
                s = min(self.stream.unsigned(self.models['walk']), 255)
                while s > 0 and self.older[x] is not None:
                    x, s = self.older[x], s - 1
                self.entry[e] = x
                return False
        self.entry[e] = len(self.older)
        self.older.append(self.newest[v])
        self.newest[v] = self.entry[e]
        self.numbers.append(None)
        return True

    def read_polygon(self, polygon, first_new):
        """Numbers of the entries from first_new on (section 4)."""
        across, following, previous = self.corners.across, self.corners.next, self.corners.previous
        n, entry, numbers, element = len(polygon), self.entry, self.numbers, self.element

        def known(c):
            return numbers[entry[element[c]]] is not None

        def e(c):
            return entry[element[c]]

        def of(c):
            return numbers[entry[element[c]]]
        start = next((c for c in polygon if known(c)), polygon[0])
        c = start
        for _ in range(n):
            if not known(c):
                a, z = previous[c], following[c]
                rule, guess = 4, None
                known_a, known_z = known(a), known(z)
                if not known_a and not known_z:
                    rule, guess = 5, self.last
                elif n == 4 and known_a and known_z and known(following[z]):
                    rule, guess = 0, [i + j - k for i, j, k in zip(of(a), of(z), of(following[z]))]
                elif n == 3 and known_a and known_z and self._same(across[z], a, z):
                    far = following[following[across[z]]]
                    rule, guess = 1, [i + j - k for i, j, k in zip(of(a), of(z), of(far))]
                else:
                    o = across[previous[a]] if n > 3 and known_a and known(previous[a]) else None
                    if o is not None and e(o) == e(a):
                        rule, guess = 2, [i + i - k for i, k in zip(of(a), of(previous[o]))]
                    elif known_a and known_z:
                        rule, guess = 3, [i + j >> 1 for i, j in zip(of(a), of(z))]
                    else:
                        guess = of(a if known_a else z)
                self.read_numbers(e(c), rule, guess)
            c = following[c]

    def _same(self, o, a, z):
        element, entry = self.element, self.entry
        return (o is not None and entry[element[o]] == entry[element[a]]
                and entry[element[self.corners.next[o]]] == entry[element[z]])

    def read_numbers(self, x, rule, guess):
        line = []
        for i in range(self.components):
            d = self.stream.modelled(self.models['residual', rule, min(i, 3), self.h], 30)
            line.append(signed32(guess[i] + d))
            self.h = min(lg(abs(d) + 1) // 2, 3)
        self.numbers[x] = self.last = line


def surface_of_entries(mesh, attribute, pose):
    """The entries of an attribute in the place of coded vertices (09a, section 8), and their pose."""
    entry, around, n = attribute.entry_of, mesh.around, len(attribute.numbers)
    corners = range(len(mesh.vertex))
    if attribute.domain == VERTICES:
        element, members = mesh.vertex, zip(entry, mesh.coded_of)
    else:
        element = corners if attribute.domain == CORNERS else mesh.polygon_of
        members = ((entry[element[c]], around.coded[c]) for c in corners)
    sums, counts = [[0, 0, 0] for _ in range(n)], [0] * n
    for e, v in members:
        counts[e] += 1
        sums[e] = [a + b for a, b in zip(sums[e], pose.p[v])]
    ends = around.across if attribute.domain == POLYGONS else around.next
    pairs = [(entry[element[c]], entry[element[d]]) for c, d in zip(corners, ends) if d is not None]
    copies = [0] * n
    for e in entry:
        copies[e] += 1
    surface = Record(coded=n, triangles=[(a, b, b) for a, b in pairs if a != b], copies=copies)
    p = [[x // max(count, 1) for x in line] for line, count in zip(sums, counts)]
    return surface, Record(origin=pose.origin, step=pose.step, p=p)
