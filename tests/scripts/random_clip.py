# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Random animated meshes and random ways to encode them, for tests: the same for the same seed everywhere."""
import array
import math
import pathlib
import random
import struct
import sys


class RandomClip:
    """A mesh that moves: polygons, frames of flat coordinates, texture coordinates for each vertex or none."""

    def __init__(self, seed):
        self.seed = seed
        self.chance = random.Random(seed)
        self.polygons, self.vertices, self.objects = [], [], []
        for _ in range(self.chance.choice((1, 1, 1, 2, 4))):
            self.objects.append(len(self.polygons))
            self.chance.choice((self._grid, self._grid, self._tube, self._fan, self._soup, self._tangle, self._loose))()
        if self.chance.random() < 0.3:
            self._copy_vertices()
        if self.chance.random() < 0.3:
            self._shuffle()
        self.uv = [(self.chance.random(), self.chance.random()) for _ in self.vertices] \
            if self.chance.random() < 0.3 else None
        self.frames = self._frames(self.chance.choice((1, 2, 3, 5, 8, 12, 17, 24, 40)))
        self.times = self._times() if self.chance.random() < 0.2 and len(self.frames) > 1 else None

    # Meshes. Each adds polygons and vertices at rest.
    def _grid(self):
        width, height = self.chance.randint(1, 12), self.chance.randint(1, 12)
        first, tilt = len(self.vertices), self.chance.uniform(-1, 1)
        for y in range(height + 1):
            for x in range(width + 1):
                self.vertices.append((x / width, y / height, tilt * math.sin(3 * x / width + y)))
        kind = self.chance.choice(("quads", "triangles", "mixed"))
        for y in range(height):
            for x in range(width):
                a = first + y * (width + 1) + x
                quad = (a, a + 1, a + width + 2, a + width + 1)
                if kind == "quads" or kind == "mixed" and self.chance.random() < 0.5:
                    self.polygons.append(quad)
                elif self.chance.random() < 0.5:
                    self.polygons += [(quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])]
                else:
                    self.polygons += [(quad[0], quad[1], quad[3]), (quad[1], quad[2], quad[3])]

    def _tube(self):
        around, along = self.chance.randint(3, 14), self.chance.randint(1, 12)
        first = len(self.vertices)
        for y in range(along + 1):
            for x in range(around):
                angle = 2 * math.pi * x / around
                self.vertices.append((math.cos(angle), math.sin(angle), 3 * y / along))
        for y in range(along):
            for x in range(around):
                a, b = first + y * around + x, first + y * around + (x + 1) % around
                self.polygons.append((a, b, b + around, a + around))
        if self.chance.random() < 0.5:
            self.polygons.append(tuple(range(first, first + around)))
            self.polygons.append(tuple(range(first + (along + 1) * around - 1, first + along * around - 1, -1)))

    def _fan(self):
        """One vertex of many neighbours."""
        first, count = len(self.vertices), self.chance.randint(3, 60)
        self.vertices.append((0.0, 0.0, 1.0))
        for i in range(count):
            angle = 2 * math.pi * i / count
            self.vertices.append((math.cos(angle), math.sin(angle), 0.0))
        for i in range(count):
            self.polygons.append((first, first + 1 + i, first + 1 + (i + 1) % count))

    def _soup(self):
        """Triangles that share nothing."""
        for _ in range(self.chance.randint(1, 60)):
            first = len(self.vertices)
            self.vertices += [tuple(self.chance.uniform(-1, 1) for _ in range(3)) for _ in range(3)]
            self.polygons.append((first, first + 1, first + 2))

    def _tangle(self):
        """Polygons of any corners: edges of many faces, faces twice, corners twice."""
        first, count = len(self.vertices), self.chance.randint(3, 40)
        self.vertices += [tuple(self.chance.uniform(-1, 1) for _ in range(3)) for _ in range(count)]
        for _ in range(self.chance.randint(1, 2 * count)):
            polygon = tuple(first + self.chance.randrange(count) for _ in range(self.chance.choice((3, 3, 3, 4, 5))))
            self.polygons += [polygon] * self.chance.choice((1, 1, 1, 2))

    def _loose(self):
        """Vertices in no polygon."""
        self.vertices += [tuple(self.chance.uniform(-1, 1) for _ in range(3)) for _ in range(self.chance.randint(1, 40))]

    def _copy_vertices(self):
        """Gives some polygons corners of their own at the same places, as at seams."""
        for number, polygon in enumerate(self.polygons):
            if self.chance.random() < 0.2:
                first = len(self.vertices)
                self.vertices += [self.vertices[v] for v in polygon]
                self.polygons[number] = tuple(range(first, first + len(polygon)))

    def _shuffle(self):
        order = list(range(len(self.vertices)))
        self.chance.shuffle(order)
        place = {old: new for new, old in enumerate(order)}
        self.vertices = [self.vertices[old] for old in order]
        self.polygons = [tuple(place[v] for v in polygon) for polygon in self.polygons]

    # Motions.
    def _frames(self, count):
        chance = self.chance
        scale = 10.0 ** chance.choice((0, 0, 0, 0, -3, 4))
        centre = [chance.choice((0, 0, 0, 1000)) * scale * chance.uniform(-1, 1) for _ in range(3)]
        parts = [chance.choice(("still", "wave", "turn", "stretch", "noise", "walk", "cut", "rare"))
                 for _ in range(chance.choice((1, 1, 2, 3)))]
        amount = 10.0 ** chance.uniform(-3, 0)
        phase = [chance.uniform(0, 6) for _ in range(4)]
        walked = [[0.0] * 3 for _ in self.vertices]
        frames = []
        for f in range(count):
            frame = []
            cut = chance.uniform(-2, 2)
            for v, rest in enumerate(self.vertices):
                p = list(rest)
                key = p[0] + 2 * p[1] + 3 * p[2]
                for part in parts:
                    if part == "wave":
                        p[2] += amount * math.sin(0.3 * f + 2 * p[0] + phase[0])
                        p[0] += amount * math.cos(0.2 * f + 3 * p[1] + phase[1])
                    elif part == "turn":
                        angle = 0.1 * f * (1 + phase[2] % 2)
                        p[0], p[1] = (p[0] * math.cos(angle) - p[1] * math.sin(angle),
                                      p[0] * math.sin(angle) + p[1] * math.cos(angle))
                    elif part == "stretch":
                        p = [x * (1 + amount * math.sin(0.4 * f + axis)) for axis, x in enumerate(p)]
                    elif part == "noise":
                        random_at = random.Random(hash((self.seed, f, key)))
                        p = [x + 0.1 * amount * random_at.gauss(0, 1) for x in p]
                    elif part == "walk":
                        random_at = random.Random(hash((self.seed, f, key)))
                        walked[v] = [w + 0.05 * amount * random_at.gauss(0, 1) for w in walked[v]]
                        p = [x + w for x, w in zip(p, walked[v])]
                    elif part == "cut" and f % 7 == 6:
                        p = [x + cut * amount for x in p]
                    elif part == "rare" and v % 17 == f % 17:
                        p[1] += amount
                frame += [scale * x + c for x, c in zip(p, centre)]
            frames.append(array.array("f", frame))
        return frames

    def _times(self):
        times, now = [], self.chance.uniform(0, 3)
        for _ in self.frames:
            times.append(now)
            now += self.chance.choice((0.02, 0.04, 0.1, 0.5))
        return times

    # Files.
    def write(self, stem):
        """Writes stem.obj and stem.pc2, or stem.mdd if the times are uneven; the paths of both."""
        stem = pathlib.Path(stem)
        first = self.frames[0]
        with open(mesh := stem.with_suffix(".obj"), "w", encoding="ascii") as file:
            for v in range(len(self.vertices)):
                file.write("v {:.9g} {:.9g} {:.9g}\n".format(*first[3 * v:3 * v + 3]))
            for u, v in self.uv or ():
                file.write(f"vt {u:.6f} {v:.6f}\n")
            for number, polygon in enumerate(self.polygons):
                if number in self.objects:
                    file.write(f"o part{self.objects.index(number)}\n")
                file.write("f " + " ".join(f"{v + 1}/{v + 1}" if self.uv else str(v + 1) for v in polygon) + "\n")
        if self.times:
            with open(cache := stem.with_suffix(".mdd"), "wb") as file:
                file.write(struct.pack(">ii", len(self.frames), len(self.vertices)))
                file.write(struct.pack(f">{len(self.times)}f", *self.times))
                for frame in self.frames:
                    file.write(self.ordered(frame, "big"))
        else:
            with open(cache := stem.with_suffix(".pc2"), "wb") as file:
                file.write(struct.pack("<12siiffi", b"POINTCACHE2\0", 1, len(self.vertices), 0, 1, len(self.frames)))
                for frame in self.frames:
                    file.write(self.ordered(frame, "little"))
        return mesh, cache

    @staticmethod
    def ordered(frame, order):
        frame = array.array("f", frame)
        if sys.byteorder != order:
            frame.byteswap()
        return frame.tobytes()

    def options(self):
        """Options of `anicodec encode` that suit the clip: a target, and choices that most clips do not need."""
        chance = self.chance
        options = list(chance.choice((
            ("--kg", f"{10 ** chance.uniform(-2, 0.5):.4g}"), ("--max-error", f"{10 ** chance.uniform(-2, 0.5):.4g}%"),
            ("--kg", "1", "--max-error", "0.5%"), ())))
        options += chance.choice(([], [], ["--basis", "keyframes"], ["--basis", "eigenshapes"],
                                  ["--basis", "eigentrajectories"]))
        if options[-1:] == ["keyframes"] and len(self.frames) > 3 and chance.random() < 0.3:
            options += ["--interpolation", "msgi"]
        options += chance.choice(([], [], ["--order", "all"]))
        options += ["--effort", chance.choice(("fast", "fast", "normal", "best"))]
        return options
