// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! The crate on conformance files: what its functions agree on, and what they refuse.
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::Arc;

use anicodec::{
    AttributeKind, Clip, Error, Format, NormalOptions, OpenOptions, Output, Ray, Reconstruction,
    RenderOptions, Sampling, Side, Status, Stream, SurfacePoint, Texture, ValueFormat, ValueOutput,
    When, Wrap,
};

fn bytes(name: &str) -> Vec<u8> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../conformance");
    std::fs::read(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn clip(name: &str) -> Clip {
    Clip::open(bytes(name)).unwrap()
}

fn status<T>(result: Result<T, Error>) -> Status {
    result.err().expect("an error").status()
}

#[test]
fn clips_and_contexts_go_to_other_threads() {
    fn shared<T: Send + Sync + 'static>() {}
    shared::<Clip>();
    shared::<anicodec::Context>();
    shared::<anicodec::NormalPlan>();
    shared::<anicodec::RenderPlan>();
    shared::<Stream>();
    shared::<Error>();

    let clip = clip("limb_default.anic");
    let alone = |frame| {
        let mut context = clip.context().unwrap();
        context.seek_frame(frame).unwrap();
        context.positions().unwrap()
    };
    let frames = clip.info().frame_count;
    let made: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..frames)
            .map(|frame| scope.spawn(move || alone(frame)))
            .collect();
        threads
            .into_iter()
            .map(|thread| thread.join().unwrap())
            .collect()
    });
    for frame in 0..frames {
        assert_eq!(made[frame as usize], alone(frame));
    }
}

#[test]
fn a_context_keeps_its_clip_open() {
    let mut context = clip("walk.anic").context().unwrap();
    context.seek_frame(1).unwrap();
    assert!(!context.positions().unwrap().is_empty());
    assert_eq!(context.clip().clips().len(), 3);
}

#[test]
fn clips_have_names_and_events() {
    let clip = clip("walk.anic");
    let names: Vec<String> = clip.clips().map(|c| c.name.to_string()).collect();
    assert_eq!(names, ["turn", "stand", "walk"]);
    assert_eq!(clip.find_clip("walk"), Some(2));
    assert_eq!(
        (clip.find_clip("swim"), clip.find_clip("a\0b")),
        (None, None)
    );
    let events: Vec<_> = clip
        .events(2)
        .map(|e| (e.name.to_string(), e.seconds))
        .collect();
    assert_eq!(
        events,
        [
            ("left".into(), 0.1),
            ("right".into(), 0.1),
            (String::new(), 0.65)
        ]
    );
    assert_eq!((clip.events(1).len(), clip.events(9).len()), (0, 0));
    assert_eq!(status(clip.clip(3)), Status::Argument);
    assert_eq!(status(clip.mesh(1)), Status::Argument);
}

#[test]
fn blending_goes_from_one_clip_to_another() {
    let clip = clip("clips.anic");
    let mut context = clip.context().unwrap();
    context.set_clip(1).unwrap();
    context.seek(0.0, Sampling::Linear, Wrap::Clamp).unwrap();
    let first = context.positions().unwrap();
    context
        .blend(0, 0.0, Sampling::Linear, Wrap::Clamp, 0.0)
        .unwrap();
    assert_eq!(context.positions().unwrap(), first);
    context
        .blend(0, 0.0, Sampling::Linear, Wrap::Clamp, 1.0)
        .unwrap();
    let second = context.positions().unwrap();
    assert_ne!(first, second);
    context
        .seek_frame(clip.clip(0).unwrap().first_frame)
        .unwrap();
    assert_eq!(context.positions().unwrap(), second);
    assert_eq!(
        status(context.blend(0, 0.0, Sampling::Linear, Wrap::Clamp, 1.5)),
        Status::Argument
    );
    assert_eq!(status(context.set_clip(99)), Status::Argument);
}

