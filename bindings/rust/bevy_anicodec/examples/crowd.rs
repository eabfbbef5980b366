// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! A crowd, each at a time of its own, in one draw call, drawn without a window. Prints how fast.
//!
//! usage: crowd CLIP.anic PICTURE.png [INSTANCES [FRAMES]]
mod headless;

use std::error::Error;
use std::time::{Duration, Instant};

use bevy::prelude::*;
use bevy_anicodec::{AnicBasis, AnicClip, AnicCrowdMaterial, AnicPlayer, Track};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, path, picture, numbers @ ..] = &arguments[..] else {
        return Err("usage: crowd CLIP.anic PICTURE.png [INSTANCES [FRAMES]]".into());
    };
    let count: u32 = numbers.first().map_or(Ok(1000), |text| text.parse())?;
    let frames: u32 = numbers.get(1).map_or(Ok(20), |text| text.parse())?;
    let (folder, name) = headless::split(path)?;
    let side = f64::from(count).sqrt().ceil() as u32;
    let far = side as f32;
    let mut app = headless::app(
        &folder,
        UVec2::new(960, 540),
        Vec3::new(0.0, 0.3 * far + 1.0, 0.7 * far + 1.5),
        Vec3::Z * 0.1 * far,
        false,
    );
    let file = headless::load(&mut app, &name)?;

    let world = app.world_mut();
    let clips = world.resource::<Assets<AnicClip>>();
    let clip = clips.get(&file).ok_or("no clip")?;
    let bounds = clip.bounds(0).ok_or("a file without frames")?;
    let names: Vec<String> = clip.clip().clips().map(|one| one.name.to_string()).collect();
    let duration = clip.clip().clip(0)?.duration;
    let base = StandardMaterial { base_color: Color::srgb(0.85, 0.5, 0.3), ..clip.material(0) };
    let scale = 1.0 / (2.0 * bounds.half_extents.max_element());
    let foot = Vec3::from(bounds.center) - Vec3::Y * bounds.half_extents.y;
    let material = world
        .resource_mut::<Assets<AnicCrowdMaterial>>()
        .add(AnicCrowdMaterial { base, extension: AnicBasis::default() });
    for i in 0..count {
        let mut track = Track::new(names[i as usize % names.len()].clone());
        track.time = duration * f64::from(i) * 0.618;
        let at = Vec3::new((i % side) as f32, 0.0, (i / side) as f32) - Vec3::new(far, 0.0, far) * 0.5;
        let place = Transform::from_translation(at - foot * scale).with_scale(Vec3::splat(scale));
        world.spawn((AnicPlayer::new(file.clone()).with_track(track), MeshMaterial3d(material.clone()), place));
    }

    headless::save(headless::draw(&mut app, 1)?, picture)?;
    app.world_mut().resource_mut::<headless::Spent>().frames.clear();
    let start = Instant::now();
    for _ in 0..frames {
        app.update();
    }
    let each = start.elapsed().as_secs_f64() / f64::from(frames);
    let spent =
        app.world().resource::<headless::Spent>().frames.iter().sum::<Duration>().as_secs_f64() / f64::from(frames);
    println!(
        "{count} instances of {name}: {:.2} frames a second, of a frame {:.3} ms in the plugin",
        1.0 / each,
        1e3 * spent
    );
    Ok(())
}
