// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! The encoder: what goes in comes out within the promise, and what makes no sense is refused with a line.
#![cfg(feature = "encoder")]

use std::ops::ControlFlow;

use anicodec::encode::{
    AttributeBound, Effort, EncodeOptions, Encoder, Goal, LiveOptions, Look, SourceAttribute,
    SourceClip, SourceMesh,
};
use anicodec::{read_metadata, AttributeKind, Clip, Domain, Error, Order, Rate, Status, UpAxis};

const SIDE: usize = 8;
const FRAMES: usize = 20;

/// A waving square of SIDE x SIDE vertices.
fn positions() -> Vec<[f32; 3]> {
    let point = |f: usize, x: usize, y: usize| {
        [x as f32, y as f32, (0.7 * x as f32 + 0.3 * f as f32).sin()]
    };
    let places = |f| (0..SIDE * SIDE).map(move |v| point(f, v % SIDE, v / SIDE));
    (0..FRAMES).flat_map(places).collect()
}

/// Quads.
fn faces() -> (Vec<u32>, Vec<u32>) {
    let side = SIDE as u32;
    let quads = (0..side - 1).flat_map(|y| (0..side - 1).map(move |x| y * side + x));
    let corners: Vec<u32> = quads
        .flat_map(|v| [v, v + 1, v + 1 + side, v + side])
        .collect();
    (
        (0..=corners.len() as u32 / 4)
            .map(|polygon| 4 * polygon)
            .collect(),
        corners,
    )
}

fn clip() -> SourceClip<'static> {
    SourceClip {
        name: "flag",
        frame_count: FRAMES as u32,
        rate: Some(Rate {
            numerator: 30,
            denominator: 1,
        }),
        up: UpAxis::Z,
        is_loop: true,
        events: &[("gust", 0.1)],
        ..Default::default()
    }
}

fn status<T>(result: Result<T, Error>) -> Status {
    result.err().expect("an error").status()
}

