#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Whether every C and C++ file of a checkout is as clang-format 14, Debian 12's, leaves it.

usage: check_format.py CHECKOUT

Prints a line for each file that differs and ends with 1; with 77 where there is no clang-format 14, since
other versions break lines elsewhere.
"""
import pathlib
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

VERSION = "14"
MODULES = ("format", "sdk", "codec", "tools", "corpus", "bindings", "tests")
ENDINGS = {".c", ".cpp", ".h"}
BATCH = 50  # files a run: starting the program costs as much as a small file
NOT_OURS = {"node_modules", "build", "target", "__pycache__"}


def find_program():
    for name in ("clang-format-" + VERSION, "clang-format"):
        program = shutil.which(name)
        if not program:
            continue
        version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout
        if re.search(rf"version {VERSION}\.", version):
            return program
    return None


def sources(checkout):
    for module in MODULES:
        for path in sorted((checkout / module).rglob("*")):
            if path.suffix in ENDINGS and not NOT_OURS & set(path.relative_to(checkout).parts):
                yield path


def main():
    checkout = pathlib.Path(sys.argv[1])
    program = find_program()
    if not program:
        print(f"no clang-format {VERSION} is installed")
        return 77

    def differing(batch):
        run = subprocess.run([program, "--dry-run", *map(str, batch)], capture_output=True, text=True)
        return {line.split(":")[0] for line in run.stderr.splitlines() if "-Wclang-format-violations" in line}

    files = list(sources(checkout))
    batches = [files[i:i + BATCH] for i in range(0, len(files), BATCH)]
    with ThreadPoolExecutor() as pool:
        wrong = sorted(set().union(*pool.map(differing, batches)))
    for path in wrong:
        print(f"{pathlib.Path(path).relative_to(checkout)} is not formatted: clang-format -i it")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