#[test]
fn motion_since_the_last_seek_is_known() {
    let clip = clip("limb_default.anic");
    let mut context = clip.context().unwrap();
    assert_eq!(status(context.positions()), Status::State);
    context.seek_frame(2).unwrap();
    let before = context.positions().unwrap();
    context.seek_frame(5).unwrap();
    assert_eq!(
        context.shown(0, When::Previous).positions().unwrap(),
        before
    );
    context.forget_previous().unwrap();
    assert_eq!(
        context.shown(0, When::Previous).positions(),
        context.positions()
    );
    assert_eq!(status(context.seek_frame(1000)), Status::FrameRange);
    assert_eq!(
        status(context.seek(f64::NAN, Sampling::Linear, Wrap::Loop)),
        Status::Argument
    );
}

#[test]
fn buffers_are_checked() {
    let clip = clip("limb_default.anic");
    let count = clip.mesh(0).unwrap().vertex_count;
    let mut context = clip.context().unwrap();
    context.seek_frame(2).unwrap();
    let whole = context.positions().unwrap();
    let shown = context.shown(0, When::Current);
    let mut points = vec![[0.0; 3]; count as usize + 1];
    assert_eq!(status(shown.positions_into(&mut points)), Status::Argument);
    assert_eq!(
        status(shown.positions_into(&mut points[..5])),
        Status::BufferSize
    );
    shown.positions_from(16, &mut points[..40]).unwrap();
    assert_eq!(points[..40], whole[16..56]);
    assert_eq!(
        status(shown.positions_from(u32::MAX, &mut points[..5])),
        Status::Argument
    );
    let mut buffer = vec![0xEE; 20 * count as usize];
    fn out(buffer: &mut [u8]) -> Output<'_> {
        Output::new(buffer, Format::F32x3).stride(20)
    }
    assert_eq!(
        status(shown.write_positions(0..count, out(&mut buffer[..20 * count as usize - 10]))),
        Status::BufferSize
    );
    shown.write_positions(0..count, out(&mut buffer)).unwrap();
    for (bytes, point) in buffer.chunks(20).zip(&whole) {
        assert_eq!(
            bytes[..12],
            point
                .iter()
                .flat_map(|x| x.to_ne_bytes())
                .collect::<Vec<u8>>()
        );
        assert!(bytes[12..].iter().all(|&byte| byte == 0xEE));
    }
    #[allow(clippy::reversed_empty_ranges)]
    let reversed = 5..2;
    assert_eq!(
        status(shown.write_positions(reversed, Output::points(&mut points))),
        Status::Argument
    );
}

#[test]
fn frames_are_written_without_a_context() {
    let clip = clip("limb_default.anic");
    let count = clip.mesh(0).unwrap().vertex_count as usize;
    let mut points = vec![vec![[0.0; 3]; count]; 4];
    let mut outputs: Vec<Output<'_>> = points
        .iter_mut()
        .map(|points| Output::points(points))
        .collect();
    clip.write_frames(0, &[3, 4, 5, 6], 0..count as u32, &mut outputs)
        .unwrap();
    assert_eq!(
        status(clip.write_frames(0, &[3], 0..count as u32, &mut outputs)),
        Status::Argument
    );
    let mut context = clip.context().unwrap();
    for (frame, points) in (3..).zip(&points) {
        context.seek_frame(frame).unwrap();
        assert_eq!(&context.positions().unwrap(), points);
    }
}

