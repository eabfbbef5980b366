# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Runs programs that draw with Mesa's software renderer; skips the test if nothing draws here."""
import os
import subprocess
import sys

SKIPPED, NO_DISPLAY = 77, 3


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def skip_if_sanitized(program):
    """Skips if the build folder of `program`, two folders above it, is that of a preset with sanitizers."""
    cache = program.parents[2] / "CMakeCache.txt"
    if "sanitize" in cache.read_text(encoding="utf-8", errors="replace"):
        skip("graphics drivers leak")


def run(*command, **variables):
    """The output of `command`, run with `variables` in its environment; ends the test if it fails."""
    environment = {**os.environ, "LIBGL_ALWAYS_SOFTWARE": "1", **variables}
    result = subprocess.run([*map(str, command)], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            env=environment)
    print(result.stdout, end="")
    if result.returncode == NO_DISPLAY:
        skip("nothing draws here")
    if result.returncode != 0:
        sys.exit(f"{command[0]}: exit status {result.returncode}")
    return result.stdout
