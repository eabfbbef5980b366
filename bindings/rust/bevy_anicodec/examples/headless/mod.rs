// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! An app without a window, whose camera draws into a picture.
#![allow(dead_code, reason = "each program uses a part of it")]
use std::error::Error;
use std::path::Path;
use std::time::{Duration, Instant};

use bevy::asset::{AssetPlugin, RenderAssetUsages};
use bevy::camera::RenderTarget;
use bevy::core_pipeline::tonemapping::{DebandDither, Tonemapping};
use bevy::log::LogPlugin;
use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::pipelined_rendering::PipelinedRenderingPlugin;
use bevy::render::render_resource::{Extent3d, PipelineCache, TextureDimension, TextureFormat, TextureUsages};
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured};
use bevy::time::TimeUpdateStrategy;
use bevy::window::{ExitCondition, WindowPlugin};
use bevy_anicodec::{AnicClip, AnicPlugin, AnicSystems};

/// The picture that the camera draws into.
#[derive(Resource)]
pub struct Picture(pub Handle<Image>);

/// The picture that a screenshot gave.
#[derive(Resource)]
struct Taken(Image);

/// Time that the systems of the plugin took in each frame.
#[derive(Resource, Default)]
pub struct Spent {
    begin: Option<Instant>,
    pub frames: Vec<Duration>,
}

/// An app whose assets lie in a folder, with a light and a camera at `eye` that looks at `at`; a frame is a 30th of a second.
pub fn app(folder: &Path, size: UVec2, eye: Vec3, at: Vec3, shadows: bool) -> App {
    let mut app = App::new();
    let window = WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() };
    let files = AssetPlugin { file_path: folder.display().to_string(), ..default() };
    // A frame is drawn where it is made, so that one call is one frame.
    let plugins = DefaultPlugins.set(window).set(files).disable::<PipelinedRenderingPlugin>();
    let log = LogPlugin { filter: "warn,bevy_render::renderer=error".into(), ..default() };
    // Only the first app of a process can have the log.
    let plugins = if cfg!(test) { plugins.disable::<LogPlugin>() } else { plugins.set(log) };
    app.add_plugins((plugins, AnicPlugin))
        .init_resource::<Spent>()
        .add_systems(PostUpdate, (begin.before(AnicSystems), end.after(AnicSystems)))
        .insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs_f64(1.0 / 30.0)))
        .insert_resource(ClearColor(Color::srgb(0.75, 0.82, 0.9)));
    let extent = Extent3d { width: size.x, height: size.y, depth_or_array_layers: 1 };
    let (format, usage) = (TextureFormat::Rgba8UnormSrgb, RenderAssetUsages::default());
    let mut picture = Image::new_fill(extent, TextureDimension::D2, &[0; 4], format, usage);
    picture.texture_descriptor.usage |= TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC;
    let picture = app.world_mut().resource_mut::<Assets<Image>>().add(picture);
    app.world_mut().spawn((
        Camera3d::default(),
        Camera::default(),
        RenderTarget::Image(picture.clone().into()),
        Tonemapping::None,
        DebandDither::Disabled,
        Msaa::Off,
        Transform::from_translation(eye).looking_at(at, Vec3::Y),
    ));
    app.world_mut().spawn((
        DirectionalLight { illuminance: 4000.0, shadow_maps_enabled: shadows, ..default() },
        Transform::from_xyz(3.0, 6.0, 4.0).looking_at(Vec3::ZERO, Vec3::Y),
    ));
    app.insert_resource(Picture(picture));
    app.finish();
    app.cleanup();
    app
}

/// Loads a file of the folder, and waits for it.
pub fn load(app: &mut App, name: &str) -> Result<Handle<AnicClip>, Box<dyn Error>> {
    let server = app.world().resource::<AssetServer>().clone();
    let file: Handle<AnicClip> = server.load(name.to_owned());
    let begin = Instant::now();
    while !app.world().resource::<Assets<AnicClip>>().contains(&file) {
        if let bevy::asset::LoadState::Failed(error) = server.load_state(&file) {
            return Err(error.to_string().into());
        }
        if begin.elapsed() > Duration::from_secs(60) {
            return Err("the file does not arrive".into());
        }
        app.update();
    }
    Ok(file)
}

/// Draws so many frames, once the shaders are compiled, and returns the picture of the last one.
pub fn draw(app: &mut App, frames: u32) -> Result<Image, Box<dyn Error>> {
    app.world_mut().resource_mut::<Time<Virtual>>().pause();
    let begin = Instant::now();
    let mut calm = 0;
    while calm < 10 {
        app.update();
        let waiting = app.sub_app(RenderApp).world().resource::<PipelineCache>().waiting_pipelines().count();
        calm = if waiting == 0 { calm + 1 } else { 0 };
        if begin.elapsed() > Duration::from_secs(600) {
            return Err("shaders are not compiled".into());
        }
    }
    app.world_mut().resource_mut::<Time<Virtual>>().unpause();
    (0..frames).for_each(|_| app.update());
    app.world_mut().resource_mut::<Time<Virtual>>().pause();
    let picture = app.world().resource::<Picture>().0.clone();
    app.world_mut().spawn(Screenshot::image(picture)).observe(
        |taken: On<ScreenshotCaptured>, mut commands: Commands| {
            commands.insert_resource(Taken(taken.image.clone()));
        },
    );
    for _ in 0..600 {
        app.update();
        if let Some(taken) = app.world_mut().remove_resource::<Taken>() {
            app.world_mut().resource_mut::<Time<Virtual>>().unpause();
            return Ok(taken.0);
        }
    }
    Err("the picture is not taken".into())
}

/// Writes a picture as PNG.
pub fn save(picture: Image, path: impl AsRef<Path>) -> Result<(), Box<dyn Error>> {
    Ok(picture.try_into_dynamic()?.to_rgb8().save(path)?)
}

/// Folder and name of a file.
pub fn split(path: &str) -> Result<(std::path::PathBuf, String), Box<dyn Error>> {
    let path = std::path::absolute(path)?;
    let (folder, name) = path.parent().zip(path.file_name()).ok_or("no file")?;
    Ok((folder.into(), name.to_string_lossy().into_owned()))
}

fn begin(mut spent: ResMut<Spent>) {
    spent.begin = Some(Instant::now());
}

fn end(mut spent: ResMut<Spent>) {
    if let Some(begin) = spent.begin.take() {
        spent.frames.push(begin.elapsed());
    }
}