#[test]
fn faces_come_as_polygons_and_triangles() {
    let clip = clip("polygons_all.anic");
    let mesh = clip.mesh(0).unwrap();
    assert_eq!(mesh.polygons().len(), mesh.polygon_count as usize);
    let indices = mesh.indices().unwrap();
    let mut triangles = indices.chunks(3);
    for polygon in mesh.polygons().iter() {
        // Sides that are gone both ways lie inside the polygon; the others are its own.
        let sides = |of: &[u32]| {
            (0..of.len())
                .map(|i| (of[i], of[(i + 1) % of.len()]))
                .collect::<Vec<_>>()
        };
        let cut: Vec<_> = triangles
            .by_ref()
            .take(polygon.len() - 2)
            .flat_map(sides)
            .collect();
        let mut outer: Vec<_> = cut
            .iter()
            .copied()
            .filter(|&(from, to)| !cut.contains(&(to, from)))
            .collect();
        let mut expected = sides(polygon);
        outer.sort_unstable();
        expected.sort_unstable();
        assert_eq!(outer, expected);
    }
    assert_eq!(triangles.next(), None);
    let mut small = vec![0_u16; indices.len()];
    mesh.indices_into(&mut small).unwrap();
    assert!(small.iter().map(|&i| u32::from(i)).eq(indices));
    assert_eq!(
        status(mesh.indices_into(&mut small[1..])),
        Status::BufferSize
    );
    assert_eq!(mesh.coded_vertices().len(), mesh.vertex_count as usize);
}

#[test]
fn attributes_and_materials_are_told() {
    let clip = clip("painted_box.anic");
    let mesh = clip.mesh(0).unwrap();
    let kinds: Vec<AttributeKind> = mesh.attributes().map(|a| a.kind).collect();
    use AttributeKind::{Colour, Material, Normal, Part, Uv};
    assert_eq!(kinds, [Uv, Normal, Colour, Material, Part]);
    let materials = mesh.attribute(3).unwrap();
    assert!(materials.label_names().eq(["wood", "metal"]));
    let wood = materials.material(0).unwrap().unwrap();
    assert_eq!((wood.base_colour[0], wood.roughness), (0.5, 0.875));
    assert!(
        wood.base_colour_texture == "textures/wood grain.png" && wood.emissive_texture.is_empty()
    );
    assert!(materials.material(1).unwrap().is_none());
    assert_eq!(status(materials.material(2)), Status::Argument);
    assert_eq!(materials.label_name(2), None);
}

#[test]
fn render_vertices_carry_what_corners_do() {
    let clip = clip("painted_box.anic");
    let mesh = clip.mesh(0).unwrap();
    let plan = mesh
        .render_plan(&RenderOptions {
            source_edges: true,
            ..Default::default()
        })
        .unwrap();
    let mut context = clip.context().unwrap();
    context.seek_frame(1).unwrap();
    let whole = context.positions().unwrap();
    let count = plan.vertices().len();
    let mut positions = vec![[0.0; 3]; count];
    plan.positions_into(&context, When::Current, &mut positions)
        .unwrap();
    for (&vertex, position) in plan.vertices().iter().zip(&positions) {
        assert_eq!(whole[vertex as usize], *position);
    }
    let uv = mesh.attribute(0).unwrap();
    let values = plan.attribute(&context, When::Current, 0, 2).unwrap();
    for (&corner, value) in plan.corners().iter().zip(values.chunks(2)) {
        assert_eq!(uv.values[2 * corner as usize..][..2], *value);
    }
    let groups: Vec<_> = plan.groups().collect();
    assert_eq!(
        groups.last().unwrap().1.end as usize * 3,
        plan.indices().len()
    );
    assert_eq!(plan.triangle_polygons().len() * 3, plan.indices().len());
    let labels = mesh.attribute(3).unwrap().labels;
    for (material, triangles) in groups {
        for triangle in triangles {
            assert_eq!(
                labels[plan.triangle_polygons()[triangle as usize] as usize],
                material
            );
        }
    }
    let mut normals = vec![[0.0; 3]; count];
    plan.normals_into(&positions, &mut normals).unwrap();
    let groups = plan.normal_groups();
    for (vertex, normal) in normals.iter().enumerate() {
        let group = groups.groups[vertex] as usize;
        let centre = positions[groups.centres[group] as usize];
        let mut sum = [0.0_f64; 3];
        for corner in
            &groups.corners[groups.begin[group] as usize..groups.begin[group + 1] as usize]
        {
            let edge = |i: usize, c: usize| f64::from(positions[corner[i] as usize][c] - centre[c]);
            for (c, sum) in sum.iter_mut().enumerate() {
                let (a, b) = ((c + 1) % 3, (c + 2) % 3);
                *sum += edge(0, a) * edge(1, b) - edge(0, b) * edge(1, a);
            }
        }
        let length = sum.iter().map(|x| x * x).sum::<f64>().sqrt();
        for c in 0..3 {
            assert!(
                (f64::from(normal[c]) - sum[c] / length).abs() < 1e-5,
                "{vertex}: {normal:?} {sum:?}"
            );
        }
    }
    assert_eq!(
        status(plan.normals_into(&positions[1..], &mut normals)),
        Status::Argument
    );
}