#[test]
fn a_clip_comes_back_within_its_promise() {
    let ((offsets, corners), positions) = (faces(), positions());
    let polygons = offsets.len() - 1;
    let mesh = SourceMesh {
        name: "cloth",
        vertex_count: (SIDE * SIDE) as u32,
        offsets: &offsets,
        corners: &corners,
        ..Default::default()
    };
    let heat: Vec<f32> = (0..FRAMES * SIDE * SIDE)
        .map(|i| (i % 97) as f32 / 97.0)
        .collect();
    let labels: Vec<u32> = (0..polygons as u32).map(|polygon| polygon % 3).collect();
    let red = Look {
        base_colour: [1.0, 0.0, 0.0, 1.0],
        base_colour_texture: "red.png",
        ..Default::default()
    };
    let mut encoder = Encoder::new(&clip()).unwrap();
    assert_eq!(encoder.add_mesh(&mesh, &positions), Ok(0));
    let temperature = SourceAttribute {
        name: "heat",
        components: 1,
        values: &heat,
        bound: AttributeBound::Percent(0.2),
        unit: "K",
        ..Default::default()
    };
    encoder.add_attribute(0, &temperature).unwrap();
    let materials = SourceAttribute {
        kind: AttributeKind::Material,
        domain: Domain::Polygons,
        labels: &labels,
        label_names: &["red", "plain"],
        looks: &[Some(red), None],
        ..Default::default()
    };
    encoder.add_attribute(0, &materials).unwrap();
    let mut stages = Vec::new();
    let options = EncodeOptions {
        goal: Goal::MaxError(0.002),
        order: Order::All,
        metadata: "{\"by\":\"test\"}",
        ..Default::default()
    };
    let encoded = encoder
        .encode_with(&options, |stage, done| {
            assert!((0.0..=1.0).contains(&done));
            stages.push(stage.to_owned());
            ControlFlow::Continue(())
        })
        .unwrap();
    assert!(
        !stages.is_empty()
            && encoded.max_error <= 0.002
            && encoded.file.len() < 12 * positions.len() / 4
    );
    assert_eq!(
        read_metadata(&encoded.file).unwrap(),
        Some("{\"by\":\"test\",\"fields\":{\"heat\":{\"unit\":\"K\"}}}")
    );

    let opened = Clip::open(&encoded.file).unwrap();
    let found = opened.clip(0).unwrap();
    assert!(found.name == "flag" && found.is_loop && found.rate.per_second() == 30.0);
    assert_eq!(
        opened
            .events(0)
            .map(|e| e.name.to_string())
            .collect::<Vec<_>>(),
        ["gust"]
    );
    assert_eq!(opened.info().up, UpAxis::Z);
    let mesh = opened.mesh(0).unwrap();
    assert!(mesh.name == "cloth" && mesh.polygons().corners == corners);
    let look = mesh
        .attributes()
        .find(|a| a.kind == AttributeKind::Material)
        .unwrap();
    assert_eq!(look.labels, labels);
    assert!(
        look.material(0).unwrap().unwrap().base_colour_texture == "red.png"
            && look.material(1).unwrap().is_none()
    );
    let mut context = opened.context().unwrap();
    for frame in 0..FRAMES {
        context.seek_frame(frame as u32).unwrap();
        for (a, b) in context
            .positions()
            .unwrap()
            .iter()
            .zip(&positions[frame * SIDE * SIDE..])
        {
            let squares: f32 = (0..3).map(|c| (a[c] - b[c]).powi(2)).sum();
            assert!(squares.sqrt() <= 0.0021);
        }
    }
    assert_eq!(encoder.encode(&options).unwrap().file, encoded.file);
    let lossless = encoder
        .encode(&EncodeOptions {
            lossless: true,
            ..Default::default()
        })
        .unwrap();
    let mut context = Clip::open(&lossless.file).unwrap().context().unwrap();
    context.seek_frame(3).unwrap();
    assert_eq!(
        context.positions().unwrap(),
        positions[3 * SIDE * SIDE..4 * SIDE * SIDE]
    );
}

#[test]
fn several_clips_lie_in_one_file() {
    let ((offsets, corners), positions) = (faces(), positions());
    let part = |name, frame_count| SourceClip {
        name,
        frame_count,
        ..Default::default()
    };
    let mut encoder = Encoder::new(&part("calm", 5)).unwrap();
    encoder.add_clip(&part("storm", FRAMES as u32 - 5)).unwrap();
    let vertex_count = (SIDE * SIDE) as u32;
    let mesh = SourceMesh {
        vertex_count,
        offsets: &offsets,
        corners: &corners,
        ..Default::default()
    };
    encoder.add_mesh(&mesh, &positions).unwrap();
    let file = encoder.encode(&EncodeOptions::default()).unwrap().file;
    let names: Vec<_> = Clip::open(file)
        .unwrap()
        .clips()
        .map(|c| (c.name.to_string(), c.frame_count))
        .collect();
    assert_eq!(
        names,
        [("calm".into(), 5), ("storm".into(), FRAMES as u32 - 5)]
    );
    assert_eq!(status(encoder.add_clip(&part("late", 1))), Status::State);
}

