# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Whole clips in viewers of other packages; each is skipped where its package is not installed."""
import numpy as np
import pytest

import anicodec


@pytest.fixture(scope="module")
def visits(wave):
    """A sheet, and another one that is there in three frames."""
    positions, faces = wave
    meshes = [anicodec.SourceMesh(positions, faces, name="sheet"), anicodec.SourceMesh(positions[2:5], faces, name="guest", runs=[(2, 3)])]
    return anicodec.open(anicodec.encode_meshes(meshes, effort="fast", fps=8))


def test_rerun(visits, tmp_path):
    pytest.importorskip("rerun", reason="rerun-sdk is not installed")
    recording = visits.to("rerun")
    recording.save(str(tmp_path / "clip.rrd"))
    recording.flush()
    assert (tmp_path / "clip.rrd").stat().st_size > 24 * 144 * 12


def test_k3d(visits):
    pytest.importorskip("k3d", reason="k3d is not installed")
    sheet, guest = visits.to("k3d").objects
    assert len(sheet.vertices) == 24 and np.array_equal(sheet.vertices["0.375"], visits.meshes[0][3])
    assert sorted(guest.vertices) == ["0.25", "0.375", "0.5"] and guest.visible["0.375"] and not guest.visible["0.0"]


def test_viser(visits):
    pytest.importorskip("viser", reason="viser is not installed")
    server = visits.to("viser")
    try:
        assert server.get_port() > 0
    finally:
        server.stop()


def test_polyscope(visits, monkeypatch):
    polyscope = pytest.importorskip("polyscope", reason="polyscope is not installed")
    start = polyscope.init
    monkeypatch.setattr(polyscope, "init", lambda: start("openGL_mock"))
    assert visits.to("polyscope").get_surface_mesh("sheet").n_vertices() == 144
    assert not polyscope.get_surface_mesh("guest").is_enabled()


def test_open3d(visits):
    pytest.importorskip("open3d", reason="open3d is not installed")
    shown = visits.to("open3d")
    assert len(shown) == 24 + 3 and shown[3]["time"] == pytest.approx(3 / 8)
    assert np.allclose(np.asarray(shown[3]["geometry"].vertices), visits.meshes[0][3])


def test_what_is_missing_is_named(visits, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "rerun", None)
    with pytest.raises(ImportError, match="rerun is missing: pip install rerun-sdk"):
        visits.to("rerun")
    with pytest.raises(anicodec.InputError, match="has 2 meshes"):
        visits.to("trimesh", 3)
