# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Results of simulations."""
import json
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import anicodec
from anicodec import _vtk_command

vtk = pytest.importorskip("vtk", reason="the vtk wheel is not installed")

import simulation_data as data  # noqa: E402
from anicodec import vtk as simulations  # noqa: E402

FORMS = ["beam.pvd", "beam.vtk.series", "beam.vtkhdf", "beam.xdmf", "beam.case", "beam.e"]


@pytest.fixture(scope="module")
def steps():
    return [data.beam(number) for number in range(data.STEPS)]


def surface_points(grid):
    """Numbers of the points that outer faces have."""
    copy = vtk.vtkUnstructuredGrid()
    copy.ShallowCopy(grid)
    data.put(copy.GetPointData(), "number", np.arange(grid.GetNumberOfPoints()))
    extract = vtk.vtkDataSetSurfaceFilter()
    extract.SetInputData(copy)
    extract.Update()
    return np.sort(data.vtk_to_numpy(extract.GetOutput().GetPointData().GetArray("number")))


def field(clip, name, frame, mesh=0):
    number = [attribute.name for attribute in clip.meshes[mesh].attributes].index(name)
    return clip.meshes[mesh].attribute_at(number, clip.time(frame))


@pytest.mark.parametrize("name", FORMS)
def test_a_series_becomes_a_clip(tmp_path, steps, name):
    encoded = simulations.encode(data.write_series(steps, tmp_path / name), effort="fast")
    clip = anicodec.open(encoded)
    assert [clip.time(frame) for frame in range(len(clip))] == pytest.approx([0.5 * number for number in range(data.STEPS)])
    outer = surface_points(steps[0])
    if name == "beam.e":  # whose reader numbers points as cells use them
        rest = data.points_of(steps[0])
        outer = np.array([np.linalg.norm(rest - point, axis=1).argmin() for point in clip[0]])
    for frame, grid in enumerate(steps):
        assert np.linalg.norm(clip[frame] - data.points_of(grid)[outer], axis=1).max() <= 1.01 * clip.info["max_error"] + 1e-4
        heat = data.vtk_to_numpy(grid.GetPointData().GetArray("heat"))[outer]
        assert np.abs(field(clip, "heat", frame)[:, 0] - heat).max() <= 2e-3
    assert encoded.notes == [f"not kept: {steps[0].GetNumberOfPoints() - len(outer)} points that no face has (--all-points keeps them)"]


def test_fields_are_chosen_and_cells_keep_their_own(tmp_path, steps):
    path = data.write_series(steps, tmp_path / "beam.pvd")
    clip = anicodec.open(simulations.encode(path, fields="phase,stress", effort="fast", order="all"))
    shapes = {attribute.name: (attribute.domain, attribute.values.shape[1], attribute.moves) for attribute in clip.attributes}
    assert shapes == {"stress": ("vertices", 6, True), "phase": ("polygons", 1, True)}
    extract = vtk.vtkDataSetSurfaceFilter()
    extract.SetInputData(steps[3])
    extract.Update()
    phases = data.vtk_to_numpy(extract.GetOutput().GetCellData().GetArray("phase"))
    assert np.array_equal(np.rint(field(clip, "phase", 3)[:, 0]), phases)
    assert not anicodec.open(simulations.encode(path, fields="none", effort="fast")).attributes
    with pytest.raises(anicodec.InputError, match="beam.pvd: step 0: there is no field 'heta'; there is displacement, heat"):
        simulations.encode(path, fields=["heta"])


def test_fields_have_bounds_and_units_of_their_own(tmp_path):
    made = [data.beam(number, (4, 2, 2)) for number in range(4)]
    for grid in made:
        grid.GetPointData().GetArray("heat").GetInformation().Set(vtk.vtkDataArray.UNITS_LABEL(), "K")
    paths = [data.write(grid, tmp_path / f"unit_{number}.vtu") for number, grid in enumerate(made)]
    output = tmp_path / "unit.anic"
    assert _vtk_command.main(["encode", *map(str, paths), "-o", str(output), "-q", "--effort", "fast", "--order", "all", "--fields", "heat,phase",
                              "--field-error", "heat=0.0001", "--field-unit", "phase=1"]) == 0
    clip = anicodec.open(output)
    assert {a.name: (a.unit, a.whole) for a in clip.attributes} == {"heat": ("K", False), "phase": ("1", True)}
    outer = surface_points(made[0])
    for frame, grid in enumerate(made):
        heat = data.vtk_to_numpy(grid.GetPointData().GetArray("heat"))[outer]
        assert np.abs(field(clip, "heat", frame)[:, 0] - heat).max() <= 1.01e-4
    simulations.decode(clip, tmp_path / "unit.pvd")
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(tmp_path / "unit" / "2.vtp"))
    reader.Update()
    frame = reader.GetOutput()
    phases = data.vtk_to_numpy(frame.GetCellData().GetArray("phase"))
    assert phases.dtype == np.int32 and np.array_equal(phases, field(clip, "phase", 2)[:, 0])
    assert frame.GetPointData().GetArray("heat").GetInformation().Get(vtk.vtkDataArray.UNITS_LABEL()) == "K"


