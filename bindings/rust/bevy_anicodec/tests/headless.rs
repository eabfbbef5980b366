// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! Plays files without a window, on the graphics card that there is, Mesa's software Vulkan for one.
#[path = "../examples/headless/mod.rs"]
mod headless;

use std::path::{Path, PathBuf};

use anicodec::{Clip, NormalOptions, RenderOptions, When};
use bevy::camera::primitives::Aabb;
use bevy::core_pipeline::core_3d::Opaque3d;
use bevy::mesh::VertexAttributeValues;
use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::render_phase::ViewBinnedRenderPhases;
use bevy_anicodec::{AnicBasis, AnicClip, AnicCrowdMaterial, AnicPlayer, Sampling, Track, Wrap};

fn golden() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../tests/golden")
}

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../anicodec/examples")
}

fn app(folder: &Path) -> App {
    headless::app(folder, UVec2::new(160, 120), Vec3::new(0.0, 1.0, 3.5), Vec3::ZERO, true)
}

/// A unit high, around the origin.
fn placed(clip: &AnicClip, at: Vec3) -> Transform {
    let bounds = clip.bounds(0).unwrap();
    let scale = 1.0 / (2.0 * bounds.half_extents.max_element()).max(1e-9);
    Transform::from_translation(at - Vec3::from(bounds.center) * scale).with_scale(Vec3::splat(scale))
}

fn positions(app: &App, entity: Entity) -> Vec<[f32; 3]> {
    let mesh = app.world().get::<Mesh3d>(entity).unwrap();
    let mesh = app.world().resource::<Assets<Mesh>>().get(mesh).unwrap();
    match mesh.attribute(Mesh::ATTRIBUTE_POSITION).unwrap() {
        VertexAttributeValues::Float32x3(positions) => positions.clone(),
        other => panic!("{other:?}"),
    }
}

/// The positions that the crate anicodec makes of a moment of a player, in Bevy's axes.
fn expected(file: &Clip, player: &AnicPlayer) -> Vec<[f32; 3]> {
    let mesh = file.mesh(player.mesh).unwrap();
    let plan =
        mesh.render_plan(&RenderOptions { crease_angle: 60.0, source_edges: true, ..Default::default() }).unwrap();
    let mut context = file.context().unwrap();
    let track = &player.track;
    context.set_clip(file.find_clip(&track.clip).unwrap()).unwrap();
    context.seek(track.time, track.sampling, track.wrap).unwrap();
    if let Some(other) = &player.other {
        let number = file.find_clip(&other.clip).unwrap();
        context.blend(number, other.time, other.sampling, other.wrap, player.weight).unwrap();
    }
    let mut points = vec![[0.0; 3]; plan.vertices().len()];
    plan.positions_into(&context, When::Current, &mut points).unwrap();
    if file.info().up == anicodec::UpAxis::Z {
        points.iter_mut().for_each(|[_, y, z]| (*y, *z) = (*z, -*y));
    }
    points
}

#[test]
fn meshes_hold_what_the_decoder_gives() {
    let mut app = app(&examples());
    let file = headless::load(&mut app, "walk.anic").unwrap();
    let clip = Clip::open(std::fs::read(examples().join("walk.anic")).unwrap()).unwrap();
    let mut player = AnicPlayer::new(file.clone()).with_track(Track { speed: -1.5, ..Track::new("walk") });
    (player.other, player.weight) = (Some(Track::new("stand")), 0.25);
    let material = app.world_mut().resource_mut::<Assets<StandardMaterial>>().add(Color::WHITE);
    let world = app.world_mut();
    let transform = placed(world.resource::<Assets<AnicClip>>().get(&file).unwrap(), Vec3::ZERO);
    let entity = world.spawn((player, MeshMaterial3d(material), transform)).id();
    for _ in 0..7 {
        app.update();
        let player = app.world().get::<AnicPlayer>(entity).unwrap();
        let points = positions(&app, entity);
        assert_eq!(points, expected(&clip, player));
        let aabb = app.world().get::<Aabb>(entity).unwrap();
        let (min, max) = (aabb.min() - 1e-3, aabb.max() + 1e-3);
        assert!(points.iter().all(|&p| Vec3::from(p).cmpge(min.into()).all() && Vec3::from(p).cmple(max.into()).all()));
        assert!(aabb.half_extents.max_element() < 1e3, "{aabb:?}");
    }
    let player = app.world().get::<AnicPlayer>(entity).unwrap();
    assert!((player.track.time + 7.0 * 1.5 / 30.0).abs() < 1e-6, "{}", player.track.time);

    // Nothing else is written while time stands still, and an unknown clip changes nothing.
    let before = positions(&app, entity);
    let mut player = app.world_mut().get_mut::<AnicPlayer>(entity).unwrap();
    (player.paused, player.track.clip) = (true, "fly".into());
    app.update();
    assert_eq!(positions(&app, entity), before);
}

#[test]
fn normals_follow_and_colours_move() {
    let mut app = app(&examples());
    let file = headless::load(&mut app, "heated.anic").unwrap();
    let clip = Clip::open(std::fs::read(examples().join("heated.anic")).unwrap()).unwrap();
    assert!(clip.mesh(0).unwrap().normal_plan(&NormalOptions::default()).is_ok());
    let world = app.world_mut();
    let material = world.resource_mut::<Assets<StandardMaterial>>().add(Color::WHITE);
    let transform = placed(world.resource::<Assets<AnicClip>>().get(&file).unwrap(), Vec3::ZERO);
    let entity = world.spawn((AnicPlayer::new(file), MeshMaterial3d(material), transform)).id();
    let seen = |app: &App| {
        let mesh = app.world().resource::<Assets<Mesh>>().get(app.world().get::<Mesh3d>(entity).unwrap()).unwrap();
        let Some(VertexAttributeValues::Float32x4(colours)) = mesh.attribute(Mesh::ATTRIBUTE_COLOR) else { panic!() };
        let Some(VertexAttributeValues::Float32x3(normals)) = mesh.attribute(Mesh::ATTRIBUTE_NORMAL) else { panic!() };
        assert!(normals.iter().all(|&n| (Vec3::from(n).length() - 1.0).abs() < 1e-3));
        colours.clone()
    };
    app.update();
    let first = seen(&app);
    (0..5).for_each(|_| app.update());
    assert_ne!(seen(&app), first);
}

