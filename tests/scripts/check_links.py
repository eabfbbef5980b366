#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Checks that the targets named by the project's Markdown pages exist: relative links, source files in backquotes, and the
pages that the contents of the site name, which its build makes in part.

usage: check_links.py FOLDER      prints a line for each that is missing; exit status 1 if there is one
"""
import pathlib
import re
import subprocess
import sys

LINK = re.compile(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)")
SOURCE = re.compile(r"`((?:[a-z0-9_.-]+/)+[a-z0-9_.-]+\.(?:h|hpp|cpp|c|py|md))`")
CONTENTS = "docs/site/index.md"
ENTRY = re.compile(r"\{doc\}`(?:[^<`]*<)?/([^>`]+)>?`|^(?:[^`{|\n]*<)?([\w./-]+)>?$", re.M)
MADE = ("gallery", "reference/gpu", "reference/play", "reference/stream", "reference/surface", "reference/encode", "reference/javascript/")


def missing(root, page):
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.S)
    for link in LINK.findall(text):
        if not (page.parent / link).exists():
            yield link
    for source in SOURCE.findall(text):
        if not (root / source).exists() and not (page.parent / source).exists():
            yield source


def missing_entries(root):
    if not (root / CONTENTS).exists():
        return
    text = (root / CONTENTS).read_text(encoding="utf-8")
    tables = "\n".join(re.findall(r"```\{toctree\}\n(.*?)```", text, re.S))
    entries = [a or b for a, b in ENTRY.findall(tables)] + [a for a, _ in ENTRY.findall(text) if a]
    for entry in entries:
        if not entry.startswith(MADE) and not any((root / place / f"{entry}.md").exists() for place in ("", "docs/site")):
            yield entry


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    pages = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.md"], cwd=root,
                           capture_output=True, text=True, check=False).stdout.split()
    pages = pages or [str(p.relative_to(root)) for p in root.rglob("*.md") if "build" not in p.parts]
    faults = [f"{page}: {target} does not exist" for page in pages for target in missing(root, root / page)]
    faults += [f"{CONTENTS}: {entry}.md does not exist" for entry in missing_entries(root)]
    print("\n".join(faults) or f"{len(pages)} pages, all links lead somewhere")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
