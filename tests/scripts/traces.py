#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Writes or checks traces: the integers of each step of decoding the valid files of a folder.

usage: traces.py write|check TRACE_DECODER [FOLDER]
FOLDER: tests/conformance unless given. write: those that are not there yet. check: one line for every difference; exit status 1 if there is any. Positions are not compared: run.py does that.
"""
import pathlib
import subprocess
import sys

CONFORMANCE = pathlib.Path(__file__).resolve().parents[1] / "conformance"


def trace(decoder, path):
    return subprocess.run([decoder, path], check=True, capture_output=True, text=True).stdout


def integers(text):
    return [line for line in text.splitlines() if not line.startswith("positions")]


def write(decoder, folder):
    (folder / "traces").mkdir(exist_ok=True)
    for path in sorted(folder.glob("*.anic")):
        stored = folder / "traces" / f"{path.stem}.txt"
        if not stored.exists():
            stored.write_text(trace(decoder, path))


def faults(decoder, folder):
    for path in sorted(folder.glob("*.anic")):
        stored = folder / "traces" / f"{path.stem}.txt"
        if not stored.exists():
            yield f"{path.name} has no trace"
            continue
        expected, found = integers(stored.read_text()), integers(trace(decoder, path))
        for number, (a, b) in enumerate(zip(expected + [""] * len(found), found + [""] * len(expected))):
            if a != b:
                yield f"{stored.name}: step {number} is \"{b}\", not \"{a}\""
                break


def main():
    if len(sys.argv) not in (3, 4) or sys.argv[1] not in ("write", "check"):
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[3]) if len(sys.argv) == 4 else CONFORMANCE
    if sys.argv[1] == "write":
        write(sys.argv[2], folder)
        return
    lines = list(faults(sys.argv[2], folder))
    print("\n".join(lines) if lines else "every step is as before")
    sys.exit(1 if lines else 0)


if __name__ == "__main__":
    main()
