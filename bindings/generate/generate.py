#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Writes what languages declare of the interface, from the public headers.

usage: generate.py [--check]      exit status 1 of --check: a file is not what would be written
"""
import pathlib
import sys

import csharp
import headers
import options
import python
import web

WRITERS = (csharp, python, web, options)


def main() -> int:
    if sys.argv[1:] not in ([], ["--check"]):
        sys.exit(__doc__)
    checkout = pathlib.Path(__file__).resolve().parents[2]
    interface = headers.read(checkout)
    stale = []
    for writer in WRITERS:
        for path, text in writer.write(interface).items():
            if len(sys.argv) == 1:
                (checkout / path).write_text(text, encoding="utf-8")
            elif not (checkout / path).exists() or (checkout / path).read_text(encoding="utf-8") != text:
                stale.append(path)
    for path in stale:
        print(f"{path} is not what the headers say: run bindings/generate/generate.py")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
