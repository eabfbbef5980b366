#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Runs spec/reference on the conformance files, and on random ones.

usage: reference.py BUILD COUNT FOLDER      COUNT random files, made in FOLDER by the programs of BUILD
exit status 77: there is no Python with numpy
"""
import importlib.util
import os
import pathlib
import signal
import subprocess
import sys

sys.dont_write_bytecode = True
import run  # pylint: disable=wrong-import-position

HERE = pathlib.Path(__file__).resolve().parent
REFERENCE = HERE.parents[1] / "spec" / "reference"
LACKS = {"draco", "interpolation", "learning"}


class Forked:
    """Runs decode.py, each time in a child of this process: Python and numpy, which take longer to start than most files to
    decode, start once."""

    def __init__(self, memory):
        sys.path.insert(0, str(REFERENCE))
        import decode  # pylint: disable=import-outside-toplevel,import-error
        self.main, self.memory = decode.main, memory

    def run(self, file, out):
        """Exit status; negative if a signal ended it, as the one of an alarm does that takes too long."""
        sys.stdout.flush()
        child = os.fork()
        if child == 0:
            status = 1
            try:
                status = self.decode(file, out)
            finally:
                os._exit(status)  # pylint: disable=protected-access
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])

    def decode(self, file, out):
        """In the child."""
        signal.alarm(run.SECONDS)
        if self.memory:
            import resource  # pylint: disable=import-outside-toplevel
            resource.setrlimit(resource.RLIMIT_AS, (self.memory, self.memory))
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 1)
        os.dup2(nowhere, 2)
        sys.argv = ["decode.py", "--stream", str(file), "-o", str(out)]
        return self.main()


def take_numpy():
    """Goes on in a Python with numpy; exits if there is none."""
    if importlib.util.find_spec("numpy"):
        return
    other = "/usr/bin/python3"
    if sys.executable != other and subprocess.run([other, "-c", "import numpy"], stderr=subprocess.DEVNULL, check=False).returncode == 0:
        os.execv(other, [other, *sys.argv])
    print("skipped: there is no Python with numpy")
    sys.exit(77)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    take_numpy()
    fixed = run.conforms(Forked(1 << 30), HERE, LACKS)
    made = subprocess.run([sys.executable, HERE / "generate.py", *sys.argv[1:]], check=False).returncode == 0 and \
        run.conforms(Forked(0), pathlib.Path(sys.argv[3]), LACKS, any_code=True)
    sys.exit(0 if fixed and made else 1)


if __name__ == "__main__":
    main()
