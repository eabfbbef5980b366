# SPDX-License-Identifier: CC0-1.0
"""A whole file in the order of chapter 12, and live streams (05, section 8)."""
import struct
import numpy as np
from . import limits, records
from .attributes import read_attributes, surface_of_entries
from .common import AnicError, Reader, checksum, need
from .container import Container, MAGIC, check_places
from .maps import VertexMap, read_face_map
from .pose import Corners
from .segments import Root, Segment, read_pose_chunk
from .topology import Mesh

np.seterr(all='ignore')


class File:
    """All of a file, decoded and checked."""

    def __init__(self, data, memory=limits.LIMIT_BYTES, size=None):
        """`size`: bytes by which limits go (11, section 2), if not those of the file."""
        self.container = c = Container(data)
        self.limi = limi = records.read_limi(c.chunk('LIMI'), c.features)
        limits.check_counts(limi, size or len(data))
        limits.check_memory(limi, memory)
        self.clip = records.read_clip(c.chunk('CLIP'), limi)
        check_places(c, limi, self.clip.order)
        self.root = Root(c.chunk('ROOT'), limi, self.clip.up) if limi.root_frames else None
        self.meshes = [self._mesh(m) for m in range(len(limi.meshes))]
        self.corners = [Corners(m.coded, m.triangles) if self._needs_corners(i) else None
                        for i, m in enumerate(self.meshes)]
        self.poses = [read_pose_chunk(c.chunk('POSE', m), self.corners[m]) if c.has('POSE', m) else None
                      for m in range(len(limi.meshes))]
        self.segments = [self._segment(s) for s in range(len(limi.segments))]
        if c.has('META'):
            records.read_meta(c.chunk('META'))
        self.boxes = {}
        for s, part in enumerate(limi.segments):
            if c.has('BNDS', part.mesh, s):
                self.boxes[s] = records.read_bnds(c.chunk('BNDS', part.mesh, s), part.frames)
        for e in c.entries:                           # those that are not known, too
            c.payload(e)
        for s in self.segments:
            s.compare_hashes()

    def _needs_corners(self, m):
        return self.container.has('POSE', m) or any(s.mesh == m for s in self.limi.segments)

    def _mesh(self, m):
        c, limi = self.container, self.limi
        r = Reader(c.chunk('MESH', m))
        name = r.text()
        mesh = Mesh(r.rest(), limi.meshes[m])
        mesh.name = name
        mesh.attributes = read_attributes(c.chunk('ATTR', m), limi.meshes[m], mesh) if limi.meshes[m].attributes else []
        mesh.order = VertexMap(c.chunk('VMAP', m), mesh).order if self.clip.order != 1 else list(range(mesh.source))
        mesh.canonical = mesh.polygons()
        mesh.user_polygons, mesh.corner_order, mesh.polygon_order = self._user_polygons(m, mesh)
        return mesh

    def _user_polygons(self, m, mesh):
        """Polygons as the user gets them (07, section 6), and which canonical corners and polygons they are."""
        number = [0] * mesh.source
        for s, v in enumerate(mesh.order):
            number[v] = s
        starts = mesh.starts
        corners = [list(range(a, b)) for a, b in zip(starts, starts[1:])]
        order = list(range(len(corners)))
        if self.clip.order == 2:
            places, turns = read_face_map(self.container.chunk('FMAP', m), mesh)
            moved = [None] * len(corners)
            for line, p, turn in zip(corners, places, turns):
                moved[p] = line[turn:] + line[:turn]
            order = sorted(order, key=places.__getitem__)
            corners = moved
        return [[number[mesh.vertex[c]] for c in line] for line in corners], corners, order

    def _segment(self, s):
        part = self.limi.segments[s]
        mesh = self.meshes[part.mesh]
        corners, pose = self.corners[part.mesh], self.poses[part.mesh]
        if part.moves_attribute:
            a = mesh.attributes[part.attribute]
            need(a.domain == part.domain and a.components > 3 * part.triple and len(a.numbers) == part.entries,
                 'INDEX_RANGE', 'attribute that moves')
            need(pose is not None, 'CHUNK_MISSING', 'POSE')
            mesh, pose = surface_of_entries(mesh, a, pose)
        return Segment(self.container, self.limi, s, mesh, corners, pose)

    def positions(self, segment, f):
        """float32 positions (or moves of an attribute) of the coded vertices, in frame f of a segment."""
        s = self.segments[segment]
        if s.exact is not None:
            return s.exact[f]
        x = s.made(f)
        if self.root and not s.limits.moves_attribute:
            self.root.apply(x, s.limits.first + f)
        return x.astype(np.float32)

    def source_positions(self, segment, f):
        """As the user gets them: of all vertices of the source, in the order of the clip."""
        part = self.limi.segments[segment]
        mesh = self.meshes[part.mesh]
        if part.moves_attribute:
            return self.positions(segment, f)[mesh.attributes[part.attribute].entry_of]
        return self.positions(segment, f)[np.array(mesh.coded_of)[mesh.order]]

    def box(self, segment, f):
        """Box of a frame of a segment (06, section 13): least and largest x, y, z."""
        b = self.boxes[segment]
        low, high = np.array(b.low, np.float64), np.array(b.high, np.float64)
        box = np.array(list(b.boxes[f // b.every]) if b.every else [0] * 6) / 255
        return ((low + (high - low) * box[:3]).astype(np.float32), (high + (low - high) * box[3:]).astype(np.float32))

    def boxes_hold(self, segment):
        """Whether the boxes hold the positions, up to a tolerance."""
        for f in range(self.limi.segments[segment].frames):
            x, spare = self.positions(segment, f).astype(np.float64), self.segments[segment].tolerance(f)
            least, most = self.box(segment, f)
            if (x < least - spare).any() or (x > most + spare).any():
                return False
        return True


def table_entry(e):
    """An entry of the table (05, section 2) as bytes."""
    def varint(x):
        out = b''
        while x > 127:
            out += bytes([x & 127 | 128])
            x >>= 7
        return out + bytes([x])
    text = e.type.encode('latin-1') + struct.pack('<IB', e.checksum, e.flags)
    return text + b''.join(varint(x) for x in (e.mesh, e.segment, e.size) if x is not None)


def joined(continuation, whole):
    """The file that a continuation is behind the file `whole` (05, section 8). Both are containers."""
    ours = [(e, continuation) for e in continuation.entries]
    cut = next((i for i, (e, _) in enumerate(ours) if e.segment is not None), len(ours))
    meshes = [(e, whole) for e in whole.entries if e.mesh is not None and e.segment is None]
    chunks = ours[:cut] + meshes + ours[cut:]
    table = b''.join(table_entry(e) for e, _ in chunks)
    payloads = b''.join(c.data[e.offset:e.offset + e.size] for e, c in chunks)
    head = MAGIC + continuation.data[8:12] + struct.pack(
        '<IQQ', len(chunks), continuation.features & ~1, 40 + len(table) + len(payloads))
    text = head + bytes(4) + struct.pack('<I', len(table)) + table
    return text[:32] + struct.pack('<I', checksum(text)) + text[36:] + payloads


def stream_files(data):
    """The files of a live stream, one after the other: bytes, decoded."""
    whole, at = None, 0
    while at < len(data) or at == 0:
        rest = data[at:]
        if at:
            need(rest[:8] == MAGIC[:len(rest)], 'TRAILING_BYTES')
        c = Container(rest, features=1, prefix=True)
        need(len(rest) >= c.size, 'TRUNCATED')
        c = Container(rest[:c.size], features=1)
        at += c.size
        if c.features & 1:
            need(whole is not None, 'FEATURE', 'a continuation without a file before it')
            limi = records.read_limi(c.chunk('LIMI'), c.features)
            need(limi.mesh_hash is not None, 'RECORD', 'mesh hash')
            need(limi.mesh_hash == whole.mesh_hash(), 'MESHES')
            yield File(joined(c, whole), size=c.size + whole.size)
        else:
            whole = c
            yield File(c.data)


def status_of(call):
    """OK and the result, or the error, of a call; what a hostile file should not reach is INTERNAL."""
    try:
        return call(), None
    except AnicError as error:
        return None, error
    except MemoryError:
        return None, AnicError('MEMORY')
