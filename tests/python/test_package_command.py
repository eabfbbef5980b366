# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Command lines that the package takes itself."""
import pytest

from anicodec import _usd_command, _vtk_command


@pytest.mark.parametrize("line, usd, vtk", [
    ("encode shot.usdc -o a.anic", True, False),
    ("encode run_0.vtu run_1.vtu -o a.anic", False, True),
    ("decode a.anic --output=x.USDZ", True, False),
    ("decode a.anic b.anic --format vtkhdf -o out", False, True),
    ("encode a.obj a.pc2 --meta source=shot.usd -o a.anic", False, False),
    ("encode a.obj a.pc2 --meta=source=run.npz --name shot.usd -o a.anic", False, False),
    ("info shot.usd", False, False)])
def test_names_of_files_decide(line, usd, vtk):
    assert (_usd_command.is_meant(line.split()), _vtk_command.is_meant(line.split())) == (usd, vtk)
