#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Checks that every header compiles alone: it includes all that it names.

A header that the source of its name includes first shows so in a build of preset asan, which compiles each source alone. The
others are compiled one by one, by the command of a source of their folder or of one above it.

usage: check_headers.py CHECKOUT COMPILE_COMMANDS.json      one line for every fault; exit status 1 if there is any
"""
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

MODULES = ("format", "sdk", "codec", "corpus", "tools", "bindings")
# Not ours to compile: programs of a host, stand-ins for a library's headers, what wants headers of Python, OpenUSD or Unreal, or a
# compiler of wasm32; and a public header that a test compiles in every language.
EXCEPT = ("sdk/examples/", "sdk/draco_headers/", "bindings/python/", "bindings/usd/", "bindings/web/", "bindings/engines/unreal/", "codec/include/")
FIRST_INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]*)[">]', re.MULTILINE)


def is_shown(checkout, header):
    """Whether the source of its name includes the header before anything else."""
    source = (checkout / header).with_suffix(".cpp")
    if not source.is_file():
        return False
    first = FIRST_INCLUDE.search(source.read_text(encoding="utf-8"))
    return first is not None and first.group(1) == header


def folder_of(entry, checkout, build):
    """The folder of a source; of one that CMake made of several, that of their library."""
    path = pathlib.Path(entry["file"])
    if not path.is_relative_to(build):
        return path.parent
    parts = path.relative_to(build).parts
    return checkout.joinpath(*parts[:parts.index("CMakeFiles")]) if "CMakeFiles" in parts else path.parent


def lone_headers(checkout):
    for module in MODULES:
        headers = (p for p in (checkout / module).rglob("*.h") if "node_modules" not in p.parts)
        for path in sorted(headers):
            header = path.relative_to(checkout).as_posix()
            if not header.startswith(EXCEPT) and not is_shown(checkout, header):
                yield header


def command_for(checkout, header, commands, build):
    """The command of the source with the most folders in common, made to compile a text from the standard input."""
    folder = (checkout / header).parent
    while folder != checkout.parent:
        for entry in commands:
            if folder_of(entry, checkout, build).is_relative_to(folder):
                words = entry.get("arguments") or shlex.split(entry["command"])
                kept, skip = [], False
                for word in words:
                    if skip or word in ("-c", entry["file"]):
                        skip = False
                    elif word in ("-o", "-MF", "-MT", "-MQ"):
                        skip = True
                    elif not word.endswith("ccache") and word not in ("-MD", "-MMD"):
                        kept.append(word)
                # A header that is the main file would warn of what only others use.
                return [*kept, "-w", "-fsyntax-only", "-x", "c++", "-"], entry["directory"]
        folder = folder.parent
    return None, None


def fault(checkout, header, commands, build):
    command, directory = command_for(checkout, header, commands, build)
    if command is None:
        return f"{header}: no source near it is built"
    include = header.split("include/", 1)[-1] if "/include/" in header else header
    run = subprocess.run(command, cwd=directory, input=f'#include "{include}"\n', text=True, capture_output=True,
                         check=False)
    errors = [line for line in run.stderr.splitlines() if "error" in line]
    return None if run.returncode == 0 else f"{header} does not compile alone: {errors[0] if errors else run.stderr}"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    checkout = pathlib.Path(sys.argv[1]).resolve()
    commands = json.loads(pathlib.Path(sys.argv[2]).read_text(encoding="utf-8"))
    build = pathlib.Path(sys.argv[2]).resolve().parent
    headers = list(lone_headers(checkout))
    if not headers:
        sys.exit(f"{checkout} has no headers")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        faults = [f for f in pool.map(lambda h: fault(checkout, h, commands, build), headers) if f]
    print("\n".join(faults) if faults else f"{len(headers)} headers compile alone, the others come first in a source")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
