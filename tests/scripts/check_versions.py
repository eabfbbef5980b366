#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""The version of CMakeLists.txt is that of every package: check_versions.py CHECKOUT."""
import pathlib
import re
import sys

PLACES = {
    "CMakeLists.txt": r"project\(anicodec VERSION ([\d.]+)",
    "pyproject.toml": r'^version = "(.+)"$',
    "bindings/web/package.json": r'^  "version": "(.+)",$',
    "bindings/csharp/package.json": r'^  "version": "(.+)",$',
    "bindings/csharp/Anicodec.nuspec": r"<version>(.+)</version>",
    "bindings/csharp/Anicodec.csproj": r"<Version>(.+)</Version>",
    "bindings/blender/anicodec_blender/blender_manifest.toml": r'^version = "(.+)"$',
    "bindings/blender/anicodec_blender/__init__.py": r'"version": \((\d+, \d+, \d+)\)',
    "bindings/rust/Cargo.toml": r'^version = "(.+)"$',
    "bindings/rust/bevy_anicodec/Cargo.toml": r'^version = "(.+)"$',
    "bindings/rust/godot_anicodec/Cargo.toml": r'^version = "(.+)"$',
}


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    root, wanted, faults = pathlib.Path(sys.argv[1]), None, []
    for path, pattern in PLACES.items():
        match = re.search(pattern, (root / path).read_text(encoding="utf-8"), re.MULTILINE)
        version = match and match[1].replace(", ", ".")
        wanted = wanted or version
        if version != wanted:
            faults.append(f"{path}: {version}, not {wanted}")
    if faults:
        sys.exit("\n".join(faults))
    print(f"every package is {wanted}")


if __name__ == "__main__":
    main()
