#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Brings the C++ headers of a release of OpenUSD: headers.py RELEASE FOLDER, as headers.py 26.8 build/usd_headers/26_8.

They are in the packages pxr-*-dev of PyPI, which pip brings and whose hashes headers.lock has. A release without such packages
takes those of 26.8 (of the folder 26_8 beside its own, where there is one) with what differs changed: the version in the
namespace, and the type GfDuration, which 26.11 put into the list by which Vt numbers types. To add a release, see README.md.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "cmake"))
from fetch_source import python_with_pip  # noqa: E402  pip builds packages with a Python that has none

# A release, and the release whose headers it takes.
SOURCES = {"26.8": "26.8", "26.11": "26.8"}
DURATION_SINCE = (26, 11)


def bring(work):
    """The wheels, for any Python that runs this."""
    lock, folder = pathlib.Path(__file__).with_name("headers.lock"), work / "wheels"
    pip = [python_with_pip(work / "venv"), "-m", "pip", "download", "--quiet", "--disable-pip-version-check", "--retries", "1", "--no-deps",
           "--require-hashes", "--only-binary", ":all:", "--implementation", "cp", "--python-version", "3.11", "--abi", "cp311",
           "--platform", "manylinux_2_28_x86_64", "-r", str(lock), "-d", str(folder)]
    if subprocess.run(pip, stdout=sys.stderr).returncode != 0:
        sys.exit(1)  # pip has said why
    return sorted(folder.glob("*.whl"))


def unpack(wheels, to):
    for wheel in wheels:
        with zipfile.ZipFile(wheel) as members:
            for name in members.namelist():
                parts = pathlib.PurePosixPath(name).parts
                if len(parts) > 2 and parts[1] == "include" and ".." not in parts and not name.endswith("/"):
                    file = to.joinpath(*parts[2:])
                    file.parent.mkdir(parents=True, exist_ok=True)
                    file.write_bytes(members.read(name))


def adapt(folder, release, source):
    """Headers of one release made those of another."""
    old, new = (f"v0_{version.replace('.', '_')}__" for version in (source, release))
    for file in folder.rglob("*"):
        if file.is_file():
            text = file.read_bytes()
            if old.encode() in text:
                file.write_bytes(text.replace(old.encode(), new.encode()))
    types = folder / "pxr" / "vt" / "types.h"
    text = types.read_text(encoding="utf-8")
    if tuple(map(int, release.split("."))) >= DURATION_SINCE and "(GfDuration," not in text:
        text, found = re.subn(r"^(\(\(\s*GfTimeCode,\s*TimeCode\s*\)\))", r"\1((GfDuration, Duration))", text, flags=re.MULTILINE)
        text, opened = re.subn(r"^VT_NAMESPACE_OPEN_SCOPE", f"namespace pxrInternal_{new}pxrReserved__ {{ class GfDuration; }}\n"
                               "VT_NAMESPACE_OPEN_SCOPE", text, count=1, flags=re.MULTILINE)
        if (found, opened) != (1, 1):
            sys.exit(f"{types} is not as it was: GfDuration found no place")
        types.write_text(text, encoding="utf-8")


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in SOURCES:
        sys.exit(f"{__doc__}\nreleases: {', '.join(SOURCES)}")
    release, to = sys.argv[1], pathlib.Path(sys.argv[2])
    if to.is_dir():
        return
    to.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=to.parent) as name:
        work = pathlib.Path(name)
        source = to.with_name(SOURCES[release].replace(".", "_"))
        if source != to and source.is_dir():  # brought already
            shutil.copytree(source, work / "include")
        else:
            unpack(bring(work), work / "include")
        if SOURCES[release] != release:
            adapt(work / "include", release, SOURCES[release])
        try:
            os.rename(work / "include", to)
        except OSError:
            if not to.is_dir():  # not brought by another process meanwhile
                raise
            shutil.rmtree(work / "include")


if __name__ == "__main__":
    main()
