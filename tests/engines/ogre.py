#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Runs the tests of the plug-in for OGRE and its example, in a display of their own where there is none.

usage: ogre.py TESTS EXAMPLE PLUGIN CHECKOUT WORK      exit status 77: skipped, for the reason printed
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

import picture

SKIPPED, NO_DISPLAY = 77, 3
FILES = ("limb_default", "limb_effort9", "vertex_order")


def run(*command):
    environment = {**os.environ, "LIBGL_ALWAYS_SOFTWARE": "1"}
    prefix = [] if environment.get("DISPLAY") else ["xvfb-run", "-a"]
    result = subprocess.run([*prefix, *map(str, command)], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            env=environment)
    print(result.stdout, end="")
    if result.returncode == NO_DISPLAY:
        print("skipped: nothing draws here")
        sys.exit(SKIPPED)
    if result.returncode != 0:
        sys.exit(f"{command[0]}: exit status {result.returncode}")
    return result.stdout


def main():
    if len(sys.argv) != 6:
        sys.exit(__doc__)
    tests, example, plugin, checkout, work = (pathlib.Path(path).resolve() for path in sys.argv[1:])
    if not os.environ.get("DISPLAY") and not shutil.which("xvfb-run"):
        print("skipped: there is no display, and no xvfb-run (Debian: xvfb xauth)")
        sys.exit(SKIPPED)
    if "sanitize" in (example.parents[2] / "CMakeCache.txt").read_text(encoding="utf-8", errors="replace"):
        print("skipped: graphics drivers leak")
        sys.exit(SKIPPED)
    work.mkdir(parents=True, exist_ok=True)
    files = [checkout / "tests" / "conformance" / f"{name}.anic" for name in FILES]
    faults = []
    for name, options in (("ogre_cpu", []), ("ogre_card", ["--card"]), ("ogre_motion", ["--motion"])):
        text = run(example, *options, "--picture", work / f"{name}.ppm", *files)
        # A frame with corrections is made on the CPU.
        on_card = int(re.search(r"9 entities, (\d) on the card", text)[1])
        assert on_card >= 7 if "--card" in options else on_card == 0, text
        faults.append(picture.compare(work / f"{name}.ppm", name))
    assert "Anic" in run(example, "--plugin", plugin, files[0])
    run(tests, "--gtest_brief=1")
    if any(faults):
        sys.exit("\n".join(filter(None, faults)))


if __name__ == "__main__":
    main()
