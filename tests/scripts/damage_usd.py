#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Opens damaged files through the plug-in of USD: damage_usd.py COUNT [SEED], in a Python with anicodec and usd-core.

Files of tests/conformance with bytes of a payload changed, cut or repeated, and all checksums made anew. Each is either a
layer whose samples can be asked for, or refused with one error of a line. A host that dies leaves the file that killed it:
damaged.anic in the folder for temporary files.
"""
import pathlib
import random
import resource
import sys
import tempfile

import anic_file

import anicodec.usd  # noqa: F401
from pxr import Tf, Usd

CONFORMANCE = pathlib.Path(__file__).resolve().parents[1] / "conformance"


def damage(chunks, numbers):
    chunk = numbers.choice([chunk for chunk in chunks if chunk.payload])
    payload = bytearray(chunk.payload)
    at = numbers.randrange(len(payload))
    way = numbers.randrange(4)
    if way == 0:
        for _ in range(numbers.choice((1, 1, 2, 8))):
            payload[numbers.randrange(len(payload))] = numbers.randrange(256)
    elif way == 1:
        payload[at] ^= 1 << numbers.randrange(8)
    elif way == 2:
        del payload[at:at + numbers.randrange(1, 9)]
    else:
        payload[at:at] = payload[at:at + numbers.randrange(1, 9)]
    chunk.payload = bytes(payload)


def ask(stage):
    """Asks for some samples of each attribute; what fails then is an error, too."""
    for prim in stage.Traverse():
        for attribute in prim.GetAuthoredAttributes():
            try:
                codes = attribute.GetTimeSamples()
                for code in codes[:1] + codes[len(codes) // 2:][:1] + codes[-1:]:
                    attribute.Get(code)
                attribute.Get()
            except Tf.ErrorException:
                pass


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    numbers = random.Random(int(sys.argv[2]) if len(sys.argv) == 3 else 1)
    resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))
    sources = [path.read_bytes() for path in sorted(CONFORMANCE.glob("*.anic")) if path.stat().st_size < 100_000]
    path = pathlib.Path(tempfile.gettempdir()) / "damaged.anic"
    opened = refused = 0
    for _ in range(int(sys.argv[1])):
        data = numbers.choice(sources)
        chunks = anic_file.read_chunks(data)
        for _ in range(numbers.choice((1, 1, 1, 2, 3))):
            damage(chunks, numbers)
        path.write_bytes(anic_file.write_chunks(chunks, needs=anic_file.features(data)))
        try:
            stage = Usd.Stage.Open(str(path))
        except Tf.ErrorException as error:
            told = str(error).strip().splitlines()
            if len(told) != 2 or f"{path}: " not in told[0]:
                sys.exit(f"{path}: is refused by {told}")
            refused += 1
            continue
        opened += 1
        ask(stage)
        del stage
    path.unlink(missing_ok=True)
    print(f"{opened} damaged files opened, {refused} refused, none killed the host")


if __name__ == "__main__":
    main()
