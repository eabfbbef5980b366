# SPDX-License-Identifier: CC0-1.0
"""Chapter 11: counts that no sensible file has, and the memory that a file takes."""
from .common import need

LIMIT_BYTES = 2 ** 30                                 # of memory, by section 3


def weight_numbers(s):
    return s.frames * s.components * s.regions * s.rows


def check_counts(limi, size):
    """Section 2. `size`: bytes of the file."""
    work, room = 0, 256 * size + 2 ** 24
    for m in limi.meshes:
        counts = (m.source, m.coded, m.triangles, m.polygons, m.corners)
        need(max(counts) <= 2 ** 16 * size, 'LIMIT', 'counts of a mesh')
        need(m.corners * m.attributes <= 16 * m.corners + 256 * m.numbers + 4096 * m.attributes, 'LIMIT', 'attributes')
    for s in limi.segments:
        m = limi.meshes[s.mesh]
        n = s.entries or m.coded
        coefficients = n * s.components * s.channels
        weights = weight_numbers(s) if s.kind else s.frames * s.components
        need(s.draco_bytes <= size and s.draco_points // 3 <= m.triangles, 'LIMIT', 'Draco')
        need(coefficients <= 2 ** 22 * size and 4 * weights <= 2 ** 22 * size, 'LIMIT', 'coefficients or weights')
        need(not s.exact or s.frames * m.coded <= 2 ** 16 * size, 'LIMIT', 'exact positions')
        work += min(s.frames, s.corrections) * -(-n // 16)
        room += 16 * (coefficients + weights)
    need(work <= room, 'LIMIT', 'corrections')


def memory(limi):
    """Section 3: bytes while the file is open, and more while it opens. Without the optional profile."""
    kept = 12 * limi.root_frames + (384 if limi.root_frames else 256) * len(limi.clip_frames)
    opening, stages = 0, []
    for i, m in enumerate(limi.meshes):
        a = 4 * m.numbers + 2 * m.head + 512 * m.attributes + 256 * m.labels
        kept += 512 + 4 * (m.source + m.polygons + 1 + m.corners) + a
        opening += 12 * m.triangles + 12 * m.coded
        if sum(s.mesh == i and not s.moves_attribute for s in limi.segments) > 1:
            opening += 36 * m.triangles + 181 * m.coded
        stages.append(44 * m.corners + 8 * m.polygons + 28 * m.coded + 3 * 2 ** 18)
        maps = 40 * m.source + 36 * m.polygons + 16 * m.corners + 2 ** 18
        if m.attributes:
            maps += 64 * m.corners + 16 * m.source + 2 * a + 2 ** 16
        stages += [maps, 2 ** 17, 92 * m.coded + 96 * m.triangles + 3 * 2 ** 17]
    for s in {(s.mesh, s.attribute): s for s in limi.segments if s.moves_attribute}.values():
        kept += 4 * s.elements
        opening += 48 * limi.meshes[s.mesh].corners + 193 * s.entries
    for s in limi.segments:
        m = limi.meshes[s.mesh]
        f, j, w = s.frames * s.regions, s.components, s.wide
        n, triangles = (s.entries, m.corners) if s.moves_attribute else (m.coded, m.triangles)
        rounded = -(-(s.elements if s.moves_attribute else m.source) // 16) * 16
        kept += 512 + 48 * f + 4 * f * j * (s.rows if s.kind else 1) + 2 * s.channels * rounded * (j + w)
        kept += (12 * rounded if s.kind else 0) + (rounded if s.regions > 1 else 0)
        if s.kind == 0:
            stages.append(36 * n * j + 4 * f * j + 28 * f + 2 ** 18 + 92 * n + 96 * triangles + 3 * 2 ** 17)
        else:
            stages.append(12 * f * j + 80 * f + 2 ** 18
                          + max(368 * n + 48 * triangles, 4 * s.channels * (n + 1) * (j + 8) + 120 * n))
        if s.exact:
            kept += 12 * s.frames * n + 4 * m.source
            stages.append(42 * n + 12 * n * s.frames + 12 * s.frames + 2 ** 18)
        if s.corrections:
            kept += 16 * s.corrections + 4 * (s.frames + 1)
    return kept, opening + max(stages)


def check_memory(limi, limit=LIMIT_BYTES):
    kept, opening = memory(limi)
    need(kept + opening <= limit, 'LIMIT', 'memory')
