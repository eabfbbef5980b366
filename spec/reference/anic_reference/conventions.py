# SPDX-License-Identifier: CC0-1.0
"""Chapters 12 and 03: codes; types, varints, records as tables of fields, arithmetic; XXH64."""
import math
import struct
from types import SimpleNamespace
import numpy as np

CODES = {"MAGIC": 10, "VERSION": 11, "FEATURE": 12, "TRUNCATED": 20, "HEADER": 21, "HEADER_CHECKSUM": 22,
    "CHUNK_BOUNDS": 23, "CHUNK_CHECKSUM": 24, "CHUNK_DUPLICATE": 25, "CHUNK_MISSING": 26, "CHUNK_UNKNOWN": 27,
    "TRAILING_BYTES": 29, "FILE_SIZE": 30, "RECORD": 40, "ENTROPY": 41, "TOPOLOGY": 43, "INDEX_RANGE": 44,
    "QUANTIZER": 45, "NON_FINITE": 46, "SEGMENT": 48, "HASH": 49, "MESHES": 50, "SEGMENT_MISSING": 51, "LIMIT": 60, "MEMORY": 70,
    "READ": 71}

class Refused(Exception):                               # The file is refused with the code of that name
    def __init__(self, name, reason):
        super().__init__(reason)
        self.name, self.code = name, CODES[name]

def check(condition, name, reason=""):                  # Refuses the file unless the condition holds
    if not condition:
        raise Refused(name, reason)

TYPES = {"u8": "B", "u32": "I", "u64": "Q", "i32": "i", "f32": "f", "f64": "d"}

class Reader:  # Reads one field after the other; what does not fit is an error with the code of the record
    def __init__(self, data, code="RECORD"):
        self.data, self.position, self.code = data, 0, code
    left = lambda self: len(self.data) - self.position
    def bytes(self, count):
        check(count <= self.left(), self.code, "ends early")
        self.position += count
        return self.data[self.position - count:self.position]
    def varint(self, limit=2**64 - 1):
        value, i, byte = 0, 0, 0x80
        while byte >= 0x80:
            byte = self.bytes(1)[0]
            value, i = value | (byte & 0x7F) << 7 * i, i + 1
            check(i <= 10 and value <= limit and (byte or i == 1), self.code, "a varint too long or large")
        return value
    def field(self, kind):
        """A value of a type of section 1. A text is shown as so many characters as it has bytes."""
        if kind == "varint":
            return self.varint()
        if kind in ("text", "block", "rest"):
            value = self.bytes(self.left() if kind == "rest" else self.varint())
            return value.decode("latin-1") if kind == "text" else value
        kind, _, count = kind.rstrip("]").partition("[")
        form = f"<{count}{TYPES[kind]}"
        values = struct.unpack(form, self.bytes(struct.calcsize(form)))
        return list(values) if count else values[0]

def read_record(reader, table, **known):
    """Reads the fields of a table, whose rows are of two kinds:
    names, type, valid, code: fields of a type of section 1, or of what a function of reader and record reads;
        what must hold of each, a function of value and record; the code otherwise, RECORD if there is none
    condition, rows ..: rows that are there only if the function of the record says so, else values are None
    `known` is what these functions ask for beside the fields. RECORD comes before QUANTIZER."""
    record, wrong = SimpleNamespace(**known), []
    def read(rows, there):
        for first, *rest in rows:
            if callable(first):
                read(rest, there and first(record))
                continue
            kind, valid, code = (rest + [None, None])[:3]
            for name in first.split():
                value = None if not there else kind(reader, record) if callable(kind) else reader.field(kind)
                setattr(record, name, value)
                right = not (there and valid) or valid(value, record)
                check(right or code == "QUANTIZER", code or "RECORD", f"{name} is {value}")
                wrong.extend([] if right else [name])
    read(table, True)
    check(not wrong, "QUANTIZER", " ".join(wrong))
    return record

def read_whole(data, table, **known):                   # A record that fills its chunk
    reader = Reader(data)
    record = read_record(reader, table, **known)
    check(reader.left() == 0, "RECORD", "bytes are left over")
    return record

def array(kind, count, **known):
    """As the type of a field: so many values of a type, or records of a table. `count`, and what is `known`
    of the records, are functions of the record around."""
    def read(reader, record):
        of_record = {name: value(record) for name, value in known.items()}
        return [reader.field(kind) if isinstance(kind, str) else read_record(reader, kind, **of_record)
                for _ in range(count(record))]
    return read

quantizer = lambda names, kind, valid: (names, kind, valid, "QUANTIZER")
within = lambda low, high: lambda value, record: low <= value <= high
finite = lambda value, _=None: bool(np.isfinite(value).all())
not_negative = lambda value, _=None: finite(value) and np.min(value) >= 0
positive = lambda value, _=None: finite(value) and value > 0
ascend = lambda v, strictly=False: all(a < b or a == b and not strictly for a, b in zip(v, v[1:]))

clamp = lambda value, low, high: low if value < low else high if value > high else value
floor_log2 = lambda value: max(value.bit_length() - 1, 0)               # 0 for 0, too
sign = lambda value: (value > 0) - (value < 0)
toward_zero = lambda dividend, divisor: dividend // divisor if dividend >= 0 else -(-dividend // divisor)
int32 = lambda value: (value + 2**31 & 0xFFFFFFFF) - 2**31             # the low 32 bits as two's complement
# division as IEEE 754 has it, since Python refuses to divide by zero
divide = lambda x, divisor: x / divisor if divisor else x * math.copysign(math.inf, divisor)

def total(terms, start=0.0):
    """A sum from the left in one accumulator. sum() of Python may be more exact than that."""
    for term in terms:
        start = start + term
    return start

MASK = 2**64 - 1
P1, P2, P3, P4, P5 = (0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x85EBCA77C2B2AE63,
                      0x27D4EB2F165667C5)

def xxh64(data):                                        # XXH64 with seed 0
    rotate = lambda x, bits: (x << bits | x >> 64 - bits) & MASK
    mix = lambda state, word: rotate(state + word * P2 & MASK, 31) * P1 & MASK
    value, states, whole = P5, [P1 + P2 & MASK, P2, 0, -P1 & MASK], len(data) & ~31
    words = struct.unpack_from(f"<{len(data) // 8}Q", data)
    for i, word in enumerate(words[:whole // 8]):
        states[i & 3] = mix(states[i & 3], word)
    if whole:
        value = sum(rotate(state, bits) for state, bits in zip(states, (1, 7, 12, 18))) & MASK
        for state in states:
            value = ((value ^ mix(0, state)) * P1 + P4) & MASK
    value = value + len(data) & MASK
    for word in words[whole // 8:]:
        value = (rotate(value ^ mix(0, word), 27) * P1 + P4) & MASK
    if len(data) & 4:
        word = struct.unpack_from("<I", data, len(data) & ~7)[0]
        value = (rotate(value ^ word * P1 & MASK, 23) * P2 + P3) & MASK
    for byte in data[len(data) & ~3:]:
        value = rotate(value ^ byte * P5 & MASK, 11) * P1 & MASK
    value = (value ^ value >> 33) * P2 & MASK
    value = (value ^ value >> 29) * P3 & MASK
    return value ^ value >> 32
