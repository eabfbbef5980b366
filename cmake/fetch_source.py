#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Copies a folder of a source package of PyPI: fetch_source.py PACKAGE VERSION SHA256 FOLDER TO.

pip brings the package and checks its hash. It asks the package for its metadata, too, and brings the tools that build the
package, for as long as it runs.
"""
import importlib.util
import pathlib
import subprocess
import sys
import tarfile
import tempfile
import venv


def python_with_pip(folder):
    if importlib.util.find_spec("pip"):
        return sys.executable
    venv.create(folder, with_pip=True)
    return str(folder / "bin/python")


def main():
    package, version, sha256, folder, to = sys.argv[1:]
    to = pathlib.Path(to)
    to.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=to.parent) as name:
        work = pathlib.Path(name)
        (work / "wanted.txt").write_text(f"{package}=={version} --hash=sha256:{sha256}\n")
        pip = [python_with_pip(work / "venv"), "-m", "pip", "download", "--quiet", "--disable-pip-version-check", "--retries", "1",
               "--no-deps", "--no-binary", package, "--require-hashes", "-r", work / "wanted.txt", "-d", work / "package"]
        if subprocess.run(pip, stdout=sys.stderr).returncode != 0:
            sys.exit(1)  # pip has said why
        archive, = (work / "package").iterdir()
        found = work / "found"
        with tarfile.open(archive) as members:
            for member in members:
                path = pathlib.PurePosixPath(*pathlib.PurePosixPath(member.name).parts[1:])  # within the one outer folder
                if member.isfile() and path.is_relative_to(folder) and ".." not in path.parts:
                    file = found / path.relative_to(folder)
                    file.parent.mkdir(parents=True, exist_ok=True)
                    file.write_bytes(members.extractfile(member).read())
        try:
            found.rename(to)
        except OSError:
            if not to.is_dir():  # not brought by another process meanwhile
                raise


if __name__ == "__main__":
    main()
