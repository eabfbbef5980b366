#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Checks that the golden files are what they were, and decode to what they did.

usage: check.py SDK_DECODER TRACE_DECODER
Exit status 1 if a file here was changed, removed or added, or decodes to something else.
"""
import hashlib
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
TESTS = HERE.parent
# SHA-256 of SHA256SUMS: a change of the golden files would break the promise of spec/13, section 1.
FROZEN = "b547ff2c9c4180d2103d43e8de560f788aa6b9fb1811ca47e194afe7e37424fa"
FREE = {"README.md", "check.py", "SHA256SUMS"}


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def faults():
    """What is not as it was."""
    sums = HERE / "SHA256SUMS"
    if digest(sums) != FROZEN:
        yield "SHA256SUMS was changed"
    listed = {name: value for value, name in (line.split("  ") for line in sums.read_text(encoding="utf-8").splitlines())}
    there = {path.relative_to(HERE).as_posix(): path for path in HERE.rglob("*") if path.is_file()}
    for name in sorted((there.keys() | listed.keys()) - FREE):
        if name not in there:
            yield f"{name} was removed"
        elif name not in listed:
            yield f"{name} was added"
        elif digest(there[name]) != listed[name]:
            yield f"{name} was changed"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    changed = list(faults())
    print("\n".join(changed) if changed else "the golden files are what they were")
    decodes = subprocess.run([sys.executable, "-B", TESTS / "conformance" / "run.py", "--memory", "0", "--folder", HERE, sys.argv[1], "{file}",
                              "{out}"], check=False).returncode
    traces = subprocess.run([sys.executable, "-B", TESTS / "scripts" / "traces.py", "check", sys.argv[2], HERE], check=False).returncode
    sys.exit(1 if changed or decodes or traces else 0)


if __name__ == "__main__":
    main()
