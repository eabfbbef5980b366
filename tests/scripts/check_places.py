#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Compares the files that a page names with the files that have a pattern.

usage: check_places.py [--at CHECKOUT] PAGE PATTERN FOLDER...
The tables of PAGE name files in backquotes, as paths from the top of the checkout. Prints a line for each file below the
FOLDERs that has PATTERN, a regular expression, and is not named; for each file below them that is named and lacks it; and
ends with 1 if there is one.
"""
import pathlib
import re
import subprocess
import sys

NAME = re.compile(r"`([\w./-]+/[\w.-]+\.\w+)`")
ENDINGS = (".c", ".cpp", ".h", ".hpp", ".inc", ".py", ".js", ".ts", ".cs", ".rs")


def sources(checkout, folders):
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", *folders], cwd=checkout,
                            capture_output=True, text=True, check=False).stdout.split("\n")
    paths = [p for p in listed if p] or [p.relative_to(checkout).as_posix() for folder in folders
                                         for p in (checkout / folder).rglob("*")]
    return [p for p in paths if p.endswith(ENDINGS) and (checkout / p).is_file()]


def main():
    arguments, checkout = sys.argv[1:], pathlib.Path(".")
    if arguments[:1] == ["--at"]:
        checkout, arguments = pathlib.Path(arguments[1]), arguments[2:]
    if len(arguments) < 3:
        sys.exit(__doc__)
    page, pattern, folders = arguments[0], re.compile(arguments[1]), arguments[2:]
    rows = [line for line in (checkout / page).read_text(encoding="utf-8").split("\n") if line.startswith("|")]
    named = {name for row in rows for name in NAME.findall(row)}
    having = {p for p in sources(checkout, folders)
              if pattern.search((checkout / p).read_text(encoding="utf-8", errors="replace"))}
    below = {p for p in named if p.startswith(tuple(f"{folder}/" for folder in folders))}
    faults = [f"{page} does not name {path}" for path in sorted(having - named)]
    faults += [f"{path}, named by {page}, has no {arguments[1]}" for path in sorted(below - having)]
    print("\n".join(faults) or f"{page} names all {len(having)} files")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
