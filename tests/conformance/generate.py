#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Makes random valid files beside the fixed ones, in a folder that run.py takes.

usage: generate.py [--seed FIRST] BUILD COUNT FOLDER [COMMAND...]
BUILD is a folder that random_vectors and sdk_decoder have been built in, as build/dev. File number i is that of
seed FIRST + i, the same whenever it is made.
With COMMAND run.py runs that on them; options of run.py may come first.
"""
import argparse
import hashlib
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "scripts"))
import conformance_facts  # pylint: disable=wrong-import-position
import conformance_parts  # pylint: disable=wrong-import-position


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("count", type=int)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("command", nargs=argparse.REMAINDER)
    arguments = parser.parse_args()
    programs = arguments.build / "tests"
    (arguments.folder / "facts").mkdir(parents=True, exist_ok=True)
    lines = []
    with tempfile.TemporaryDirectory() as scratch:
        for seed in range(arguments.seed, arguments.seed + arguments.count):
            file, out = arguments.folder / f"random_{seed}.anic", pathlib.Path(scratch) / f"random_{seed}"
            for command in ([programs / "random_vectors", str(seed), file], [programs / "sdk_decoder", file, out]):
                if subprocess.run(command, check=False).returncode != 0:
                    sys.exit(f"seed {seed}: {command[0].name} failed")
            conformance_facts.write(conformance_facts.facts_of(out), arguments.folder / "facts" / f"{file.stem}.json")
            data = file.read_bytes()
            words = ["valid", file.name, hashlib.sha256(data).hexdigest(), *conformance_parts.needs(conformance_parts.parts_of(data))]
            lines.append(" ".join(words) + "\n")
    (arguments.folder / "MANIFEST").write_text("".join(lines), encoding="utf-8")
    if arguments.command:
        run = pathlib.Path(__file__).resolve().parent / "run.py"
        sys.exit(subprocess.run([sys.executable, run, "--any-code", "--memory", "0", "--folder", arguments.folder, *arguments.command],
                                check=False).returncode)


if __name__ == "__main__":
    main()
