#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Runs the commands of a page of docs/howto/.

usage: run_howto.py FOLDER[:FOLDER...] PAGE
The folders hold the built programs. Blocks of `sh` run one after the other in a temporary folder, blocks of `sh checkout`
at the top of the checkout; `sh package` are those of a page whose programs are the Python package's. A command that fails ends the test. Other
blocks are not run.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^```(sh|sh checkout|sh package)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    page = pathlib.Path(sys.argv[2])
    blocks = BLOCK.findall(page.read_text(encoding="utf-8"))
    if not blocks:
        sys.exit(f"{page} has no commands")
    environment = dict(os.environ, PATH=sys.argv[1] + os.pathsep + os.environ["PATH"])
    with tempfile.TemporaryDirectory() as folder:
        for kind, commands in blocks:
            where = ROOT if kind == "sh checkout" else folder
            result = subprocess.run(["bash", "-euo", "pipefail", "-c", commands], cwd=where, env=environment, text=True,
                                    stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
            if result.returncode != 0:
                sys.exit(f"{page}: exit status {result.returncode}:\n{commands}\n{result.stdout}")
    print(f"{page}: {len(blocks)} blocks run")


if __name__ == "__main__":
    main()
