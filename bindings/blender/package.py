#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Makes an extension of the add-on, with the wheel of the Python package inside, for Blender 4.2 and later."""
import argparse
import pathlib
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
ADD_ON = HERE / "anicodec_blender"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("wheel", type=pathlib.Path, nargs="+")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    for wheel in arguments.wheel:
        if wheel.suffix != ".whl" or not wheel.is_file():
            parser.error(f"{wheel}: there is no such wheel")
    manifest = (ADD_ON / "blender_manifest.toml").read_text(encoding="utf-8")
    names = ", ".join(f'"./wheels/{wheel.name}"' for wheel in arguments.wheel)
    with zipfile.ZipFile(arguments.output, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("blender_manifest.toml", manifest.replace("wheels = []", f"wheels = [{names}]"))
        for source in sorted(ADD_ON.glob("*.py")):
            archive.write(source, source.name)
        archive.write(HERE.parents[1] / "LICENSE", "LICENSE")
        for wheel in arguments.wheel:
            archive.write(wheel, f"wheels/{wheel.name}")


if __name__ == "__main__":
    main()
