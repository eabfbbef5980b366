# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""The scene of the round trip, made and exported by Blender: make_scene.py -- FOLDER

An arm with a skin over two bones, two materials and caps of one polygon each, and a crate on a parent that moves; 25
frames a second. truth.npz holds what the evaluated scene shows.
"""
import math
import pathlib
import sys

import addon_utils
import bpy
import numpy as np

FOLDER = pathlib.Path(sys.argv[sys.argv.index("--") + 1])
FRAMES, RATE, SIDES, RINGS = 36, 25, 10, 9


def add_material(name, colour, metallic, roughness, emissive=(0, 0, 0)):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1)
    shader.inputs["Metallic"].default_value = metallic
    shader.inputs["Roughness"].default_value = roughness
    shader.inputs["Emission"].default_value = (*emissive, 1)
    material.use_backface_culling = True
    return material


def add_arm():
    """A tube along x: a ring of quads of either material in turn, and a cap at either end."""
    rings = [[(0.5 * ring, 0.3 * math.cos(2 * math.pi * k / SIDES), 0.3 * math.sin(2 * math.pi * k / SIDES))
              for k in range(SIDES)] for ring in range(RINGS)]
    faces = [[(r + a) * SIDES + (k + b) % SIDES for a, b in ((0, 0), (0, 1), (1, 1), (1, 0))]
             for r in range(RINGS - 1) for k in range(SIDES)]
    faces += [list(range(SIDES)), list(range((RINGS - 1) * SIDES, RINGS * SIDES))[::-1]]
    mesh = bpy.data.meshes.new("Arm")
    mesh.from_pydata([point for ring in rings for point in ring], [], faces)
    layer = mesh.uv_layers.new(name="UVMap")
    for loop in mesh.loops:
        ring, side = divmod(loop.vertex_index, SIDES)
        layer.data[loop.index].uv = (ring / RINGS, side / SIDES)
    mesh.materials.append(add_material("Skin", (0.8, 0.4, 0.2), 0.0, 0.75))
    mesh.materials.append(add_material("Sleeve", (0.125, 0.25, 0.5), 0.5, 0.25, (0, 0.5, 0)))
    for polygon in mesh.polygons:
        polygon.material_index = polygon.index // SIDES % 2
        polygon.use_smooth = True
    item = bpy.data.objects.new("Arm", mesh)
    bpy.context.collection.objects.link(item)
    return item


def add_bones(arm):
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    upper = rig.data.edit_bones.new("Upper")
    upper.head, upper.tail = (0, 0, 0), (2, 0, 0)
    lower = rig.data.edit_bones.new("Lower")
    lower.head, lower.tail, lower.parent, lower.use_connect = (2, 0, 0), (4, 0, 0), upper, True
    bpy.ops.object.mode_set(mode="OBJECT")
    groups = {name: arm.vertex_groups.new(name=name) for name in ("Upper", "Lower")}
    for vertex in arm.data.vertices:
        share = min(max((vertex.co.x - 1.5), 0), 1)
        groups["Lower"].add([vertex.index], share, "REPLACE")
        groups["Upper"].add([vertex.index], 1 - share, "REPLACE")
    arm.parent = rig
    arm.modifiers.new("Rig", "ARMATURE").object = rig
    bone = rig.pose.bones["Lower"]
    bone.rotation_mode = "XYZ"
    for frame, angle in ((1, 0), (8, 1.2), (21, -0.7), (FRAMES, 0)):
        bone.rotation_euler = (0, 0, angle)
        bone.keyframe_insert("rotation_euler", frame=frame)
    rig.animation_data.action.name = "Wave"


def add_crate():
    parent = bpy.data.objects.new("Carrier", None)
    bpy.context.collection.objects.link(parent)
    for frame, place, turn in ((1, (0, 3, 0), 0), (15, (2, 3, 1), 1), (FRAMES, (4, 3, 0), 2)):
        parent.location, parent.rotation_euler = place, (0, 0, turn)
        parent.keyframe_insert("location", frame=frame)
        parent.keyframe_insert("rotation_euler", frame=frame)
    parent.animation_data.action.name = "Carry"
    bpy.ops.mesh.primitive_cube_add(size=1, calc_uvs=True)
    crate = bpy.context.object
    crate.name = crate.data.name = "Crate"
    crate.parent = parent
    crate.location = (0, 0, 0.5)
    crate.data.materials.append(add_material("Wood", (0.5, 0.25, 0.125), 0.0, 1.0))


def record():
    """Contents of the scene: positions in the world, polygons, texture coordinates, materials."""
    scene, truth = bpy.context.scene, {}
    for name in ("Arm", "Crate"):
        frames = []
        for frame in range(1, FRAMES + 1):
            scene.frame_set(frame)
            item = bpy.data.objects[name].evaluated_get(bpy.context.evaluated_depsgraph_get())
            points = np.empty(3 * len(item.data.vertices), np.float32)
            item.data.vertices.foreach_get("co", points)
            matrix = np.array(item.matrix_world)
            frames.append(points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3])
        mesh = bpy.data.objects[name].data
        uv = np.empty(2 * len(mesh.loops), np.float32)
        mesh.uv_layers[0].data.foreach_get("uv", uv)
        corners = np.empty(len(mesh.loops), np.int32)
        mesh.loops.foreach_get("vertex_index", corners)
        truth[name] = np.array(frames)
        truth[name + " uv"], truth[name + " corners"] = uv.reshape(-1, 2), corners
        truth[name + " sizes"] = np.array([polygon.loop_total for polygon in mesh.polygons])
        truth[name + " materials"] = np.array([mesh.materials[polygon.material_index].name for polygon in mesh.polygons])
    scene.frame_set(1)
    np.savez(FOLDER / "truth.npz", **truth)


def export():
    for module in ("io_scene_gltf2", "io_scene_fbx", "io_export_pc2", "io_shape_mdd"):
        addon_utils.enable(module)
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.export_scene.gltf(filepath=str(FOLDER / "scene.glb"))
    bpy.ops.export_scene.fbx(filepath=str(FOLDER / "scene.fbx"))
    (FOLDER / "frames").mkdir(exist_ok=True)
    bpy.ops.wm.obj_export(filepath=str(FOLDER / "frames" / "scene.obj"), export_animation=True, start_frame=1,
                          end_frame=FRAMES)
    for item in bpy.data.objects:
        item.select_set(item.name == "Arm")
    bpy.context.view_layer.objects.active = bpy.data.objects["Arm"]
    bpy.context.scene.frame_set(1)
    for name in ("pc2", "mdd"):
        bpy.ops.wm.obj_export(filepath=str(FOLDER / f"{name}.obj"), export_selected_objects=True,
                              apply_modifiers=True, forward_axis="Y", up_axis="Z")
    bpy.ops.export_shape.pc2(filepath=str(FOLDER / "pc2.pc2"), rot_x90=False, world_space=True, range_start=1,
                             range_end=FRAMES, sampling="1")
    bpy.ops.export_shape.mdd(filepath=str(FOLDER / "mdd.mdd"), fps=RATE, frame_start=1, frame_end=FRAMES,
                             use_rest_frame=False)


def main():
    bpy.ops.wm.read_homefile(use_empty=True)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end, scene.render.fps = 1, FRAMES, RATE
    add_bones(add_arm())
    add_crate()
    record()
    export()


main()