#[test]
fn normals_are_of_vertices_or_corners() {
    let clip = clip("polygons_all.anic");
    let mesh = clip.mesh(0).unwrap();
    let mut context = clip.context().unwrap();
    context.seek_frame(0).unwrap();
    let points = context.positions().unwrap();
    for (per_corner, count) in [(false, mesh.vertex_count), (true, mesh.corner_count)] {
        let options = NormalOptions {
            crease_angle: 30.0,
            per_corner,
            ..Default::default()
        };
        let plan = mesh.normal_plan(&options).unwrap();
        assert_eq!(plan.len(), count as usize);
        let mut normals = vec![[0.0; 3]; plan.len()];
        plan.normals_into(&points, &mut normals).unwrap();
        assert!(normals
            .iter()
            .all(|n| (n.iter().map(|x| x * x).sum::<f32>() - 1.0).abs() < 1e-5));
        assert_eq!(
            status(plan.normals_into(&points[1..], &mut normals)),
            Status::Argument
        );
    }
    let late = NormalOptions {
        reference_frame: 1 << 20,
        ..Default::default()
    };
    assert_eq!(status(mesh.normal_plan(&late)), Status::FrameRange);
}

#[test]
fn attributes_come_in_other_formats() {
    let clip = clip("heated.anic");
    let mesh = clip.mesh(0).unwrap();
    let colours = mesh
        .attributes()
        .find(|a| a.kind == AttributeKind::Colour)
        .unwrap();
    let mut context = clip.context().unwrap();
    context.seek_frame(4).unwrap();
    let shown = context.shown(0, When::Current);
    let mut floats = vec![0.0; colours.values.len()];
    shown.attribute_into(colours.number, &mut floats).unwrap();
    let mut bytes = vec![0; 4 * colours.count as usize];
    let out = ValueOutput::new(&mut bytes, ValueFormat::Unorm8).components(4);
    shown
        .write_attribute(colours.number, 0..colours.count, out)
        .unwrap();
    let components = colours.components as usize;
    for (float, byte) in floats.chunks(components).zip(bytes.chunks(4)) {
        assert_eq!((255.0 * float[0].clamp(0.0, 1.0)).round() as u8, byte[0]);
    }
    assert_eq!(
        status(shown.attribute_into(colours.number, &mut floats[1..])),
        Status::BufferSize
    );
    assert_eq!(
        status(shown.attribute_into(77, &mut floats)),
        Status::Argument
    );
}

#[test]
fn the_motion_of_the_whole_is_apart() {
    let with = clip("walk.anic");
    let without = OpenOptions::new()
        .in_place(true)
        .open(bytes("walk.anic"))
        .unwrap();
    let (mut a, mut b) = (with.context().unwrap(), without.context().unwrap());
    let frame = with.clip(2).unwrap().first_frame + 3;
    a.seek_frame(frame).unwrap();
    b.seek_frame(frame).unwrap();
    let motion = a.root_motion(When::Current).unwrap();
    assert_eq!(
        motion,
        with.root_motion(2, 0.3, Sampling::Step, Wrap::Clamp)
            .unwrap()
    );
    let m = motion.matrix;
    for (moved, still) in a.positions().unwrap().iter().zip(b.positions().unwrap()) {
        for c in 0..3 {
            let x = m[4 * c] * still[0]
                + m[4 * c + 1] * still[1]
                + m[4 * c + 2] * still[2]
                + m[4 * c + 3];
            assert!((x - moved[c]).abs() < 1e-4, "{x} {}", moved[c]);
        }
    }
    let step = with
        .root_step(2, 0.1, 0.1, Sampling::Linear, Wrap::Loop)
        .unwrap();
    assert_eq!((step.turn, step.movement), (0.0, [0.0; 3]));
}

