#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Builds, lints and tests bevy_anicodec, and draws its examples: a check of its own, since building Bevy takes many minutes.

usage: check.py [CLIP.anic [OUT]]      CLIP: a limb that bends; OUT: the folder of the pictures, target/pictures
It wants Cargo's registry, Rust 1.97 or a nightly compiler near it, and a graphics card or Mesa's software Vulkan (Debian:
mesa-vulkan-drivers). CARGO_TARGET_DIR is the folder of the build; with JOBS set, as many processes build.
"""
import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]


def run(*words, **more):
    print("$", *words, flush=True)
    return subprocess.run([str(word) for word in words], check=True, cwd=HERE, **more)


def toolchain():
    """Words that choose a compiler which is new enough, and those that let Cargo take it."""
    def version(*words):
        told = subprocess.run(["rustc", *words, "--version"], capture_output=True, text=True, check=False).stdout.split()
        return tuple(int(number) for number in told[1].split("-")[0].split(".")) if len(told) > 1 else (0,)

    if version() >= (1, 97, 1):
        return [], []
    if version("+nightly") >= (1, 97):
        return ["+nightly"], ["--ignore-rust-version"]
    sys.exit("Bevy 0.20 wants Rust 1.97.1, or a nightly compiler of 1.97 at least")


def main():
    if len(sys.argv) > 3 or sys.argv[1:2] == ["--help"]:
        sys.exit(__doc__)
    clip = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "tests/golden/default.anic").resolve()
    target = pathlib.Path(os.environ.setdefault("CARGO_TARGET_DIR", str(HERE / "target"))).resolve()
    pictures = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else target / "pictures").resolve()
    pictures.mkdir(parents=True, exist_ok=True)
    compiler, ignored = toolchain()
    jobs = ["-j", os.environ["JOBS"]] if "JOBS" in os.environ else []

    def cargo(command, *words, **more):
        return run("cargo", *compiler, command, *ignored, *jobs, *words, **more)

    run("cargo", *compiler, "fmt", "--check")
    cargo("clippy", "--all-targets", "--", "-D", "warnings")
    cargo("test", env={**os.environ, "ANICODEC_PICTURES": str(pictures)})
    cargo("build", "--examples")
    examples = target / "debug/examples"
    run(examples / "crowd", clip, pictures / "crowd.png", "1000", "5")
    times = run(examples / "dancer", clip, pictures / "dancer.png", stdout=subprocess.PIPE, text=True).stdout
    libraries = [max(target.glob(f"debug/build/*/out/{name}"), key=lambda path: path.stat().st_mtime) for name in ("libanicodec.a", "libzstd.a")]
    run("cc", "-O2", "-I", ROOT / "sdk/include", ROOT / "tests/rust/times.c", "-o", target / "times", *libraries, "-lstdc++", "-lm")
    for_c = run(target / "times", clip, stdout=subprocess.PIPE, text=True).stdout
    print(f"open and frame of {clip.name}, ms: C {for_c.strip()}; Bevy, with boxes, render vertices and normals: {times.strip()}")
    print(f"pictures: {pictures}")


if __name__ == "__main__":
    main()
