# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""The command line: python -m anicodec encode ..."""
import os
import sys

from anicodec import _usd_command


def main() -> None:
    """Becomes the command of the package with the arguments of this process. Stages of USD are encoded here."""
    if _usd_command.is_meant(sys.argv[1:]):
        sys.exit(_usd_command.main(sys.argv[2:]))
    command = os.path.join(os.path.dirname(os.path.abspath(__file__)), "bin", "anicodec")
    try:
        os.execv(command, ["anicodec", *sys.argv[1:]])
    except OSError as error:
        sys.exit(f"{command}: {error.strerror}")


if __name__ == "__main__":
    main()