#[test]
fn boxes_are_exact_or_read_from_the_file() {
    let file = bytes("boxes_and_metadata.anic");
    let clip = OpenOptions::new().bounds(true).open(&file).unwrap();
    let whole = clip.bounds(0).unwrap().unwrap();
    let told = anicodec::read_bounds(&file, 0, 0..0).unwrap().unwrap();
    for c in 0..3 {
        assert!(told.min[c] <= whole.min[c] && told.max[c] >= whole.max[c]);
    }
    let mut context = clip.context().unwrap();
    context.seek_frame(1).unwrap();
    let now = context.shown(0, When::Current).bounds().unwrap();
    assert_eq!(clip.frame_bounds(0, 1).unwrap().unwrap(), now);
    let shown = context.shown(0, When::Current);
    let triangles = clip.mesh(0).unwrap().indices().unwrap();
    let positions = shown.positions().unwrap();
    let corners = [0, 1, 2].map(|i| triangles[i]);
    let point = SurfacePoint {
        vertices: corners,
        weights: [0.25, 0.25, 0.5],
    };
    let on = shown.surface_frame(&point).unwrap();
    for (c, &x) in on.position.iter().enumerate() {
        let expected: f32 = (0..3)
            .map(|i| point.weights[i] * positions[corners[i] as usize][c])
            .sum();
        assert!((x - expected).abs() < 1e-5);
    }
    let mut ray = Ray::new(
        [0, 1, 2].map(|c| on.position[c] + 0.001 * on.normal[c]),
        on.normal.map(|n| -n),
    );
    let mut work = vec![0.0; 3 * positions.len()];
    let hit = shown
        .intersect_ray(&ray, &triangles, &mut work)
        .unwrap()
        .unwrap();
    assert!((hit.distance - 0.001).abs() < 1e-5 && hit.triangle == 0 && hit.side == Side::Front);
    ray.farthest = 1e-4;
    assert!(shown
        .intersect_ray(&ray, &triangles, &mut work)
        .unwrap()
        .is_none());
    assert_eq!(
        status(shown.intersect_ray(&ray, &triangles, &mut work[1..])),
        Status::BufferSize
    );
    assert_eq!(status(Clip::open(&file).unwrap().bounds(0)), Status::State);
    assert_eq!(
        status(anicodec::read_bounds(&file, 9, 0..1)),
        Status::Argument
    );
    assert!(anicodec::read_metadata(&file)
        .unwrap()
        .unwrap()
        .starts_with('{'));
    assert_eq!(
        status(anicodec::read_metadata(&file[..40])),
        Status::Truncated
    );
}

#[test]
fn what_a_file_takes_is_known_from_its_head() {
    let file = bytes("limb_default.anic");
    let options = OpenOptions::new();
    let mut head = 0;
    loop {
        let wanted = options.head_bytes(&file[..head]).unwrap() as usize;
        if wanted <= head {
            break;
        }
        assert_eq!(
            status(options.requirements(&file[..head])),
            Status::Truncated
        );
        head = wanted;
    }
    let needs = options.requirements(&file[..head]).unwrap();
    let clip = Clip::open(&file).unwrap();
    assert_eq!(needs.file_bytes, file.len() as u64);
    assert_eq!(needs.frame_count, clip.info().frame_count);
    assert!(
        needs.context_bytes >= clip.info().context_bytes
            && needs.opening_bytes > needs.resident_bytes
    );
    let refused = OpenOptions::new().max_vertices(10).open(&file);
    assert!(
        matches!(
            refused,
            Err(Error::File {
                status: Status::Limit,
                ..
            })
        ),
        "{refused:?}"
    );
    assert_eq!(
        status(OpenOptions::new().max_bytes(1000).open(&file)),
        Status::Limit
    );
}

