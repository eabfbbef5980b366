#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Gives damaged copies of files to `anicodec encode`: each becomes a clip, or is refused with one line that names it.

usage: damage_inputs.py ANICODEC FILE... [--count N] [--seed S]
Copy i of seed S is the one of seed S + i, so that `--count 1 --seed K` repeats one. Meant for formats that the libFuzzer
targets leave out, as other libraries read them in processes of their own (FBX, MD2, Collada), and for whole
programs under sanitizers. Exit status 1 if a run ends by a signal, takes longer than a minute of processor time and
a bit, says nothing, or leaves a file behind.
"""
import argparse
import collections
import os
import pathlib
import random
import re
import resource
import struct
import subprocess
import sys
import tempfile

SECONDS = 90  # of the processor: importers in processes of their own may take 60
NUMBERS = (0, 1, 2, 3, 127, 128, 255, 256, 32767, 65535, 65536, 2**24, 2**31 - 1, 2**31, 2**32 - 1)
FLOATS = (0.0, -0.0, 1e-40, 1e20, 3e38, float("inf"), float("nan"))
WORDS = (b"0", b"-1", b"1e20", b"1e-40", b"nan", b"99999999999999999999", b"4294967295", b"", b"{", b"}", b"\"", b"<", b"%s%n")
DONE, INPUT, KIND = 0, 2, 4  # exit statuses: 2 bad input, 4 a kind of file that is not read
TAKEN, REFUSED = "taken", "refused"


def damaged(data, chance):
    """A copy with one to four changes."""
    data = bytearray(data)
    for _ in range(chance.randint(1, 4)):
        at = chance.randrange(len(data) + 1)
        span = chance.randrange(1, 32)
        change = chance.randrange(9)
        if change == 0 and at < len(data):
            data[at] ^= 1 << chance.randrange(8)
        elif change == 1:
            del data[at:at + span]
        elif change == 2:
            data[at:at] = data[at:at + span]
        elif change == 3:
            other = chance.randrange(len(data) + 1)
            data[at:at + span] = data[other:other + span]
        elif change == 4 and chance.random() < 0.2:
            del data[at:]
        elif change == 5:
            width, order = chance.choice("BHIQ"), chance.choice("<>")
            number = struct.pack(f"{order}{width}", chance.choice(NUMBERS) % (1 << 8 * struct.calcsize(width)))
            data[at:at + len(number)] = number
        elif change == 6:
            data[at:at + 4] = struct.pack("<f", chance.choice(FLOATS))
        elif change == 7 and (old := re.compile(rb"-?[0-9][0-9.e+-]*").search(data, at)):
            data[old.start():old.end()] = chance.choice(WORDS)
        elif change == 8 and (word := re.compile(rb"[A-Za-z]{3,}").search(data, at)):
            other = re.compile(rb"[A-Za-z]{3,}").search(data, chance.randrange(len(data)))
            data[word.start():word.end()] = other.group() if other else b""
    return bytes(data)


def fault(result, name, folder):
    """The fault of a run; nothing if it is as it should be."""
    text = result.stderr.decode(errors="replace")
    if result.returncode not in (DONE, INPUT, KIND):
        return f"status {result.returncode}: {text[-2000:]}"
    if result.returncode != DONE and (not text.strip() or name not in text):
        return f"no reason that names the file: {text!r}"
    if re.search("[\x00-\x08\x0b-\x1f\x7f]", text):
        return f"control characters: {text!r}"
    left = {p.name for p in folder.iterdir()} - {name, "out.anic"}
    return f"{sorted(left)} stay" if left else None


def run(command, source, seed):
    """Outcome of a copy, and its fault."""
    chance = random.Random(f"{seed} {source.name}")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        name = f"damaged{source.suffix}"
        (folder / name).write_bytes(damaged(source.read_bytes(), chance))
        limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
        result = subprocess.run([command, "encode", "-q", "-j1", folder / name, "-o", folder / "out.anic"], check=False,
                                capture_output=True, preexec_fn=limit, env=os.environ)
        return (TAKEN if result.returncode == DONE else REFUSED), fault(result, name, folder)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("anicodec", type=pathlib.Path)
    parser.add_argument("files", type=pathlib.Path, nargs="+")
    parser.add_argument("--count", type=int, default=1000, help="copies in all")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    command, faults = arguments.anicodec.resolve(), 0
    counts = collections.Counter()
    for seed in range(arguments.seed, arguments.seed + arguments.count):
        source = arguments.files[seed % len(arguments.files)]
        outcome, wrong = run(command, source, seed)
        counts[source.suffix, outcome] += 1
        if wrong:
            faults += 1
            print(f"seed {seed}, {source}: {wrong}", flush=True)
    print(", ".join(f"{count} {suffix} {outcome}" for (suffix, outcome), count in sorted(counts.items())) + f"; {faults} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
