#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Tests the plug-in of USD with several releases of usd-core and several Pythons, and with damaged files.

usage: usd_releases.py WHEEL WORK [--releases 26.8 26.11] [--pythons python3] [--damaged 2000]

WHEEL is a wheel of the package, or a folder of wheels, one for each Python. For each pair it makes an environment in WORK, installs the
wheel and usd-core there, runs tests/python/test_usd*.py, and opens --damaged files through the plug-in: those of tests/conformance with
bytes changed, cut or repeated, whose checksums are made anew, so that the damage reaches the decoder. A host that dies, or an error of
more than a line, is a fault. Takes minutes; no part of CI.
"""
import argparse
import os
import pathlib
import subprocess
import sys

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]
DAMAGE = CHECKOUT / "tests" / "scripts" / "damage_usd.py"


def run(command, **options):
    return subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)


def environment(work, python, release, wheel):
    folder = work / f"{pathlib.Path(python).name}-{release}"
    inside = folder / "bin" / "python"
    if not inside.exists():
        subprocess.run([python, "-m", "venv", folder], check=True)
    pip = [inside, "-m", "pip", "--disable-pip-version-check", "-q", "install"]
    subprocess.run([*pip, "numpy", "pytest", f"usd-core=={release}"], check=True)
    found = run([*pip, "--force-reinstall", "--no-deps", "--no-index", "--find-links", wheel, "anicodec"] if wheel.is_dir() else
                [*pip, "--force-reinstall", "--no-deps", wheel])
    if found.returncode != 0:
        sys.exit(found.stdout)
    return inside


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("wheel", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--releases", nargs="+", default=["26.8", "26.11"])
    parser.add_argument("--pythons", nargs="+", default=[sys.executable])
    parser.add_argument("--damaged", type=int, default=2000)
    options = parser.parse_args()
    tests = sorted((CHECKOUT / "tests" / "python").glob("test_usd*.py"))
    failed = 0
    for python in options.pythons:
        for release in options.releases:
            inside = environment(options.work, python, release, options.wheel)
            tested = run([inside, "-m", "pytest", "-q", "-p", "no:cacheprovider", *tests], cwd=options.work)
            damaged = run([inside, DAMAGE, options.damaged], cwd=options.work, env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})
            failed += tested.returncode != 0 or damaged.returncode != 0
            print(f"{python}, usd-core {release}: {tested.stdout.strip().splitlines()[-1]}; "
                  f"{(damaged.stdout.strip().splitlines() or ['nothing'])[-1]}", flush=True)
            if tested.returncode != 0 or damaged.returncode != 0:
                print(tested.stdout[-4000:], damaged.stdout[-4000:])
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
