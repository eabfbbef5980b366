// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! Meshes that the CPU fills, in place.
use anicodec::{ValueOutput, When};
use bevy::mesh::VertexAttributeValues;
use bevy::prelude::*;

use crate::clip::AnicClip;
use crate::crowd::AnicCrowdMaterial;
use crate::player::{Instance, is_absent};

type Filled = (Without<MeshMaterial3d<AnicCrowdMaterial>>, With<Mesh3d>);

/// Writes positions, normals and moving colours of what was in sight, or has just come.
pub(crate) fn write(
    clips: Res<Assets<AnicClip>>,
    mut meshes: ResMut<Assets<Mesh>>,
    players: Query<(Ref<Instance>, &Mesh3d, &ViewVisibility), Filled>,
    mut points: Local<Vec<[f32; 3]>>,
) {
    for (instance, mesh, visibility) in &players {
        if !visibility.get() && !instance.is_added() {
            continue;
        }
        let (Some(clip), Some(mut mesh)) = (clips.get(instance.file), meshes.get_mut(mesh)) else { continue };
        if let Err(error) = fill(clip, &instance, &mut mesh, &mut points) {
            error_once!("AnicPlayer: {error}");
        }
    }
}

fn fill(clip: &AnicClip, instance: &Instance, mesh: &mut Mesh, points: &mut Vec<[f32; 3]>) -> anicodec::Result<()> {
    let Some(plan) = clip.plan(instance.mesh) else { return Ok(()) };
    points.resize(plan.vertices().len(), [0.0; 3]);
    match plan.positions_into(&instance.context, When::Current, points) {
        // All of it in one point, which draws nothing.
        Err(error) if is_absent(&error) => points.fill([0.0; 3]),
        Err(error) => return Err(error),
        Ok(()) => clip.turn(points),
    }
    if let Some(VertexAttributeValues::Float32x3(positions)) = mesh.attribute_mut(Mesh::ATTRIBUTE_POSITION) {
        positions.copy_from_slice(points);
    }
    if let Some(VertexAttributeValues::Float32x3(normals)) = mesh.attribute_mut(Mesh::ATTRIBUTE_NORMAL) {
        plan.normals_into(points, normals)?;
    }
    if let Some((colours, true)) = clip.colours(instance.mesh).filter(|_| instance.present)
        && let Some(VertexAttributeValues::Float32x4(values)) = mesh.attribute_mut(Mesh::ATTRIBUTE_COLOR)
    {
        let out = ValueOutput::values(values.as_flattened_mut()).components(4);
        plan.write_attribute(&instance.context, When::Current, colours, 0..plan.vertices().len() as u32, out)?;
    }
    Ok(())
}
