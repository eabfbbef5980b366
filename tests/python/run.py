#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Makes a wheel of a finished build, with the libraries that it needs inside, installs it into a fresh environment, and runs
the tests there.

usage: run.py CHECKOUT BUILD WORK [pytest options]      exit status 77: skipped, for the reason printed
"""
import os
import pathlib
import shutil
import subprocess
import sys

SKIPPED = 77
MOST_BYTES = 7_000_000  # of a wheel, one of which the plug-in of USD takes


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def install_requirements(python, lock):
    """Installs the packages of the lock file, and no byte else: those that test.sh has brought, if it has brought all."""
    pip = [python, "-m", "pip", "--disable-pip-version-check", "-q", "install", "--no-compile", "--no-deps", "--require-hashes",
           "--only-binary", ":all:", "-r", lock]
    brought = lock.parents[2] / "build" / "python_packages"
    for source in ([["--no-index", "--find-links", brought]] if brought.is_dir() else []) + [[]]:
        result = subprocess.run([*pip, *source], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if result.returncode == 0:
            break
    else:
        if "DO NOT MATCH THE HASHES" in result.stdout:
            sys.exit(result.stdout)
        skip(f"what is in {lock} cannot be installed:\n{result.stdout[-500:]}")


def make_environment(work, lock):
    """A fresh environment; the Python of it."""
    folder = work / "environment"
    shutil.rmtree(folder, ignore_errors=True)
    result = subprocess.run([sys.executable, "-m", "venv", folder], text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT)
    if result.returncode != 0:
        skip(f"python3 has no venv:\n{result.stdout[-500:]}")
    python = folder / "bin" / "python"
    install_requirements(python, lock)
    return python


def make_wheel(python, checkout, build, work):
    """The wheel of a build's libraries."""
    folder = work / "wheel"
    shutil.rmtree(folder, ignore_errors=True)
    environment = {**os.environ, "PATH": f"{python.parent}:{os.environ['PATH']}"}
    launcher = shutil.which("ccache")
    if launcher:
        environment["CMAKE_CXX_COMPILER_LAUNCHER"] = launcher
    result = subprocess.run([python, "-m", "pip", "--disable-pip-version-check", "wheel", "-v", checkout, "--no-deps",
                             "--no-build-isolation", "-w", folder,
                             f"--config-settings=cmake.define.ANICODEC_PREBUILT={build}",
                             f"--config-settings=build-dir={work / 'build'}"],
                            env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if result.returncode != 0:
        if "Could NOT find Python" in result.stdout:
            skip("the headers of Python are not installed (python3-dev)")
        sys.exit(result.stdout[-8000:])
    return the_only(folder)


def the_only(folder):
    """The wheel in a folder, which must not be too large."""
    wheels = list(folder.glob("*.whl"))
    assert len(wheels) == 1, wheels
    size = wheels[0].stat().st_size
    print(f"{wheels[0].name}: {size} bytes")
    if size > MOST_BYTES:
        sys.exit(f"the wheel has {size} bytes, more than {MOST_BYTES}")
    return wheels[0]


def make_portable(python, wheel, work):
    """The wheel with the libraries that it needs, for machines without them; assimp and USD stay outside."""
    folder = work / "portable"
    shutil.rmtree(folder, ignore_errors=True)
    environment = {**os.environ, "PATH": f"{python.parent}:{os.environ['PATH']}"}
    result = subprocess.run([python, "-m", "auditwheel", "repair", "--strip", "--exclude", "libassimp.so.5", "--exclude", "libusd_ms.so",
                             "-w", folder, wheel],
                            env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if result.returncode != 0:
        sys.exit(result.stdout[-4000:])
    return the_only(folder)


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    checkout, build, work = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
    work.mkdir(parents=True, exist_ok=True)
    if "sanitize" in (build / "CMakeCache.txt").read_text(encoding="utf-8", errors="replace"):
        skip("libraries with sanitizers cannot be loaded into a Python without them")
    tests = checkout / "tests" / "python"
    python = make_environment(work, tests / "requirements.lock")
    wheel = make_portable(python, make_wheel(python, checkout, build, work), work)
    subprocess.run([python, "-m", "pip", "--disable-pip-version-check", "-q", "install", "--no-deps", wheel], check=True)
    command = [python, "-m", "pytest", "-q", "-p", "no:cacheprovider", tests, *sys.argv[4:]]
    sys.exit(subprocess.run(command, cwd=work, env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}).returncode)


if __name__ == "__main__":
    main()