#[test]
fn openings_are_followed_and_stopped() {
    let file = bytes("limb_effort9.anic");
    let calls = Arc::new(AtomicUsize::new(0));
    let seen = calls.clone();
    let follow = OpenOptions::new().progress(move |done| {
        assert!((0.0..=1.0).contains(&done));
        seen.fetch_add(1, Ordering::Relaxed);
        ControlFlow::Continue(())
    });
    follow.open(&file).unwrap();
    assert!(calls.load(Ordering::Relaxed) > 0);
    let stop = OpenOptions::new().progress(|_| ControlFlow::Break(()));
    assert_eq!(status(stop.open(&file)), Status::Cancelled);
}

#[test]
fn clips_are_shared_with_others_open() {
    let clip = clip("clips.anic");
    let name = clip.clip(1).unwrap().name.to_string();
    let alone = clip.share(&OpenOptions::new().clips([name])).unwrap();
    assert!(alone.clip(1).unwrap().is_open && !alone.clip(0).unwrap().is_open);
    assert!(alone.info().resident_bytes < 4096);
    assert_eq!(status(alone.context().unwrap().set_clip(0)), Status::Absent);
    drop(clip);
    let mut context = alone.context().unwrap();
    context.seek(0.0, Sampling::Linear, Wrap::Loop).unwrap();
    assert_eq!(
        status(alone.share(&OpenOptions::new().clips(["swim"]))),
        Status::Absent
    );
}

#[test]
fn fewer_components_are_coarser() {
    let clip = clip("limb_effort9.anic");
    let mut context = clip.context().unwrap();
    context.seek_frame(3).unwrap();
    let full = context.positions().unwrap();
    context.set_quality(0.3).unwrap();
    context.seek_frame(3).unwrap();
    assert_ne!(context.positions().unwrap(), full);
    assert_eq!(status(context.set_quality(0.0)), Status::Argument);
    assert_eq!(
        status(
            OpenOptions::new()
                .quality(2.0)
                .open(bytes("limb_effort9.anic"))
        ),
        Status::Argument
    );
}

