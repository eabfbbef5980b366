// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! Any bytes as a file and as a stream, played by every function. `cargo +nightly fuzz run -s none play` in bindings/rust, with
//! the conformance files as a corpus. It follows the paths of Rust; tests/fuzz has targets that follow those of the decoder.
#![no_main]

use anicodec::{
    read_bounds, read_metadata, Clip, NormalOptions, OpenOptions, RenderOptions, Result, Sampling, Texture, When, Wrap,
};
use libfuzzer_sys::fuzz_target;

fn options() -> OpenOptions {
    OpenOptions::new().max_vertices(2000).max_frames(200).max_bytes(64 << 20)
}

fn look(clip: &Clip) -> Result<()> {
    let info = clip.info();
    for found in clip.clips() {
        let _ = (clip.find_clip(found.name.as_bytes()), clip.events(found.number).count());
        let _ = clip.root_step(found.number, 0.3, 7.5, Sampling::Linear, Wrap::Loop);
    }
    let mut context = clip.context()?;
    let last = clip.clips().len() as u32 - 1;
    for mesh in clip.meshes() {
        assert!(mesh.indices()?.iter().chain(mesh.polygons().corners).all(|&v| v < mesh.vertex_count));
        assert!(mesh.coded_vertices().iter().all(|&v| v < mesh.coded_vertex_count));
        for frame in [0, info.frame_count / 2, info.frame_count - 1] {
            context.seek_frame(frame)?;
            let _ = context.blend(last, 0.1, Sampling::Cubic, Wrap::PingPong, 0.5);
            let shown = context.shown(mesh.number, When::Current);
            let Ok(points) = shown.positions() else { continue };
            let _ = (shown.bounds(), shown.parts(), shown.state(0), context.root_motion(When::Previous));
            for attribute in mesh.attributes() {
                assert_eq!(attribute.values.len(), attribute.count as usize * attribute.components as usize);
                let mut values = vec![0.0; attribute.values.len()];
                let _ = shown.attribute_into(attribute.number, &mut values);
                let _ = (
                    attribute.label_names().count(),
                    attribute.material(0),
                    shown.attribute_parts(attribute.number, 0),
                );
            }
            if let Ok(plan) = mesh.normal_plan(&NormalOptions { crease_angle: 30.0, ..Default::default() }) {
                plan.normals_into(&points, &mut vec![[0.0; 3]; plan.len()])?;
            }
            if let Ok(plan) = mesh.render_plan(&RenderOptions::default()) {
                let mut points = vec![[0.0; 3]; plan.vertices().len()];
                plan.positions_into(&context, When::Current, &mut points)?;
                let _ = (plan.groups().count(), plan.normal_groups());
            }
        }
    }
    for segment in 0..info.segment_count {
        let Ok(layout) = clip.texture_layout(segment, 1024) else { continue };
        for texture in [Texture::Pose, Texture::Wide, Texture::Narrow] {
            clip.write_texture(segment, texture, &layout, 0, &mut vec![0; layout.size(texture).2])?;
        }
    }
    Ok(())
}

fuzz_target!(|bytes: &[u8]| {
    let _ = (read_metadata(bytes), read_bounds(bytes, 0, 0..0), options().requirements(bytes));
    if let Ok(clip) = options().open(bytes) {
        look(&clip).expect("a clip that opened plays");
    }
    let Ok(mut stream) = options().stream() else { return };
    for piece in bytes.chunks(bytes.len() / 3 + 1) {
        if stream.push(piece).is_err() {
            return;
        }
        while stream.info().playable {
            if let Ok(clip) = stream.open() {
                let _ = look(&clip); // a live stream may show parts of its meshes alone
            }
            if !stream.info().complete || stream.advance().is_err() {
                break;
            }
        }
    }
});
