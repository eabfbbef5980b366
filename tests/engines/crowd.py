#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Runs the crowd example on conformance files: positions of the shader against the library's, and the picture.

usage: crowd.py PROGRAM CHECKOUT WORK      exit status 77: skipped, for the reason printed
"""
import os
import pathlib
import subprocess
import sys

import picture

SKIPPED, NO_DISPLAY = 77, 3
FILES = ("limb_default", "heated", "weights_in_time", "schedules", "other_parents")


def run(program, *options):
    environment = {**os.environ, "SDL_VIDEODRIVER": "offscreen", "LIBGL_ALWAYS_SOFTWARE": "1"}
    result = subprocess.run([program, *map(str, options)], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            env=environment)
    print(result.stdout, end="")
    if result.returncode == NO_DISPLAY:
        print("skipped: nothing draws here")
        sys.exit(SKIPPED)
    if result.returncode != 0:
        sys.exit(f"exit status {result.returncode}")
    return result.stdout


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    program, checkout, work = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
    if "sanitize" in (program.parents[2] / "CMakeCache.txt").read_text(encoding="utf-8", errors="replace"):
        print("skipped: graphics drivers leak")
        sys.exit(SKIPPED)
    work.mkdir(parents=True, exist_ok=True)
    files = [checkout / "tests" / "conformance" / f"{name}.anic" for name in FILES]
    text = run(program, "--instances", 60, "--frames", 2, "--size", 480, "--check", "--picture", work / "crowd.ppm", *files)
    assert "60 instances of 5 clips" in text and "5 calls" in text, text
    run(program, "--es", "--instances", 60, "--frames", 2, "--size", 480, "--check", "--picture", work / "crowd_es.ppm", *files)
    for name in ("crowd", "crowd_es"):
        fault = picture.compare(work / f"{name}.ppm", "crowd")
        if fault:
            sys.exit(fault)


if __name__ == "__main__":
    main()
