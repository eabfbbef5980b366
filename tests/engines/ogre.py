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
import sys

import drawing
import picture

FILES = ("limb_default", "limb_effort9", "vertex_order")


def main():
    if len(sys.argv) != 6:
        sys.exit(__doc__)
    tests, example, plugin, checkout, work = (pathlib.Path(path).resolve() for path in sys.argv[1:])
    display = [] if os.environ.get("DISPLAY") else ["xvfb-run", "-a"]
    if display and not shutil.which(display[0]):
        drawing.skip("there is no display, and no xvfb-run (Debian: xvfb xauth)")
    drawing.skip_if_sanitized(example)
    work.mkdir(parents=True, exist_ok=True)
    files = [checkout / "tests" / "conformance" / f"{name}.anic" for name in FILES]
    faults = []
    for name, options in (("ogre_cpu", []), ("ogre_card", ["--card"]), ("ogre_motion", ["--motion"])):
        text = drawing.run(*display, example, *options, "--picture", work / f"{name}.ppm", *files)
        # A frame with corrections is made on the CPU.
        on_card = int(re.search(r"9 entities, (\d) on the card", text)[1])
        assert on_card >= 7 if "--card" in options else on_card == 0, text
        faults.append(picture.compare(work / f"{name}.ppm", name))
    assert "Anic" in drawing.run(*display, example, "--plugin", plugin, files[0])
    drawing.run(*display, tests, "--gtest_brief=1")
    if any(faults):
        sys.exit("\n".join(filter(None, faults)))


if __name__ == "__main__":
    main()
