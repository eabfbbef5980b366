# SPDX-License-Identifier: CC0-1.0
"""Decodes an .anic file as a whole, checks it, and says what is in it."""
import argparse
import sys
from pathlib import Path
import numpy as np
from anic_reference.chunks import TYPES
from anic_reference.clip import decode, joined
from anic_reference.container import read_container, read_stream
from anic_reference.conventions import CODES, Refused
from anic_reference.output import write

def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--stream", action="store_true",
                        help="the files are those of a live stream, in order")
    parser.add_argument("-o", metavar="OUT", help="write OUT.pc2, OUT.obj and OUT.json")
    parser.add_argument("files", nargs="+", metavar="FILE")
    arguments = parser.parse_args()
    if len(arguments.files) > 1 and not arguments.stream:
        parser.error("several files need --stream")
    np.seterr(all="ignore")
    try:
        data = b"".join(Path(name).read_bytes() for name in arguments.files)
        files = read_stream(data, TYPES) if arguments.stream else [read_container(data, TYPES)]
        decoded = joined([decode(file) for file in files])
        if arguments.o:
            write(arguments.o, decoded)
    except (Refused, MemoryError, OSError) as error:
        name = error.name if isinstance(error, Refused) else "READ" if isinstance(error,
                                                                                  OSError) else "MEMORY"
        print(f"{name} ({CODES[name]}) {error}")
        return CODES[name]
    for clip, frames in zip(decoded.clip.clips, decoded.clip_frames):
        print(f"clip {clip.name!r}: {frames} frames, {clip.rate_numerator}/{clip.rate_denominator} a second")
    for mesh in decoded.meshes:
        print(f"mesh {mesh.name!r}: {len(mesh.coded)} vertices, {len(mesh.polygons)} polygons")
    return 0

if __name__ == "__main__":
    sys.exit(main())
