# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Measures, interpolation, massage, and the command."""
import numpy as np
import pytest

import anicodec
import anicodec.interpolate
import anicodec.massage
import anicodec.metrics


def test_compare(wave, clip):
    positions, faces = wave
    measured = anicodec.metrics.compare(positions, clip, faces)
    assert measured["max_error"] == pytest.approx(np.linalg.norm(positions - clip[:], axis=2).max(), rel=1e-5)
    assert measured["kg"] == pytest.approx(clip.info["kg"], rel=1e-3)
    assert measured["sted"] > 0
    with pytest.raises(ValueError, match="24 x 144 x 3 and 23 x 144 x 3"):
        anicodec.metrics.compare(positions, positions[1:])


def test_hausdorff(wave):
    positions, faces = wave
    raised = positions[0] + np.float32([0, 0, 0.25])
    assert anicodec.metrics.hausdorff(positions[0], faces, raised, faces)["max"] == pytest.approx(0.25, rel=0.3)


def test_interpolation(wave, clip):
    positions = wave[0]
    between = anicodec.interpolate.between(positions[0], positions[9], clip.triangles, 3)
    assert between.shape == (3, 144, 3)
    assert np.abs(between[0] - positions[0]).max() < 1e-4 and np.abs(between[2] - positions[9]).max() < 1e-4
    morpher = anicodec.interpolate.Morpher(positions[:2], clip.triangles)
    with pytest.raises(ValueError):
        morpher.at([0.5, 0.6])
    with pytest.raises(ValueError):
        morpher.at([1])


def test_massage(wave):
    positions, faces = wave
    moved = anicodec.massage.massage(positions[:3], faces)
    assert moved.shape == positions[:3].shape and np.isfinite(moved).all()
    with pytest.raises(ValueError):
        anicodec.massage.massage(positions[:3], faces, strength=2)


@pytest.mark.parametrize("package, vertices, faces", [("trimesh", "vertices", 242), ("pyvista", "points", 121),
                                                      ("meshio", "points", 121)])
def test_frames_for_other_packages(clip, package, vertices, faces):
    pytest.importorskip(package)
    found = clip.to(package, 5)
    assert np.array_equal(np.asarray(getattr(found, vertices), np.float32), clip[5])
    counts = {"trimesh": lambda: len(found.faces), "pyvista": lambda: found.n_cells,
              "meshio": lambda: sum(len(block.data) for block in found.cells)}
    assert counts[package]() == faces


def test_other_packages_are_named(clip):
    with pytest.raises(ValueError, match="one of trimesh, pyvista, meshio"):
        clip.to("blender")


def test_the_command(command, tmp_path, clip):
    assert command("--version").strip() == f"anicodec {anicodec.__version__}"
    (tmp_path / "wave.anic").write_bytes(clip.data)
    assert "144" in command("info", tmp_path / "wave.anic")
