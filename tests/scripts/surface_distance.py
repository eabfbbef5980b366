# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Distance of points from a triangle surface, in the plainest way there is; for tests."""
import math


def triangles(polygons):
    """Fans of polygons."""
    return [(p[0], p[i], p[i + 1]) for p in polygons for i in range(1, len(p) - 1)]


def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def to_segment(p, a, b):
    """Distance of p from the line between a and b."""
    along, to = _minus(b, a), _minus(p, a)
    length = _dot(along, along)
    t = min(1, max(0, _dot(to, along) / length)) if length else 0
    return math.dist(p, [x + t * d for x, d in zip(a, along)])


def to_triangle(p, a, b, c):
    """Distance of p from a triangle."""
    u, v = _minus(b, a), _minus(c, a)
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    area = _dot(n, n)
    if area > 0:
        to = _minus(p, a)
        uu, vv, uv, tu, tv = _dot(u, u), _dot(v, v), _dot(u, v), _dot(to, u), _dot(to, v)
        s, t = (tu * vv - tv * uv) / area, (tv * uu - tu * uv) / area
        if s >= 0 and t >= 0 and s + t <= 1:
            return abs(_dot(to, n)) / math.sqrt(area)
    return min(to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a))


class Surface:
    """Triangles of flat coordinates."""

    def __init__(self, flat, corners):
        self._triangles = [tuple(tuple(flat[3 * v:3 * v + 3]) for v in triangle) for triangle in corners]

    def distance(self, point, enough):
        """The distance of a point from the surface; stops at a distance that is enough."""
        least = math.inf
        for triangle in self._triangles:
            least = min(least, to_triangle(point, *triangle))
            if least <= enough:
                break
        return least