def test_as_many_faces_as_vertices_are_told_apart(tmp_path):
    """A torus of quads has as many of one as of the other."""
    around = np.linspace(0, 2 * np.pi, 6, endpoint=False)
    a, b = np.meshgrid(around, around, indexing="ij")
    points = np.stack([(2 + np.cos(b)) * np.cos(a), (2 + np.cos(b)) * np.sin(a), np.sin(b)], axis=-1).reshape(-1, 3)
    number = np.arange(36).reshape(6, 6)
    quads = np.stack([number, np.roll(number, -1, 0), np.roll(np.roll(number, -1, 0), -1, 1), np.roll(number, -1, 1)], axis=-1).reshape(-1, 4)
    data_of_cells = anicodec.Field("polygons", np.arange(36.0)[:, None])
    clip = anicodec.open(anicodec.encode([points, points], quads, custom={"of cells": data_of_cells, "of points": np.arange(36.0)[:, None]}))
    assert {a.name: a.domain for a in clip.attributes} == {"of cells": "polygons", "of points": "vertices"}
    with pytest.raises(anicodec.InputError, match="must be 36 polygons, not 144"):
        anicodec.encode([points, points], quads, custom={"x": anicodec.Field("polygons", np.arange(144.0)[:, None])})


def test_all_points_stay_if_asked(tmp_path, steps):
    path = data.write_series(steps, tmp_path / "beam.pvd")
    encoded = simulations.encode(path, all_points=True, effort="fast", fields="heat")
    clip = anicodec.open(encoded)
    assert clip.vertex_count == steps[0].GetNumberOfPoints() and encoded.notes == []
    assert np.allclose(clip[2], data.points_of(steps[2]), atol=0.01)
    particles = vtk.vtkPolyData()
    data.place(particles, np.random.default_rng(1).random((20, 3)))
    dust = data.write(particles, tmp_path / "dust.vtp")
    with pytest.raises(anicodec.InputError, match="dust.vtp: no cell has a face; --all-points .* keeps its 20 points"):
        simulations.encode(dust)
    assert anicodec.open(simulations.encode([dust, dust], all_points=True)).vertex_count == 20


@pytest.mark.parametrize("kind", [vtk.VTK_TETRA, vtk.VTK_WEDGE, vtk.VTK_QUADRATIC_TETRA, vtk.VTK_QUADRATIC_HEXAHEDRON, vtk.VTK_TRIANGLE])
def test_surfaces_of_other_cells(tmp_path, kind):
    made = [data.beam(number, (3, 2, 2), kind=kind) for number in range(3)]
    clip = anicodec.open(simulations.encode([data.write(grid, tmp_path / f"cell_{n}.vtu") for n, grid in enumerate(made)], effort="fast"))
    outer = surface_points(made[0])
    assert np.allclose(clip[2], data.points_of(made[2])[outer], atol=0.01) and len(clip.polygons[0]) > 10
    sizes = np.bincount(np.rint(field(clip, "material", 0)[:, 0]).astype(int), minlength=3)
    assert sizes.sum() == len(clip.polygons[0]) - 1 and (sizes > 0).all()


