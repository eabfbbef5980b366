# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""The reader of PyVista."""
import numpy as np
import pytest

import anicodec

pyvista = pytest.importorskip("pyvista", minversion="0.49", reason="pyvista 0.49 or later is not installed")

import anicodec.pyvista  # noqa: E402


@pytest.fixture
def path(tmp_path, wave):
    positions, faces = wave
    custom = {"heat": positions[:, :, 2:], "damage": anicodec.Field("polygons", np.arange(len(faces), dtype=float)[:, None])}
    (tmp_path / "wave.anic").write_bytes(anicodec.encode(positions, faces, fps=4, start_time=1, effort="fast", custom=custom))
    return tmp_path / "wave.anic"


def test_times_and_fields(path):
    clip, reader = anicodec.open(path), pyvista.get_reader(path)
    assert reader.number_time_points == 24 and reader.time_values == pytest.approx([1 + frame / 4 for frame in range(24)])
    for frame in (0, 7, 23, 3):
        reader.set_active_time_point(frame)
        mesh = reader.read()
        assert np.array_equal(mesh.points, clip[frame]) and mesh.n_cells == 121
        assert np.array_equal(mesh.point_data["heat"], clip.attribute_at(0, frame / 4)[:, 0])
    reader.set_active_time_value(1.5)
    assert reader.active_time_value == 1.5 and np.array_equal(reader.read().points, clip[2])
    with pytest.raises(ValueError, match="there is no time 1.6"):
        reader.set_active_time_value(1.6)
    assert (reader.point_array_names, reader.cell_array_names) == (["heat"], ["damage"])
    reader.disable_all_point_arrays()
    assert reader.read().array_names == ["damage"]
    assert np.array_equal(pyvista.read(path).points, clip[0])


def test_meshes_are_blocks(tmp_path, wave):
    positions, faces = wave
    meshes = [anicodec.SourceMesh(positions, faces, name="sheet"), anicodec.SourceMesh(positions[2:5], faces, name="guest", runs=[(2, 3)])]
    (tmp_path / "two.anic").write_bytes(anicodec.encode_meshes(meshes, effort="fast"))
    reader = pyvista.get_reader(tmp_path / "two.anic")
    assert [block.n_points for block in reader.read()] == [144, 0]
    reader.set_active_time_point(3)
    assert reader.read().keys() == ["sheet", "guest"] and reader.read()["guest"].n_points == 144


def test_a_damaged_file_raises(path):
    path.write_bytes(path.read_bytes()[:200])
    with pytest.raises(anicodec.CorruptError):
        pyvista.get_reader(path)


def test_a_clip_becomes_a_reader(path):
    clip = anicodec.open(path)
    reader = clip.to("pyvista")
    reader.set_active_time_point(9)
    assert reader.number_time_points == 24 and np.array_equal(reader.read().points, clip[9])
    assert isinstance(clip.to("pyvista", 3), pyvista.PolyData)
