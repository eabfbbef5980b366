#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Makes an extension of the add-on, with the wheel of the Python package inside, for Blender 4.2 and later."""
import argparse
import json
import pathlib
import sys
import zipfile

EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest that a zip file can state: the same files give the same bytes
# How the platform of a wheel begins and ends, and what Blender calls it.
SYSTEMS = {"manylinux": "linux", "linux": "linux", "macosx": "macos", "win": "windows"}
MACHINES = {"x86_64": "x64", "amd64": "x64", "aarch64": "arm64", "arm64": "arm64"}
HERE = pathlib.Path(__file__).resolve().parent
ADD_ON = HERE / "anicodec_blender"


def platform_of(wheel):
    tag = wheel.stem.rpartition("-")[2].split(".")[0]
    system = next((name for start, name in SYSTEMS.items() if tag.startswith(start)), None)
    machine = next((name for end, name in MACHINES.items() if tag.endswith(end)), None)
    if not (system and machine):
        sys.exit(f"{wheel}: Blender does not run on {tag}")
    return f"{system}-{machine}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("wheel", type=pathlib.Path, nargs="+")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    for wheel in arguments.wheel:
        if wheel.suffix != ".whl" or not wheel.is_file():
            parser.error(f"{wheel}: there is no such wheel")
    manifest = (ADD_ON / "blender_manifest.toml").read_text(encoding="utf-8")
    platforms = sorted({platform_of(wheel) for wheel in arguments.wheel})
    files = {"LICENSE": HERE.parents[1] / "LICENSE", **{source.name: source for source in ADD_ON.glob("*.py")},
             **{f"wheels/{wheel.name}": wheel for wheel in arguments.wheel}}
    names = [f"./wheels/{wheel.name}" for wheel in arguments.wheel]
    with zipfile.ZipFile(arguments.output, "w", zipfile.ZIP_DEFLATED) as archive:
        def add(name, data):
            archive.writestr(zipfile.ZipInfo(name, EPOCH), data, zipfile.ZIP_DEFLATED)
        add("blender_manifest.toml", manifest.replace("wheels = []", f"platforms = {json.dumps(platforms)}\nwheels = {json.dumps(names)}"))
        for name in sorted(files):
            add(name, files[name].read_bytes())


if __name__ == "__main__":
    main()