def test_cells_of_several_kinds_and_pieces(tmp_path):
    """A cube, a plate beside it, a line; then the same in two pieces of a parallel file."""
    grid = vtk.vtkUnstructuredGrid()
    data.place(grid, np.array([[x, y, z] for z in range(2) for y in range(2) for x in range(3)], float))
    for kind, corners in ((vtk.VTK_VOXEL, [0, 1, 3, 4, 6, 7, 9, 10]), (vtk.VTK_TRIANGLE, [1, 2, 5]), (vtk.VTK_QUAD, [7, 8, 11, 10]), (vtk.VTK_LINE, [2, 8])):
        grid.InsertNextCell(kind, len(corners), corners)
    data.put(grid.GetCellData(), "which", np.arange(4))
    path = data.write(grid, tmp_path / "mixed.vtu")
    encoded = simulations.encode([path, path], order="all", effort="fast")
    clip = anicodec.open(encoded)
    assert sorted(np.diff(clip.polygons[0])) == [3] + [4] * 7 and "1 lines" in encoded.notes[-1]
    assert sorted(field(clip, "which", 0)[:, 0]) == [0] * 6 + [1, 2]
    writer = vtk.vtkXMLPUnstructuredGridWriter()
    writer.SetFileName(str(tmp_path / "pieces.pvtu"))
    writer.SetInputData(data.beam(1))
    writer.SetNumberOfPieces(2)
    writer.SetEndPiece(1)
    writer.Write()
    pieces = anicodec.open(simulations.encode(tmp_path / "pieces.pvtu", effort="fast"))
    assert np.allclose(pieces[0].max(axis=0), data.points_of(data.beam(1)).max(axis=0), atol=0.02)


