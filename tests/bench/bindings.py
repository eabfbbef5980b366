#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Times of opening a clip and of a frame of its positions, in each language beside C.

usage: bindings.py BUILD CLIP.anic [--python PYTHON] [--rounds N] [--turns N]

BUILD: a finished build of preset release or test, whose shared library C, C# and Python use; Rust builds the decoder itself, and
JavaScript has dist/ of bindings/web. PYTHON: one that has the package, else that of this script. All of them open the file in
memory, then seek the time of each frame and write its positions into an array. Processor time, the least of N rounds in each of
N turns that the languages take one after the other. A language that is not installed is left out with a line.
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]


def run(*words, **more):
    return subprocess.run([str(word) for word in words], check=True, text=True, stdout=subprocess.PIPE, **more).stdout


def c(build, work):
    library = build / "sdk/package"
    run("cc", "-O2", "-I", ROOT / "sdk/include", ROOT / "tests/rust/times.c", "-o", work / "c", "-L", library, "-lanicodec", f"-Wl,-rpath,{library}")
    return [work / "c"], {}


def rust(build, work):
    target = build / "bindings_rust"
    environment = {**os.environ, "CARGO_TARGET_DIR": str(target)}
    run("cargo", "build", "--quiet", "--release", "-p", "anicodec", "--example", "times", cwd=ROOT / "bindings/rust", env=environment)
    return [target / "release/examples/times"], {}


def javascript(build, work):
    if not (ROOT / "bindings/web/dist/anicodec.wasm").exists():
        raise FileNotFoundError("bindings/web/dist is empty: presets wasm and wasm-scalar")
    return ["node", ROOT / "tests/web/times.mjs"], {}


def csharp(build, work):
    sources = sorted((ROOT / "bindings/csharp/Runtime").glob("*.cs"))
    run("mcs", "-unsafe", "-langversion:latest", "-optimize+", f"-out:{work / 'times.exe'}", ROOT / "tests/csharp/times.cs", *sources)
    return ["mono", work / "times.exe"], {"LD_LIBRARY_PATH": str(build / "sdk/package")}


def python(build, work, interpreter=sys.executable):
    run(interpreter, "-c", "import anicodec", stderr=subprocess.DEVNULL)
    return [interpreter, ROOT / "tests/python/times.py"], {}


LANGUAGES = {"C": (c, "cc"), "Rust": (rust, "cargo"), "JavaScript (Node)": (javascript, "node"), "C# (Mono)": (csharp, "mcs"), "Python": (python, None)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("clip", type=pathlib.Path)
    parser.add_argument("--python", default=sys.executable)
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--turns", type=int, default=5)
    given = parser.parse_args()
    build, clip = given.build.resolve(), given.clip.resolve()
    with tempfile.TemporaryDirectory() as name:
        work, programs, best = pathlib.Path(name), {}, {}
        for language, (prepare, needs) in LANGUAGES.items():
            more = {"interpreter": given.python} if prepare is python else {}
            try:
                if needs and not shutil.which(needs):
                    raise FileNotFoundError(f"there is no {needs}")
                programs[language] = prepare(build, work, **more)
            except (FileNotFoundError, subprocess.CalledProcessError) as error:
                print(f"{language} is left out: {error}", file=sys.stderr)
        for _ in range(given.turns):
            for language, (words, environment) in programs.items():
                measured = [float(word) for word in run(*words, clip, given.rounds, env={**os.environ, **environment}).split()]
                best[language] = [min(pair) for pair in zip(measured, best.get(language, measured))]
    print(f"| {clip.name} in | open, ms | of C's | frame, us | of C's |\n|---|---|---|---|---|")
    for language, (opening, frame) in best.items():
        shares = [mine / of_c for mine, of_c in zip((opening, frame), best["C"])]
        print(f"| {language} | {opening:.1f} | {shares[0]:.2f} | {1000 * frame:.1f} | {shares[1]:.2f} |")


if __name__ == "__main__":
    main()
