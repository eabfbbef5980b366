#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Runs clang-tidy 14, Debian 12's, by .clang-tidy over what a build compiles of some modules.

usage: check_tidy.py CHECKOUT COMPILE_COMMANDS.json MODULE...      as: check_tidy.py . build/dev/compile_commands.json format sdk

Prints each finding once and ends with 1 if there is one; with 77 where there is no clang-tidy 14, since other versions find
other things. Builds by rooms have few, large sources: format takes 18 seconds of processor time, the whole tree 25 minutes or so.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

VERSION = "14"
FINDING = re.compile(r"^(/[^:\n]+):(\d+):\d+: (?:warning|error): (.*)$", re.MULTILINE)


def find_program():
    for name in ("clang-tidy-" + VERSION, "clang-tidy"):
        program = shutil.which(name)
        if program and f"version {VERSION}." in subprocess.run([program, "--version"], capture_output=True, text=True).stdout:
            return program
    return None


def sources(checkout, commands, modules):
    """The sources of modules, those that CMake made of a room among them."""
    build = commands.parent
    for entry in json.loads(commands.read_text(encoding="utf-8")):
        path = pathlib.Path(entry["file"])
        below = path.relative_to(build) if path.is_relative_to(build) else path.relative_to(checkout) \
            if path.is_relative_to(checkout) else path
        if below.parts[0] in modules and "third_party" not in path.parts and path.suffix != ".c":
            yield str(path)


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    program = find_program()
    if not program:
        print(f"there is no clang-tidy {VERSION}")
        return 77
    checkout, commands = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    files = sorted(set(sources(checkout, commands, sys.argv[3:])))
    if not files:
        sys.exit(f"{commands} compiles nothing of {' '.join(sys.argv[3:])}")

    def run(file):
        return subprocess.run([program, "--quiet", "--extra-arg=-Wno-unknown-warning-option", "--extra-arg=-Wno-error", "-p", commands.parent, file], cwd=checkout, capture_output=True, text=True)

    findings, failed = set(), []
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for file, result in zip(files, pool.map(run, files)):
            found = [(str(pathlib.Path(path).relative_to(checkout)), int(line), text) for path, line, text
                     in FINDING.findall(result.stdout) if pathlib.Path(path).is_relative_to(checkout)]
            findings.update(found)
            if result.returncode != 0 and not found:
                failed.append(f"{file}: {result.stdout}{result.stderr[-2000:]}")
    for path, line, text in sorted(findings):
        print(f"{path}:{line}: {text}")
    print("\n".join(failed) or f"{len(findings)} findings in {len(files)} sources")
    return 1 if findings or failed else 0


if __name__ == "__main__":
    sys.exit(main())