def test_strips_and_grids_have_faces(tmp_path):
    strip = vtk.vtkPolyData()
    data.place(strip, np.array([[i // 2, i % 2, 0.0] for i in range(8)]))
    cells = vtk.vtkCellArray()
    cells.InsertNextCell(8, range(8))
    strip.SetStrips(cells)
    data.put(strip.GetCellData(), "one", np.array([5.0]))
    clip = anicodec.open(simulations.encode(data.write(strip, tmp_path / "strip.vtp"), order="all"))
    corners = clip.triangles.astype(int)
    sides = np.cross(clip[0][corners[:, 1]] - clip[0][corners[:, 0]], clip[0][corners[:, 2]] - clip[0][corners[:, 0]])[:, 2]
    assert len(corners) == 6 and (np.sign(sides) == np.sign(sides[0])).all()
    image = vtk.vtkImageData()
    image.SetDimensions(4, 3, 1)
    image.SetSpacing(0.5, 1, 1)
    clip = anicodec.open(simulations.encode(data.write(image, tmp_path / "image.vti")))
    assert clip.vertex_count == 12 and clip[0].max(axis=0) == pytest.approx([1.5, 2, 0], abs=1e-2)


def test_blocks_are_meshes(tmp_path, steps):
    made = []
    for number in range(3):
        blocks = vtk.vtkMultiBlockDataSet()
        for index, name in enumerate(("frame", "wheel")):
            blocks.SetBlock(index, data.beam(number, (3 + index, 2, 2)))
            blocks.GetMetaData(index).Set(vtk.vtkCompositeDataSet.NAME(), name)
        made.append(data.write(blocks, tmp_path / f"car_{number}.vtm"))
    clip = anicodec.open(simulations.encode(str(tmp_path / "car_*.vtm"), effort="fast"))
    assert [mesh.name for mesh in clip.meshes] == ["frame", "wheel"] and len(clip) == 3 and clip.name == "car"


def test_a_fixed_mesh_is_moved_by_a_field(tmp_path):
    made = [data.beam(number, moved=False) for number in range(4)]
    paths = [data.write(grid, tmp_path / f"fixed_{number}.vtu") for number, grid in enumerate(made)]
    told = simulations.encode(paths, effort="fast", fields="none")
    assert told.notes[0] == "the points never move; --warp (warp=) moves them by a vector field: displacement"
    clip = anicodec.open(simulations.encode(paths, warp=("displacement", 3), effort="fast", fields="none"))
    outer = surface_points(made[0])
    for frame, grid in enumerate(made):
        points = data.points_of(grid)
        assert np.allclose(clip[frame], (points + 3 * data.swing(points, frame))[outer], atol=0.01)
    with pytest.raises(anicodec.InputError, match="fixed_0.vtu: has no vector field 'heat' of points; there is displacement"):
        simulations.encode(paths, warp="heat")


def test_displacements_of_exodus_are_not_added_twice(tmp_path, steps):
    path = data.write_series([data.beam(number, moved=False) for number in range(3)], tmp_path / "beam.e")
    moved, twice = (anicodec.open(simulations.encode(path, effort="fast", fields="none", **warp)) for warp in ({}, {"warp": ("displacement_", 2)}))
    rest = moved[0]
    assert np.allclose(twice[2] - rest, 2 * (moved[2] - rest), atol=0.02) and np.abs(moved[2] - rest).max() > 0.5


def test_meshes_that_change_are_segments_if_asked(tmp_path):
    paths = [data.write(data.beam(number, (4 + number // 2, 2, 2)), tmp_path / f"grow_{number}.vtu") for number in range(4)]
    with pytest.raises(anicodec.InputError, match=r"grow_2.vtu: has 54 points, not 45 as the steps before; --topology-changes keep"):
        simulations.encode(paths)
    clip = anicodec.open(simulations.encode(paths, topology_changes="keep", effort="fast"))
    assert [[mesh.shown_in(frame) for frame in range(4)] for mesh in clip.meshes] == [[True, True, False, False], [False, False, True, True]]


def test_times_come_from_data_and_stay_uneven(tmp_path):
    paths = []
    for number in range(4):
        grid = data.beam(number)
        data.put(grid.GetFieldData(), "TimeValue", np.array([2.0 + number ** 2]))
        paths.append(data.write(grid, tmp_path / f"t_{number}.vtu"))
    clip = anicodec.open(simulations.encode(paths, effort="fast"))
    assert clip.info["start_time"] == 2 and [clip.time(frame) for frame in range(4)] == pytest.approx([0, 1, 4, 9])
    encoded = simulations.encode(paths, effort="fast", fps=25)
    assert anicodec.open(encoded).duration == pytest.approx(3 / 25)
    assert encoded.notes[0] == "the steps' times, 2 to 11, are not kept, as the rate is given"
    with pytest.raises(anicodec.InputError, match=r"t_1.vtu: its time 3 is not after 6, that of the step before"):
        simulations.encode([paths[2], paths[1]])


def test_bad_steps_are_named(tmp_path):
    def fault(change):
        made = [data.beam(number) for number in range(3)]
        change(made[1])
        paths = [data.write(grid, tmp_path / f"bad_{number}.vtu") for number, grid in enumerate(made)]
        with pytest.raises(anicodec.InputError) as told:
            simulations.encode(paths)
        return str(told.value).replace(str(tmp_path), "")

    def not_a_number(grid):
        data.vtk_to_numpy(grid.GetPointData().GetArray("heat"))[5] = np.nan

    def no_point(grid):
        data.points_of(grid)[3] = np.inf

    assert fault(not_a_number) == "/bad_1.vtu: field 'heat' of point 5 is not a number; --fields (fields=) chooses others"
    assert fault(no_point) == "/bad_1.vtu: the position of point 3 is infinite"
    assert "/bad_1.vtu: the field 'heat' is missing" in fault(lambda grid: grid.GetPointData().RemoveArray("heat"))
    assert "/bad_1.vtu: the field 'new' is there, which" in fault(
        lambda grid: data.put(grid.GetCellData(), "new", np.zeros(grid.GetNumberOfCells())))
    assert "/bad_1.vtu: has other cells" in fault(lambda grid: data.vtk_to_numpy(grid.GetCells().GetConnectivityArray())[:8].sort())


def test_bad_files_are_named(tmp_path):
    pieces = {"none.vtu": "<VTKFile", "cut.vtk": "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 9 float\n0 0",
              "empty.pvd": "<VTKFile/>", "odd.pvd": "<a><", "gone.pvd": '<a><DataSet file="gone.vtu" timestep="0"/></a>',
              "odd.vtk.series": "[]", "time.pvd": '<a><DataSet file="x" timestep="soon"/></a>', "odd.vtkhdf": "x", "odd.xdmf": "<x", "odd.e": "x",
              "odd.case": "x"}
    for name, text in pieces.items():
        path = tmp_path / name
        path.write_text(text)
        with pytest.raises(anicodec.InputError, match=name):
            simulations.encode(path)
    with pytest.raises(FileNotFoundError):
        simulations.encode(tmp_path / "no.vtu")
    with pytest.raises(anicodec.InputError, match=r"no_\*.vtu: no file has such a name"):
        simulations.encode(tmp_path / "no_*.vtu")


def test_many_steps_lie_in_files(tmp_path):
    grid = vtk.vtkSphereSource()
    grid.Update()
    data.write(grid.GetOutput(), tmp_path / "same.vtp")
    entries = "".join(f'<DataSet timestep="{number}" file="same.vtp"/>' for number in range(500))
    (tmp_path / "long.pvd").write_text(f"<VTKFile><Collection>{entries}</Collection></VTKFile>")
    clip = anicodec.open(simulations.encode(tmp_path / "long.pvd", effort="fast", fields="none"))
    assert len(clip) == 500 and clip.fps == 1


def test_the_command_reads_them(tmp_path, steps, capsys):
    path, output = data.write_series(steps, tmp_path / "beam.pvd"), tmp_path / "beam.anic"
    told = subprocess.run([sys.executable, "-m", "anicodec", "encode", path, "-o", output, "--effort", "fast", "--fields", "heat", "--warp",
                           "displacement:0.5", "--json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert told.returncode == 0, told.stderr
    assert json.loads(told.stdout)["frames"] == data.STEPS
    for arguments, status, text in (((path, "-o", output), 1, "beam.anic: exists"), ((tmp_path / "no.vtu", "-o", output, "-f"), 1, "no.vtu"),
                                    ((path, "-o", output, "-f", "--fields", "x"), 2, "beam.pvd: step 0: there is no field 'x'"),
                                    ((path, "-o", output, "-f", "--faces", "x.npy"), 1, "--faces goes with positions"),
                                    ((path, "-o", output, "--nonsense"), 1, "--nonsense")):
        assert _vtk_command.main(["encode", *map(str, arguments)]) == status
        said = capsys.readouterr().err
        assert text in said and len(said.splitlines()) == 1, said


OUTPUTS = ["out.pvd", "out.vtkhdf", "out.xdmf"]


@pytest.fixture(scope="module")
def two_meshes(tmp_path_factory):
    """A clip whose second mesh is there in two steps, and what went into it."""
    folder, made = tmp_path_factory.mktemp("two"), []
    for number in range(5):
        blocks = vtk.vtkMultiBlockDataSet()
        for index, (name, grid) in enumerate((("beam", data.beam(number)), ("guest", data.beam(number, (3, 2, 2))))):
            if name == "beam" or number in (2, 3):
                blocks.SetBlock(index, grid)
                blocks.GetMetaData(index).Set(vtk.vtkCompositeDataSet.NAME(), name)
        made.append(data.write(blocks, folder / f"two_{number}.vtm"))
    return anicodec.open(simulations.encode(made, fps=5, effort="fast", order="all", max_error="0.001%"))


@pytest.mark.parametrize("name", OUTPUTS)
def test_a_clip_becomes_a_series(tmp_path, steps, name):
    """VTK reads the same positions, polygons, fields and times."""
    clip = anicodec.open(simulations.encode(data.write_series(steps, tmp_path / "beam.pvd"), effort="fast", order="all"))
    assert simulations.decode(clip, tmp_path / name) == []
    again = anicodec.open(simulations.encode(tmp_path / name, lossless=True, effort="fast", order="all"))
    assert np.array_equal(again[:], clip[:]) and np.array_equal(again.triangles, clip.triangles)
    parts = {f"stress_{k}" for k in range(6)} if name == "out.xdmf" else {"stress"}  # which XDMF keeps one by one
    assert again.fps == 2 and {a.name for a in again.attributes} == {"displacement", "heat", "phase", "material"} | parts
    for field_name in ("heat", "phase", "material", "displacement"):
        assert np.allclose(field(again, field_name, 4), field(clip, field_name, 4), atol=2e-2), field_name


@pytest.mark.parametrize("name", OUTPUTS)
def test_meshes_come_and_go_in_a_series(tmp_path, two_meshes, name):
    simulations.decode(two_meshes, tmp_path / name)
    again = anicodec.open(simulations.encode(tmp_path / name, lossless=True, effort="fast", order="all"))
    assert [mesh.name for mesh in again.meshes] == ["beam", "guest"] and again.fps == 5
    for mesh, source in zip(again.meshes, two_meshes.meshes):
        shown = [source.shown_in(frame) for frame in range(5)]
        assert [mesh.shown_in(frame) for frame in range(5)] == shown
        for frame in np.flatnonzero(shown):
            assert np.array_equal(mesh[int(frame)], source[int(frame)])


def test_hdf_keeps_polygons_once(tmp_path, wave):
    h5py = pytest.importorskip("h5py", reason="h5py is not installed")
    positions, faces = wave
    clip = anicodec.open(anicodec.encode(positions, faces, effort="fast", custom={"rest": positions[0, :, :1], "heat": positions[:, :, 2:]}))
    simulations.decode(clip, tmp_path / "wave.vtkhdf")
    with h5py.File(tmp_path / "wave.vtkhdf") as file:
        root = file["VTKHDF"]
        assert len(root["Polygons/Connectivity"]) == faces.size and len(root["Points"]) == positions[..., 0].size
        assert len(root["PointData/rest"]) == 144 and len(root["PointData/heat"]) == 144 * 24
    simulations.decode(clip, tmp_path / "wave.xdmf")
    with h5py.File(tmp_path / "wave.h5") as file:
        assert len([name for name in file["mesh0"] if name.startswith("positions")]) == 24 and "polygons" in file["mesh0"]


def test_origin_colours_and_labels_go_out(tmp_path, wave):
    positions, faces = wave
    far = positions.astype(np.float64) + np.array([4e5, 5e6, 0])
    colours = np.tile(np.linspace(0, 1, 144)[:, None], 3)
    clip = anicodec.open(anicodec.encode(far, faces, colours=colours, uv=np.zeros((faces.size, 2)), effort="fast", order="all",
                                         materials=(["cloth", "hem"], np.arange(len(faces)) % 2)))
    notes = simulations.decode(clip, tmp_path / "far.pvd")
    assert notes == ["not kept: uv of corners, names of materials"]
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(tmp_path / "far" / "07.vtp"))
    reader.Update()
    frame = reader.GetOutput()
    assert np.abs(data.points_of(frame) - far[7]).max() < 0.01 and data.points_of(frame).dtype == np.float64
    rgb = data.vtk_to_numpy(frame.GetPointData().GetArray("RGB"))
    assert rgb.dtype == np.uint8 and np.abs(rgb / 255 - colours).max() < 0.01
    assert set(data.vtk_to_numpy(frame.GetCellData().GetArray("material")).ravel()) == {1, 2}


def test_the_command_writes_them(tmp_path, steps, two_meshes, capsys):
    clip = tmp_path / "beam.anic"
    clip.write_bytes(simulations.encode(data.write_series(steps, tmp_path / "beam.pvd"), effort="fast", topology_changes="keep"))
    for name in OUTPUTS:
        assert _vtk_command.main(["decode", str(clip), "-o", str(tmp_path / "new" / name)]) == 0
        assert "6 frames of 1 mesh, " in capsys.readouterr().out
        assert _vtk_command.main(["decode", str(clip), "-o", str(tmp_path / "new" / name)]) == 1
        assert "exists (-f replaces it)" in capsys.readouterr().err
        assert _vtk_command.main(["decode", str(clip), "-o", str(tmp_path / "new" / name), "-f"]) == 0
    (tmp_path / "two.anic").write_bytes(two_meshes.data)
    (tmp_path / "bad.anic").write_bytes(two_meshes.data[:500])
    capsys.readouterr()
    for source, name, status, text in ((clip, "x.case", 1, "is not written; .pvd"), (tmp_path / "two.anic", "x.npz", 2, ".npz holds one mesh"),
                                       (tmp_path / "bad.anic", "x.pvd", 3, "bad.anic: "), (tmp_path / "no.anic", "x.pvd", 1, "no.anic")):
        assert _vtk_command.main(["decode", str(source), "-o", str(tmp_path / "other" / name)]) == status
        told = capsys.readouterr().err
        assert text in told and len(told.splitlines()) == 1 and not (tmp_path / "other" / name).exists(), told


def test_the_page_runs(tmp_path):
    """Every command of docs/howto/simulation.md, with the package's command and Python."""
    pytest.importorskip("h5py", reason="h5py is not installed")
    root = pathlib.Path(__file__).parents[2]
    for name, command in (("anicodec", f'"{sys.executable}" -m anicodec'), ("python3", f'"{sys.executable}"')):
        (tmp_path / name).write_text(f'#!/bin/sh\nexec {command} "$@"\n')
        (tmp_path / name).chmod(0o755)
    told = subprocess.run([sys.executable, root / "tests" / "scripts" / "run_howto.py", tmp_path, root / "docs" / "howto" / "simulation.md"],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert told.returncode == 0, told.stdout
