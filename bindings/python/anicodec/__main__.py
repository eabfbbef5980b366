# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""The command line: python -m anicodec encode ..."""
import os
import signal
import sys

from anicodec import _anicodec, _usd_command, _usd_plugin, _vtk_command


def main() -> None:
    """Runs the command with the arguments of this process, and ends it. Stages of USD and results of simulations are read and written here."""
    for command in (_usd_command, _vtk_command):
        if command.is_meant(sys.argv[1:]):
            signal.signal(signal.SIGPIPE, signal.SIG_DFL)
            try:
                status = command.main(sys.argv[1:])
            except KeyboardInterrupt:
                status = 128 + signal.SIGINT
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(status)  # USD destroys stages in threads of its own, which the end of the process would overtake
    if _usd_plugin.is_meant(sys.argv[1:]):
        sys.exit(_usd_plugin.main(sys.argv[2:]))
    for name in (signal.SIGINT, signal.SIGPIPE, signal.SIGXFSZ):  # as other commands, not as Python
        signal.signal(name, signal.SIG_DFL)
    sys.exit(_anicodec.run_command([os.fsencode(text) for text in ("anicodec", *sys.argv[1:])]))


if __name__ == "__main__":
    main()
