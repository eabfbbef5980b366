# SPDX-License-Identifier: CC0-1.0
"""Chapter 05: header, table, checking order. Chapter 06, section 1: which chunks belong where."""
from collections import namedtuple
from .common import AnicError, Reader, checksum, need, xxh64

MAGIC = b'\x89ANI\r\n\x1a\n'
MAJOR = 1
FEATURES = 0                                         # no feature: Draco, interpolation and continuations are refused
REQUIRED, OF_MESH, OF_SEGMENT, COPIED = 1, 2, 4, 8
KNOWN = {'LIMI': REQUIRED, 'CLIP': REQUIRED, 'MESH': REQUIRED, 'VMAP': REQUIRED, 'FMAP': REQUIRED, 'POSE': REQUIRED,
         'SEGM': REQUIRED, 'BASI': REQUIRED, 'CORR': REQUIRED, 'ATTR': 0, 'ROOT': REQUIRED, 'DIFF': REQUIRED,
         'META': COPIED, 'BNDS': COPIED}             # type: flags that it must have
WHOLE = ('LIMI', 'CLIP', 'ROOT', 'META')
PER_MESH = ('MESH', 'VMAP', 'FMAP', 'ATTR')
PER_SEGMENT = ('SEGM', 'BASI', 'CORR', 'DIFF', 'BNDS')
Entry = namedtuple('Entry', 'type checksum flags mesh segment offset size')


class Container:
    """A file whose header and table are in order. Payloads are checked when they are first needed."""

    def __init__(self, data, features=FEATURES, prefix=False):
        self.data = data
        length = len(data)
        need(length and data[:8] == MAGIC[:length], 'MAGIC')
        need(length >= 40, 'TRUNCATED')
        r = Reader(data[8:40])
        version = (r.u16(), r.u16())
        count, self.features, self.size, stated, table_bytes = r.u32(), r.u64(), r.u64(), r.u32(), r.u32()
        need(version[0] == MAJOR, 'VERSION')
        end = 40 + table_bytes
        if end > length:
            raise AnicError('TRUNCATED' if self.size > length else 'HEADER')
        need(checksum(data[:32] + bytes(4) + data[36:end]) == stated, 'HEADER_CHECKSUM')
        missing = self.features & ~features
        need(not missing, 'FEATURE', 'feature bit %d' % ((missing & -missing).bit_length() - 1))
        if not prefix:
            need(self.size <= length, 'TRUNCATED')
            need(self.size >= length, 'TRAILING_BYTES')
        need(10 * count <= table_bytes, 'HEADER')
        self.entries, self.checked = [], set()
        r, at = Reader(data[40:end], 'HEADER'), end
        for _ in range(count):
            kind, summed, flags = r.take(4), r.u32(), r.u8()
            # The checks of an entry: its bytes first, then the flags, then its place (05, section 5).
            mesh = r.varint(65534) if flags & OF_MESH else None
            segment = r.varint(2 ** 32 - 2) if flags & OF_SEGMENT else None
            size = r.varint()
            need(flags < 16, 'HEADER', 'reserved flag')
            need(at <= self.size and size <= self.size - at, 'CHUNK_BOUNDS')
            self.entries.append(Entry(kind.decode('latin-1'), summed, flags, mesh, segment, at, size))
            at += size
        need(r.left() == 0, 'HEADER')
        need(at == self.size, 'FILE_SIZE')
        for e in self.entries:
            need(e.type in KNOWN or not e.flags & REQUIRED, 'CHUNK_UNKNOWN', e.type)
        self.index = {}
        for e in self.entries:
            if e.type in KNOWN:
                same = self.index.setdefault((e.type, e.mesh, e.segment), [])
                need(not same or e.type == 'BASI', 'CHUNK_DUPLICATE', e.type)
                same.append(e)

    def has(self, kind, mesh=None, segment=None):
        return (kind, mesh, segment) in self.index

    def payload(self, entry):
        """Payload of an entry; the checksum is compared first."""
        data = self.data[entry.offset:entry.offset + entry.size]
        if entry.offset not in self.checked:
            need(checksum(data) == entry.checksum, 'CHUNK_CHECKSUM', entry.type)
            self.checked.add(entry.offset)
        return data

    def chunk(self, kind, mesh=None, segment=None):
        """Payload of the only chunk of this kind: CHUNK_MISSING if it is not there."""
        need(self.has(kind, mesh, segment), 'CHUNK_MISSING', kind)
        return self.payload(self.index[kind, mesh, segment][0])

    def chunks(self, kind, mesh=None, segment=None):
        return [self.payload(e) for e in self.index.get((kind, mesh, segment), [])]

    def mesh_hash(self):
        """Mesh hash (05, section 8) of this file."""
        text = b''
        for e in self.entries:
            if e.mesh is not None and e.segment is None:
                data = self.data[e.offset:e.offset + e.size]
                text += e.type.encode('latin-1') + e.mesh.to_bytes(4, 'little') + xxh64(data).to_bytes(8, 'little')
        return xxh64(text)


def check_places(container, limi, order):
    """06, section 1: every known chunk is where it belongs (INDEX_RANGE), and all that must be are there."""
    for e in container.entries:
        if e.type not in KNOWN:
            continue
        good = e.flags & (REQUIRED | COPIED) == KNOWN[e.type]
        mesh = limi.meshes[e.mesh] if e.mesh is not None and e.mesh < len(limi.meshes) else None
        part = limi.segments[e.segment] if e.segment is not None and e.segment < len(limi.segments) else None
        if e.type in WHOLE:
            good = good and e.mesh is None and e.segment is None and (e.type != 'ROOT' or limi.root_frames > 0)
        elif e.type in PER_MESH or e.type == 'POSE' and e.segment is None:
            good = good and mesh is not None and e.segment is None
            good = good and (e.type != 'VMAP' or order != 1) and (e.type != 'FMAP' or order == 2)
            good = good and (e.type != 'ATTR' or mesh.attributes > 0)
        else:
            good = good and part is not None and e.mesh == part.mesh
            good = good and (e.type not in ('BASI', 'POSE') or part.kind > 0)
            good = good and (e.type not in ('BNDS', 'POSE') or not part.moves_attribute)
            good = good and (e.type != 'CORR' or part.corrections > 0) and (e.type != 'DIFF' or part.exact)
        need(good, 'INDEX_RANGE', 'chunk %s of mesh %s, segment %s' % (e.type, e.mesh, e.segment))

    def must(kind, *where):
        need(container.has(kind, *where), 'CHUNK_MISSING', '%s %s' % (kind, where))

    if limi.root_frames:
        must('ROOT')
    for m, mesh in enumerate(limi.meshes):
        must('MESH', m)
        if mesh.attributes:
            must('ATTR', m)
        if order != 1:
            must('VMAP', m)
        if order == 2:
            must('FMAP', m)
    for s, part in enumerate(limi.segments):
        must('SEGM', part.mesh, s)
        if part.corrections:
            must('CORR', part.mesh, s)
        if part.exact:
            must('DIFF', part.mesh, s)
