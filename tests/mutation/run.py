#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Plants single errors in a decoder and counts those that the conformance files catch.

usage: run.py [--work FOLDER] [--every N] [--jobs N] [--least PERCENT] [--fits] [--tree FOLDER --command WORDS] [ERRORS...]
Each entry of ERRORS (default: errors.txt here) names a file and changes a text that occurs once in it:
    # Chapter of the specification, for the entries up to the next such line.
    sdk/mesh/map_coding.h
    - old text
    + new text
The decoder of the tests is built without the error, and must conform; then with each. An error is caught if
tests/conformance/run.py finds a fault, or the build fails. --every N takes each Nth error, for a quick look. --fits only
looks whether each entry fits. --tree plants them in a copy of another decoder that needs no compiler, its files named from FOLDER
on; --command runs it, {tree} being the copy: --tree spec/reference --command 'python3 {tree}/decode.py --stream {file} -o {out}'.
Exit status 1 if fewer than --least per cent (default 95) are caught, or an entry fits no longer. Objects stay in --work.
"""
import argparse
import concurrent.futures
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
FLAGS = "-std=c++17 -O1 -ffp-contract=off -Wno-psabi -DANICODEC_LANES=1 -DXXH_INLINE_ALL".split()
LIBRARIES = "-ldraco -lzstd".split()
MAIN = "tests/conformance/sdk_decoder.cpp"


def sources():
    """Sources of the decoder: the kernels of one instruction set, and nothing that stands in for something absent."""
    found = [MAIN]
    for module in ("format", "sdk"):
        for path in sorted((ROOT / module).rglob("*.cpp")):
            name = path.relative_to(ROOT).as_posix()
            if not (name.startswith(("sdk/api/", "sdk/examples/", "sdk/package/")) or
                    name.endswith(("_absent.cpp", "_avx2.cpp", "_avx512.cpp", "_avx512vl.cpp"))):
                found.append(name)
    return found


def compiled(name, folder, overlay=None):
    """Compiles a source, its includes first from the overlay; whether it worked."""
    target = folder / (name.replace("/", "_") + ".o")
    source = overlay / name if overlay and (overlay / name).exists() else ROOT / name
    # Draco's headers include streams; a stand-in keeps the library's own objects free of them.
    draco = ["-I", ROOT / "sdk/draco_headers"] if name.startswith("sdk/mesh/draco") else []
    command = ["g++", *FLAGS, *draco, *(["-I", overlay] if overlay else []), "-I", ROOT, "-I", ROOT / "sdk/include", "-MMD", "-MF",
               target.with_suffix(".d"), "-c", source, "-o", target]
    return subprocess.run(list(map(str, command)), stderr=subprocess.DEVNULL, check=False).returncode == 0


def uses(name, folder):
    """The includes of a compiled source, as names below the checkout."""
    words = shlex.split((folder / (name.replace("/", "_") + ".d")).read_text().replace("\\\n", " "))
    paths = (pathlib.Path(word) for word in words[1:])
    return {p.relative_to(ROOT).as_posix() for p in paths if p.is_absolute() and p.is_relative_to(ROOT)}


def linked(objects, program):
    """Links; whether it worked."""
    return subprocess.run(["g++", *map(str, objects), *LIBRARIES, "-o", str(program)], stderr=subprocess.DEVNULL,
                          check=False).returncode == 0


def conforms(command):
    """None, or the first fault."""
    result = subprocess.run([sys.executable, str(ROOT / "tests/conformance/run.py"), "--stop", "--memory", "0", *command],
                            capture_output=True, text=True, check=False)
    return None if result.returncode == 0 else (result.stdout.strip() or result.stderr.strip()).splitlines()[0]


def errors_of(paths):
    """(chapter, file, old, new) of each entry."""
    for path in paths:
        chapter = ""
        for block in path.read_text(encoding="utf-8").split("\n\n"):
            lines = []
            for line in block.splitlines():
                if line.startswith("#"):
                    chapter = line.strip("# .")
                elif line:
                    lines.append(line)
            if lines:
                old = "\n".join(line[2:] for line in lines[1:] if line.startswith("- "))
                new = "\n".join(line[2:] for line in lines[1:] if line.startswith("+"))
                yield chapter, lines[0].strip(), old, new


def planted(root, error, folder):
    """Writes the file with the error below a folder; what keeps it from fitting, or None."""
    _, file, old, new = error
    text = (root / file).read_text(encoding="utf-8") if (root / file).exists() else ""
    if text.count(old) != 1:
        return f"FITS NO LONGER ({text.count(old)} places)"
    if folder:
        (folder / file).parent.mkdir(parents=True, exist_ok=True)
        (folder / file).write_text(text.replace(old, new), encoding="utf-8")
    return None


class Copies:
    """Plants errors in copies of a decoder that needs no compiler."""

    def __init__(self, tree, command):
        self.tree, self.command = tree, shlex.split(command)
        if fault := conforms(self.on(tree)):
            sys.exit(f"without an error: {fault}")

    def on(self, tree):
        """The command for a copy."""
        return [word.replace("{tree}", str(tree)) for word in self.command]

    def outcome(self, error):
        """How the error shows, or None."""
        with tempfile.TemporaryDirectory() as scratch:
            copy = pathlib.Path(scratch) / "tree"
            shutil.copytree(self.tree, copy)
            return planted(self.tree, error, copy) or conforms(self.on(copy))


class Nursery:
    """Builds the decoder with an error in it."""

    def __init__(self, work, jobs):
        self.base = work / "objects"
        self.base.mkdir(parents=True, exist_ok=True)
        self.names = sources()
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            for name, worked in zip(self.names, pool.map(lambda n: self.fresh(n) or compiled(n, self.base), self.names)):
                if not worked:
                    sys.exit(f"{name} cannot be compiled")
        self.users = {}
        for name in self.names:
            for used in uses(name, self.base):
                self.users.setdefault(used, []).append(name)
        program = work / "sdk_decoder"
        if not linked(self.objects(), program):
            sys.exit("the decoder cannot be linked")
        if fault := conforms(self.on(program)):
            sys.exit(f"without an error: {fault}")

    def fresh(self, name):
        """Whether the object is newer than all it is made of."""
        target = self.base / (name.replace("/", "_") + ".o")
        if not target.exists() or not target.with_suffix(".d").exists():
            return False
        made = target.stat().st_mtime
        return all((ROOT / used).exists() and (ROOT / used).stat().st_mtime < made for used in uses(name, self.base))

    def objects(self, changed=(), folder=None):
        """Object files, some of them from another folder."""
        return [(folder if name in changed else self.base) / (name.replace("/", "_") + ".o") for name in self.names]

    @staticmethod
    def on(program):
        """The command of the built decoder."""
        return [str(program), "{file}", "{out}"]

    def outcome(self, error):
        """How the error shows, or None."""
        with tempfile.TemporaryDirectory() as scratch:
            overlay = pathlib.Path(scratch)
            if unfit := planted(ROOT, error, overlay):
                return unfit
            changed = self.users.get(error[1], [])
            if not all(compiled(name, overlay, overlay) for name in changed) or \
                    not linked(self.objects(changed, overlay), overlay / "decoder"):
                return "does not compile"
            return conforms(self.on(overlay / "decoder"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", type=pathlib.Path)
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--least", type=float, default=95)
    parser.add_argument("--fits", action="store_true")
    parser.add_argument("--tree", type=pathlib.Path)
    parser.add_argument("--command")
    parser.add_argument("errors", nargs="*", type=pathlib.Path, default=[pathlib.Path(__file__).with_name("errors.txt")])
    arguments = parser.parse_args()
    errors = list(errors_of(arguments.errors))[::arguments.every]
    if arguments.fits:
        unfit = [f"{error[1]}: {error[2]}: {fault}" for error in errors if (fault := planted(arguments.tree or ROOT, error, None))]
        sys.exit("\n".join(unfit) if unfit else 0)
    work = arguments.work or pathlib.Path(tempfile.mkdtemp())
    try:
        nursery = Copies(arguments.tree.resolve(), arguments.command) if arguments.tree else Nursery(work.resolve(), arguments.jobs)
        missed, unfit = [], 0
        with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
            for error, outcome in zip(errors, pool.map(nursery.outcome, errors)):
                label = f"{error[0]}: {error[1]}: {error[2].strip().splitlines()[0]}  ->  {(error[3].strip() or '(nothing)').splitlines()[0]}"
                if outcome is None:
                    missed.append(label)
                    print(f"missed  {label}", flush=True)
                if outcome and outcome.startswith("FITS"):
                    unfit += 1
                    print(f"{label}: {outcome}", flush=True)
        caught = len(errors) - len(missed) - unfit
        print(f"{caught} of {len(errors)} planted errors are caught")
        sys.exit(0 if unfit == 0 and caught * 100 >= arguments.least * len(errors) else 1)
    finally:
        if not arguments.work:
            shutil.rmtree(work)


if __name__ == "__main__":
    main()