#[test]
fn a_basis_and_weights_make_the_positions() {
    let clip = clip("limb_effort9.anic");
    let mut context = clip.context().unwrap();
    context.seek_frame(7).unwrap();
    let shown = context.shown(0, When::Current);
    let parts = shown.parts().unwrap();
    let [part] = &parts[..] else {
        panic!("{parts:?}")
    };
    let basis = clip.basis(part.segment).unwrap();
    assert_eq!(
        (basis.reconstruction, basis.regions, part.share),
        (Reconstruction::Linear, 1, 1.0)
    );
    let narrow = basis.components - basis.wide_components;
    for (v, point) in (0..basis.vertex_count).zip(shown.positions().unwrap()) {
        let (b, i) = (v / 16, v % 16);
        let map = &part.pose_maps[0];
        let pose = |c: u32| f64::from(basis.pose[((b * 3 + c) * 16 + i) as usize]);
        let mut x = [0.0; 3];
        for c in 0..3 {
            x[c as usize] = f64::from(map[(4 * c + 3) as usize]);
            for k in 0..3 {
                x[c as usize] += f64::from(map[(4 * c + k) as usize]) * pose(k);
            }
            for j in 0..basis.components {
                let channel = if basis.channels == 3 { c } else { 0 };
                let at = |block: u32, j: u32| {
                    (((b * block + j) * basis.channels + channel) * 16 + i) as usize
                };
                let value = match j.checked_sub(basis.wide_components) {
                    None => f64::from(basis.wide[at(basis.wide_components, j)]),
                    Some(j) => f64::from(basis.narrow[at(narrow, j)]),
                };
                let weight = if basis.weight_channels == 3 { c } else { 0 };
                x[c as usize] +=
                    f64::from(part.weights[(j * basis.weight_channels + weight) as usize]) * value;
            }
        }
        for c in 0..3 {
            let m = &part.motion[4 * c..];
            let local = |k: usize| x[k] + f64::from(basis.origin[k]);
            let moved = (0..3).map(|k| f64::from(m[k]) * local(k)).sum::<f64>() + f64::from(m[3]);
            let fixed = part
                .corrections
                .iter()
                .find(|f| f.vertex == v)
                .map_or(0.0, |f| f64::from(f.delta[c]));
            assert!(
                (moved + fixed - f64::from(point[c])).abs() < 1e-4,
                "{v}: {moved} {point:?}"
            );
        }
    }
    let layout = clip.texture_layout(part.segment, 4096).unwrap();
    for texture in [Texture::Pose, Texture::Wide, Texture::Narrow] {
        let (_, height, size) = layout.size(texture);
        let mut texels = vec![0; size];
        clip.write_texture(part.segment, texture, &layout, 0, &mut texels)
            .unwrap();
        if height > 0 {
            let short = &mut texels[1..];
            assert_eq!(
                status(clip.write_texture(part.segment, texture, &layout, 0, short)),
                Status::BufferSize
            );
        }
    }
    assert_eq!(shown.state(0).unwrap().len(), layout.state_floats as usize);
    assert_eq!(status(shown.state(1)), Status::Argument);
    assert_eq!(status(clip.basis(99)), Status::Argument);
    let interpolated = self::clip("nonmanifold_interpolated.anic");
    let mut context = interpolated.context().unwrap();
    context.seek_frame(1).unwrap();
    let shape = context.shown(0, When::Current);
    assert!(shape.parts().unwrap()[0].weights.is_empty());
    assert_eq!(status(shape.state(0)), Status::State);
}

#[test]
fn a_live_stream_tells_of_a_file_that_was_lost() {
    let file = bytes("streams/goes_on.anic");
    let mut stream = Stream::new().unwrap();
    assert_eq!(status(stream.open()), Status::State);
    stream.push(&file).unwrap();
    let mut frames = 0;
    let mut refused = Vec::new();
    for number in 0.. {
        assert_eq!(stream.info().file_number, number);
        // The second file is lost: nobody opens it.
        if number != 1 {
            match stream.open() {
                Ok(clip) => frames += clip.info().frame_count,
                Err(error) => refused.push((number, error.status())),
            }
        }
        if stream.info().waiting_bytes == 0 {
            break;
        }
        stream.advance().unwrap();
    }
    assert_eq!(refused, [(2, Status::SegmentMissing)]);
    assert!(frames > 0 && stream.failure().is_none());
}

#[test]
fn a_stream_fails_for_good_and_names_the_place() {
    let mut file = bytes("limb_default.anic");
    let last = file.len() - 1;
    file[last] ^= 1;
    let mut stream = OpenOptions::new().bounds(true).stream().unwrap();
    stream.push(&file[..500]).unwrap();
    let failure = stream.push(&file[500..]).unwrap_err();
    assert!(
        matches!(
            failure,
            Error::File {
                status: Status::ChunkChecksum,
                chunk: Some(_),
                ..
            }
        ),
        "{failure:?}"
    );
    assert_eq!(stream.failure(), Some(failure.clone()));
    assert_eq!(status(stream.push(b"x")), Status::ChunkChecksum);
    assert!(failure.to_string().starts_with("byte "), "{failure}");
}

#[test]
fn an_absent_mesh_is_told_apart() {
    let clip = clip("scene.anic");
    let mut context = clip.context().unwrap();
    context.seek_frame(0).unwrap();
    assert_eq!(
        status(context.shown(1, When::Current).positions()),
        Status::Absent
    );
    assert!(context.shown(0, When::Current).positions().is_ok());
    assert_eq!(clip.meshes().count(), 2);
}
