#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Runs the examples crowd and draw on conformance files: positions of the shader against the library's, and the pictures.

usage: crowd.py PROGRAM CHECKOUT WORK      PROGRAM: crowd, draw beside it; exit status 77: skipped, for the reason printed
"""
import pathlib
import sys

import drawing
import picture

FILES = ("limb_default", "heated", "weights_in_time", "schedules", "other_parents")


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    program, checkout, work = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
    drawing.skip_if_sanitized(program)
    work.mkdir(parents=True, exist_ok=True)
    files = [checkout / "tests" / "conformance" / f"{name}.anic" for name in FILES]
    for name, options in (("crowd", []), ("crowd_es", ["--es"])):
        text = drawing.run(program, *options, "--instances", 60, "--frames", 2, "--size", 480, "--check",
                           "--picture", work / f"{name}.ppm", *files, SDL_VIDEODRIVER="offscreen")
        assert "60 instances of 5 clips" in text and "5 calls" in text, text
        fault = picture.compare(work / f"{name}.ppm", "crowd")
        if fault:
            sys.exit(fault)
    drawing.run(program.with_name(program.name.replace("crowd", "draw")), files[0], 5, work / "draw.ppm",
                SDL_VIDEODRIVER="offscreen")
    if fault := picture.compare(work / "draw.ppm", "draw"):
        sys.exit(fault)


if __name__ == "__main__":
    main()
