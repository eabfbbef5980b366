# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Parts of the format that a decoder may lack, and which of them a file needs."""
import struct

import anic_file

FEATURES = {1: "draco", 2: "interpolation", 3: "learning"}  # bits of the header
PARTS_OF_CHUNKS = {"ATTR": "attributes", "DIFF": "exact", "BNDS": "bounds", "META": "metadata"}


def needs(parts):
    """The field of MANIFEST for parts that a decoder may lack."""
    return [f"needs={','.join(parts)}"] if parts else []


def features_of(data):
    """The parts that the header names."""
    bits = struct.unpack_from("<Q", data, 16)[0] if len(data) >= 24 else 0
    return [part for bit, part in FEATURES.items() if bits >> bit & 1]


def parts_of(data, *parts):
    """The parts that a decoder needs to show a good file in full; `parts`: the parts of its fields."""
    kinds = {chunk.type for chunk in anic_file.read_chunks(data)}
    return features_of(data) + [part for kind, part in PARTS_OF_CHUNKS.items() if kind in kinds] + list(parts)
