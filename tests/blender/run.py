#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Runs the tests of the add-on in Blender, without a window.

usage: run.py CHECKOUT ENVIRONMENT WORK     ENVIRONMENT: of python.Wheel. Exit status 77: skipped, for the reason printed.
The variable ANICODEC_BPY names a Python that has bpy, to be used instead of Blender.
"""
import os
import pathlib
import shutil
import subprocess
import sys

SKIPPED = 77


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def take_package(environment, folder):
    """A copy of the package and its libraries alone: Blender has modules of its own."""
    found = list(environment.glob("lib/python*/site-packages/anicodec"))
    if not found:
        skip("the Python package was not made")
    shutil.rmtree(folder, ignore_errors=True)
    for name in ("anicodec", "anicodec.libs"):
        if (found[0].parent / name).is_dir():
            shutil.copytree(found[0].parent / name, folder / name)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    checkout, environment, work = (pathlib.Path(path).resolve() for path in sys.argv[1:])
    blender, python = shutil.which("blender"), os.environ.get("ANICODEC_BPY")
    if not (blender or python):
        skip("blender is not installed")
    take_package(environment, work / "site")
    script = checkout / "tests" / "blender" / "in_blender.py"
    files = work / "files"
    shutil.rmtree(files, ignore_errors=True)
    files.mkdir(parents=True)
    arguments = [work / "site", checkout / "bindings" / "blender", files]
    command = [python, script, *arguments] if python else \
        [blender, "-b", "--factory-startup", "--python-exit-code", "1", "-P", script, "--", *arguments]
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}
    if not python:  # a Python that comes first there would be taken for Blender's
        environment["PATH"] = "/usr/bin:/bin"
    result = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            env=environment)
    print(result.stdout[-6000:])
    if "No module named 'numpy'" in result.stdout:
        skip("Blender's Python has no numpy")
    if "No module named 'anicodec._anicodec'" in result.stdout:
        skip("the package was made for another Python than Blender's")
    sys.exit(result.returncode)


if __name__ == "__main__":
    main()