#[test]
fn nonsense_is_refused_with_a_line() {
    let ((offsets, corners), positions) = (faces(), positions());
    let vertex_count = (SIDE * SIDE) as u32;
    let good = SourceMesh {
        vertex_count,
        offsets: &offsets,
        corners: &corners,
        ..Default::default()
    };
    let mut encoder = Encoder::new(&clip()).unwrap();
    assert_eq!(
        status(encoder.encode(&EncodeOptions::default())),
        Status::State
    );
    let falling = [0, 8, 4, corners.len() as u32];
    for bad in [
        SourceMesh {
            offsets: &[],
            corners: &corners[2..],
            ..good.clone()
        },
        SourceMesh {
            offsets: &offsets[1..],
            ..good.clone()
        },
        SourceMesh {
            offsets: &falling,
            ..good.clone()
        },
        SourceMesh {
            runs: &[0..3, 5..6],
            ..good.clone()
        },
        SourceMesh {
            name: "a\0b",
            ..good.clone()
        },
    ] {
        let error = encoder.add_mesh(&bad, &positions).unwrap_err();
        assert_eq!(error.status(), Status::Argument);
        assert!(error.to_string().len() > 10, "{error}");
    }
    let far = vec![1000; corners.len()];
    assert_eq!(
        status(encoder.add_mesh(
            &SourceMesh {
                corners: &far,
                ..good.clone()
            },
            &positions
        )),
        Status::IndexRange
    );
    assert_eq!(
        status(encoder.add_mesh(&good, &positions[1..])),
        Status::Argument
    );
    encoder.add_mesh(&good, &positions).unwrap();
    let short = SourceAttribute {
        components: 2,
        values: &[0.0; 7],
        ..Default::default()
    };
    assert_eq!(status(encoder.add_attribute(0, &short)), Status::Argument);
    assert_eq!(status(encoder.add_attribute(1, &short)), Status::Argument);
    let stop = encoder.encode_with(&EncodeOptions::default(), |_, _| ControlFlow::Break(()));
    assert_eq!(status(stop), Status::Cancelled);
    let error = encoder
        .encode(&EncodeOptions {
            uv_bits: 77,
            ..Default::default()
        })
        .unwrap_err();
    assert!(
        error.status() == Status::Argument && error.to_string().contains("UV"),
        "{error}"
    );
    assert!(Encoder::new(&SourceClip {
        times: &[0.0],
        ..clip()
    })
    .is_err());
}

#[test]
fn a_capture_is_encoded_while_it_goes_on() {
    let ((offsets, corners), positions) = (faces(), positions());
    let vertex_count = SIDE * SIDE;
    let live_clip = SourceClip {
        frame_count: 0,
        is_loop: false,
        events: &[],
        ..clip()
    };
    let mesh = SourceMesh {
        vertex_count: vertex_count as u32,
        offsets: &offsets,
        corners: &corners,
        ..Default::default()
    };
    let mut encoder = Encoder::new(&live_clip).unwrap();
    encoder.add_mesh(&mesh, &[]).unwrap();
    encoder
        .add_attribute(
            0,
            &SourceAttribute {
                name: "heat",
                components: 1,
                ..Default::default()
            },
        )
        .unwrap();
    let options = EncodeOptions {
        goal: Goal::MaxError(0.01),
        effort: Effort::Fast,
        ..Default::default()
    };
    let cut = LiveOptions {
        piece_seconds: 0.25,
        key_seconds: -1.0,
        ..Default::default()
    };
    let mut live = encoder.live(&options, &cut).unwrap();
    drop(encoder);
    let heat = vec![0.5; vertex_count];
    assert_eq!(
        status(live.push(&positions[..5], &[&heat], 0.0)),
        Status::Argument
    );
    assert_eq!(
        status(live.push(&positions[..vertex_count], &[], 0.0)),
        Status::Argument
    );
    let mut live = std::thread::spawn(move || {
        for frame in positions.chunks(vertex_count) {
            live.push(frame, &[&heat], f64::INFINITY).unwrap();
        }
        live.end().unwrap();
        live
    })
    .join()
    .unwrap();
    let mut frames = 0;
    while let Some(piece) = live.take(f64::INFINITY).unwrap() {
        assert!(piece.key && piece.max_error <= 0.01 && piece.first_frame == frames);
        frames += u64::from(piece.frame_count);
    }
    assert_eq!(frames, FRAMES as u64);
    assert!(live.info().ended && live.info().pushed_frames == frames);
    assert_eq!(
        status(Encoder::new(&clip()).unwrap().live(&options, &cut)),
        Status::State
    );
}