/// The picture of some moments of a file on the ground, by meshes of their own or as a crowd; the number of draws of a crowd.
fn picture(folder: &Path, name: &str, crowd: bool) -> (Vec<u8>, usize) {
    let mut app = app(folder);
    let file = headless::load(&mut app, name).unwrap();
    let world = app.world_mut();
    let ground = world.resource_mut::<Assets<Mesh>>().add(Plane3d::new(Vec3::Y, Vec2::splat(4.0)).mesh());
    let grey = world.resource_mut::<Assets<StandardMaterial>>().add(Color::srgb(0.5, 0.5, 0.5));
    world.spawn((Mesh3d(ground), MeshMaterial3d(grey), Transform::from_xyz(0.0, -0.7, 0.0)));
    // Without light on them: facets and smooth normals differ. Their shadows are compared, too.
    let base = StandardMaterial { base_color: Color::srgb(0.9, 0.3, 0.1), unlit: true, cull_mode: None, ..default() };
    let clip = world.resource::<Assets<AnicClip>>().get(&file).unwrap();
    let names: Vec<String> = clip.clip().clips().map(|one| one.name.to_string()).collect();
    let duration = clip.clip().clip(0).unwrap().duration;
    let place = |x: f32| placed(clip, Vec3::new(x, -0.2, 0.0));
    let moments: Vec<_> = [-1.1, 0.0, 1.1]
        .into_iter()
        .enumerate()
        .map(|(i, x)| {
            let time = duration * [0.11, 0.5, 0.83][i];
            let (wrap, sampling) = (Wrap::Loop, if i == 1 { Sampling::Cubic } else { Sampling::Linear });
            let track = |clip: &str| Track { clip: clip.into(), time, speed: 0.0, wrap, sampling };
            let mut player = AnicPlayer::new(file.clone()).with_track(track(&names[0]));
            (player.other, player.weight) = (Some(track(names.last().unwrap())), 0.4);
            (player, place(x))
        })
        .collect();
    if crowd {
        let material = AnicCrowdMaterial { base, extension: AnicBasis::default() };
        let material = world.resource_mut::<Assets<AnicCrowdMaterial>>().add(material);
        for moment in moments {
            world.spawn((moment, MeshMaterial3d(material.clone())));
        }
    } else {
        let material = world.resource_mut::<Assets<StandardMaterial>>().add(base);
        for moment in moments {
            world.spawn((moment, MeshMaterial3d(material.clone())));
        }
    }
    let image = headless::draw(&mut app, 3).unwrap();
    let phases = app.sub_app(RenderApp).world().resource::<ViewBinnedRenderPhases<Opaque3d>>();
    let draws = phases
        .values()
        .map(|phase| {
            let (multi, single) = (&phase.multidrawable_meshes, &phase.batchable_meshes);
            multi.len() + single.len() + phase.unbatchable_meshes.len()
        })
        .sum();
    if let Some(folder) = std::env::var_os("ANICODEC_PICTURES") {
        let path = Path::new(&folder).join(format!("{name}.{}.png", if crowd { "crowd" } else { "meshes" }));
        headless::save(image.clone(), path).unwrap();
    }
    (image.data.unwrap(), draws)
}

#[test]
fn crowds_look_as_meshes_do() {
    let names = [
        "default",
        "eigenshapes",
        "eigentrajectories",
        "keyframes",
        "cuts",
        "rigid",
        "clips",
        "root_motion",
        "uneven",
        "joined",
    ];
    for name in names {
        let name = format!("{name}.anic");
        let (meshes, _) = picture(&golden(), &name, false);
        let (crowd, draws) = picture(&golden(), &name, true);
        assert_eq!(draws, 2, "{name}: the ground and the crowd");
        let shown = meshes.chunks(4).filter(|pixel| pixel[0] > 200 && pixel[2] < 120).count();
        assert!(shown > 150, "{name}: {shown} pixels of the clip");
        let differs = |(a, b): &(&[u8], &[u8])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 24);
        let others = meshes.chunks(4).zip(crowd.chunks(4)).filter(differs).count();
        println!("{name}: {shown} pixels of the clip, {others} differ");
        assert!(others <= shown / 100, "{name}: {others} pixels differ of {shown}");
    }
}

#[test]
fn what_a_shader_cannot_make_is_not_drawn() {
    let (meshes, _) = picture(&golden(), "interpolated.anic", false);
    let (crowd, draws) = picture(&golden(), "interpolated.anic", true);
    assert_eq!(draws, 1);
    assert_ne!(meshes, crowd);
}

#[test]
fn damaged_files_name_the_place() {
    let folder = std::env::temp_dir().join(format!("bevy_anicodec.{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let mut file = std::fs::read(examples().join("walk.anic")).unwrap();
    file[300] ^= 1;
    std::fs::write(folder.join("damaged.anic"), file).unwrap();
    let error = headless::load(&mut app(&folder), "damaged.anic").unwrap_err().to_string();
    std::fs::remove_dir_all(&folder).unwrap();
    assert!(error.contains("damaged.anic") && error.contains("chunk"), "{error}");
}
