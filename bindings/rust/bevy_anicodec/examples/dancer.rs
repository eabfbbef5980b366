// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! A clip on the ground, with its shadow, drawn without a window. Prints milliseconds of opening it, with boxes and the vertices
//! of the graphics card, and of a frame of the plugin: seeking, positions and normals in a mesh; the least of some.
//!
//! usage: dancer CLIP.anic PICTURE.png [NAME OF A CLIP [CLIP TO FADE TO]]
mod headless;

use std::error::Error;
use std::time::Instant;

use bevy::prelude::*;
use bevy_anicodec::{AnicClip, AnicPlayer, AnicSettings, Track};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, path, picture, names @ ..] = &arguments[..] else {
        return Err("usage: dancer CLIP.anic PICTURE.png [NAME OF A CLIP [CLIP TO FADE TO]]".into());
    };
    let (folder, name) = headless::split(path)?;
    let mut app = headless::app(&folder, UVec2::new(640, 480), Vec3::new(0.6, 0.9, 1.7), Vec3::Y * 0.4, true);
    let file = headless::load(&mut app, &name)?;

    // One unit high, above the middle of the ground.
    let world = app.world_mut();
    let clips = world.resource::<Assets<AnicClip>>();
    let clip = clips.get(&file).ok_or("no clip")?;
    let material = clip.material(0);
    let bounds = clip.bounds(0).ok_or("a file without frames")?;
    let scale = 1.0 / (2.0 * bounds.half_extents.max_element());
    let foot = Vec3::from(bounds.center) - Vec3::Y * bounds.half_extents.y;
    let mut player = AnicPlayer::new(file).with_track(Track::new(names.first().map_or("", String::as_str)));
    if let Some(other) = names.get(1) {
        player.cross_fade(Track::new(other), 1.5);
    }
    let material = world.resource_mut::<Assets<StandardMaterial>>().add(material);
    let ground = world.resource_mut::<Assets<Mesh>>().add(Plane3d::new(Vec3::Y, Vec2::splat(4.0)).mesh());
    let grey = world.resource_mut::<Assets<StandardMaterial>>().add(Color::srgb(0.5, 0.55, 0.5));
    world.spawn((Mesh3d(ground), MeshMaterial3d(grey)));
    let place = Transform::from_translation(-foot * scale).with_scale(Vec3::splat(scale));
    world.spawn((player, MeshMaterial3d(material), place));

    headless::save(headless::draw(&mut app, 30)?, picture)?;
    let frame =
        app.world().resource::<headless::Spent>().frames.iter().skip(10).min().ok_or("no frames")?.as_secs_f64();
    let bytes = std::fs::read(path)?;
    let mut open = f64::INFINITY;
    for _ in 0..5 {
        let start = Instant::now();
        AnicClip::open(&bytes, &AnicSettings::default())?;
        open = open.min(start.elapsed().as_secs_f64());
    }
    println!("{:.3} {:.5}", 1e3 * open, 1e3 * frame);
    Ok(())
}
