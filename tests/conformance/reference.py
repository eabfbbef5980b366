#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Runs spec/reference on the conformance files, and on random ones.

usage: reference.py BUILD COUNT FOLDER      COUNT random files, made in FOLDER by the programs of BUILD
exit status 77: there is no Python with numpy
"""
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
DECODER = HERE.parents[1] / "spec" / "reference" / "decode.py"
LACKS = ["--without", "draco", "--without", "interpolation", "--without", "learning"]


def decoder(file, out):
    """The command that decodes a file or a stream; exits if there is no Python with numpy."""
    for python in (sys.executable, "/usr/bin/python3"):
        if subprocess.run([python, "-c", "import numpy"], stderr=subprocess.DEVNULL, check=False).returncode == 0:
            return [python, "-B", DECODER, "--stream", file, "-o", out]
    print("skipped: there is no Python with numpy")
    sys.exit(77)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    command = decoder("{file}", "{out}")
    fixed = subprocess.run([sys.executable, HERE / "run.py", *LACKS, *command], check=False)
    made = subprocess.run([sys.executable, HERE / "generate.py", *sys.argv[1:], *LACKS, *command], check=False)
    sys.exit(fixed.returncode or made.returncode)


if __name__ == "__main__":
    main()
