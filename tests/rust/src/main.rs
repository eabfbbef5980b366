// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! Decodes a file or a live stream for tests/conformance/run.py by the crate anicodec: positions and faces of each mesh, and
//! all else that the crate tells as JSON; a stream as one clip. The exit status of a file that is refused is its code.
//!
//! usage: anicodec-tests FILE.anic OUT
use std::fmt::{Display, Write};
use std::fs;
use std::process::exit;

use anicodec::{
    Attribute, Bounds, Clip, Domain, Error, Mesh, NamedClip, Sampling, Status, Stream, Text,
    UpAxis, When, Wrap,
};

type Failure = Box<dyn std::error::Error>;
/// Points of each frame.
type Frames = Vec<Vec<[f32; 3]>>;

fn number(value: f64) -> String {
    if value.is_finite() {
        format!("{value:?}")
    } else {
        "null".into()
    }
}

/// Bytes that are not ASCII are written as the characters of the same number.
fn quoted(text: Text<'_>) -> String {
    let mut out = String::from("\"");
    for &byte in text.as_bytes() {
        match byte {
            b'"' | b'\\' | 0..0x20 | 0x7F.. => write!(out, "\\u{byte:04x}").unwrap(),
            _ => out.push(byte.into()),
        }
    }
    out + "\""
}

fn list<I: IntoIterator>(values: I, print: impl FnMut(I::Item) -> String) -> String {
    let printed: Vec<String> = values.into_iter().map(print).collect();
    format!("[{}]", printed.join(","))
}

fn numbers(values: &[f32]) -> String {
    list(values, |&x| number(x.into()))
}

/// `"key":value` lists between braces.
#[derive(Default)]
struct Object(Vec<String>);

impl Object {
    fn add(&mut self, key: &str, value: impl Display) -> &mut Self {
        self.0.push(format!("\"{key}\":{value}"));
        self
    }

    fn text(&self) -> String {
        format!("{{{}}}", self.0.join(",\n"))
    }
}

/// Points of a mesh in each frame; not-a-number throughout where it is not there.
fn frames_of(clip: &Clip, mesh: u32) -> Result<Frames, Failure> {
    let mut context = clip.context()?;
    let count = clip.mesh(mesh)?.vertex_count as usize;
    let mut frames = Vec::new();
    for frame in 0..clip.info().frame_count {
        context.seek_frame(frame)?;
        let mut points = vec![[0.0; 3]; count];
        match context
            .shown(mesh, When::Current)
            .positions_into(&mut points)
        {
            Err(error) if error.status() == Status::Absent => points.fill([f32::NAN; 3]),
            other => other?,
        }
        frames.push(points);
    }
    Ok(frames)
}

/// A PC2 vertex cache.
fn cache(frames: &Frames, vertices: u32) -> Vec<u8> {
    let mut out = b"POINTCACHE2\0".to_vec();
    out.extend(1_u32.to_le_bytes());
    out.extend(vertices.to_le_bytes());
    out.extend(0_f32.to_le_bytes());
    out.extend(1_f32.to_le_bytes());
    out.extend((frames.len() as u32).to_le_bytes());
    out.extend(
        frames
            .iter()
            .flatten()
            .flatten()
            .flat_map(|x| x.to_le_bytes()),
    );
    out
}

fn faces(mesh: &Mesh<'_>) -> String {
    let corners = |polygon: &[u32]| {
        polygon
            .iter()
            .map(|v| format!(" {}", v + 1))
            .collect::<String>()
    };
    mesh.polygons()
        .iter()
        .map(|polygon| format!("f{}\n", corners(polygon)))
        .collect()
}

fn looks(attribute: &Attribute<'_>) -> Result<String, Failure> {
    let mut looks = Vec::new();
    for label in 0..attribute.label_count {
        let Ok(Some(look)) = attribute.material(label) else {
            looks.push("null".into());
            continue;
        };
        let textures = [
            look.base_colour_texture,
            look.metallic_roughness_texture,
            look.normal_texture,
            look.occlusion_texture,
            look.emissive_texture,
        ];
        let mut out = Object::default();
        out.add("base_colour", numbers(&look.base_colour))
            .add("metallic", number(look.metallic.into()));
        out.add("roughness", number(look.roughness.into()))
            .add("emissive", numbers(&look.emissive));
        out.add("alpha", look.alpha as u32)
            .add("alpha_cutoff", number(look.alpha_cutoff.into()));
        out.add("double_sided", look.double_sided)
            .add("textures", list(textures, quoted));
        looks.push(out.text());
    }
    let known = looks.iter().any(|look| look != "null");
    Ok(list(looks.into_iter().filter(|_| known), |look| look))
}

fn attribute(clip: &Clip, mesh: &Mesh<'_>, of: &Attribute<'_>) -> Result<String, Failure> {
    let mut context = clip.context()?;
    let mut values = vec![of.values.to_vec()];
    for frame in 0..if of.moves { clip.info().frame_count } else { 0 } {
        context.seek_frame(frame)?;
        let mut shown = vec![0.0; of.values.len()];
        match context
            .shown(mesh.number, When::Current)
            .attribute_into(of.number, &mut shown)
        {
            Err(error) if error.status() == Status::Absent => shown.clear(),
            other => other?,
        }
        if frame == 0 {
            values.clear();
        }
        values.push(shown);
    }
    let elements = match of.domain {
        Domain::Vertices => mesh.vertex_count,
        Domain::Corners => mesh.corner_count,
        Domain::Polygons => mesh.polygon_count,
    };
    assert_eq!(of.count, elements);
    let mut out = Object::default();
    out.add("kind", of.kind as u32)
        .add("domain", of.domain as u32)
        .add("name", quoted(of.name));
    out.add("components", of.components)
        .add("labels", list(of.label_names(), quoted))
        .add("moves", of.moves);
    out.add("groups", list(of.labels, |label| label.to_string()))
        .add("looks", looks(of)?);
    out.add("values", list(&values, |frame| numbers(frame)));
    Ok(out.text())
}

fn mesh_facts(
    clip: &Clip,
    mesh: &Mesh<'_>,
    frames: &Frames,
    boxes: &[Option<Bounds>],
) -> Result<String, Failure> {
    let (mut low, mut high) = ([f32::MAX; 3], [-f32::MAX; 3]);
    for point in frames.iter().flatten() {
        for c in 0..3 {
            low[c] = low[c].min(point[c]);
            high[c] = high[c].max(point[c]);
        }
    }
    let attributes = mesh
        .attributes()
        .map(|of| attribute(clip, mesh, &of))
        .collect::<Result<Vec<_>, _>>()?;
    let mut out = Object::default();
    out.add("name", quoted(mesh.name))
        .add("low", numbers(&low))
        .add("high", numbers(&high));
    out.add("attributes", list(attributes, |text| text));
    if boxes.iter().any(Option::is_some) {
        let sides = |b: &Bounds| numbers(&[b.min, b.max].concat());
        out.add(
            "boxes",
            list(boxes, |found| found.as_ref().map_or("null".into(), sides)),
        );
    }
    Ok(out.text())
}

fn clip_facts(clip: &Clip, of: &NamedClip<'_>) -> Result<String, Failure> {
    let rate = |frame: u32| f64::from(frame) / of.rate.per_second();
    let time = |frame: u32| {
        if of.uneven {
            clip.frame_time(of.first_frame + frame)
        } else {
            rate(frame)
        }
    };
    let mut out = Object::default();
    out.add("name", quoted(of.name))
        .add("frames", of.frame_count);
    out.add(
        "rate",
        format!("[{},{}]", of.rate.numerator, of.rate.denominator),
    );
    out.add("rate_assumed", of.rate_assumed)
        .add("loop", of.is_loop)
        .add("closed", of.closed);
    out.add("massaged", of.massaged)
        .add("start_time", number(of.start_time));
    out.add(
        "times",
        list(0..of.frame_count, |frame| number(time(frame))),
    );
    for (key, value) in [
        ("max_error", of.max_error),
        ("rmse", of.rmse),
        ("kg", of.kg),
        ("max_displacement_error", of.max_displacement_error),
        ("diagonal", of.diagonal),
        ("surface_error", of.surface_error),
        ("surface_error_mean", of.surface_error_mean),
    ] {
        out.add(key, number(value));
    }
    if clip.events(of.number).len() > 0 {
        let event = |e: anicodec::Event<'_>| format!("[{},{}]", quoted(e.name), number(e.seconds));
        out.add("events", list(clip.events(of.number), event));
    }
    let root = |frame| clip.root_motion(of.number, time(frame), Sampling::Step, Wrap::Clamp);
    let first = root(0)?;
    if first.moves || first.turns {
        // The axes of the ground: a turn leads from the first to the second.
        let (a, b) = if clip.info().up == UpAxis::Y {
            (2, 0)
        } else {
            (0, 1)
        };
        let states = (0..of.frame_count)
            .map(root)
            .collect::<Result<Vec<_>, _>>()?;
        out.add(
            "root",
            list(states, |s| {
                list(
                    [s.turn, s.movement[a], s.movement[b], s.pivot[a], s.pivot[b]],
                    number,
                )
            }),
        );
    }
    Ok(out.text())
}

/// The promise of the files of a stream as one clip (spec/05-file-layout.md, section 8).
fn joined<'a>(files: &'a [OpenFile]) -> Result<NamedClip<'a>, Failure> {
    let mut all = files[0].clip.clip(0)?;
    let (mut squares, mut scaled, mut before) = (0.0, 0.0, 0.0);
    all.frame_count = 0;
    for file in files {
        let of = file.clip.clip(0)?;
        let frames = f64::from(of.frame_count);
        squares += frames * of.rmse * of.rmse;
        scaled += if of.kg > 0.0 {
            frames * (100.0 * of.rmse / of.kg).powi(2)
        } else {
            0.0
        };
        let seam = if all.frame_count > 0 {
            before + of.max_error
        } else {
            0.0
        };
        all.max_displacement_error = all
            .max_displacement_error
            .max(of.max_displacement_error)
            .max(seam);
        all.frame_count += of.frame_count;
        all.max_error = all.max_error.max(of.max_error);
        all.diagonal = all.diagonal.max(of.diagonal);
        all.surface_error = all.surface_error.max(of.surface_error);
        before = of.max_error;
    }
    all.rmse = (squares / f64::from(all.frame_count)).sqrt();
    all.kg = if scaled > 0.0 {
        100.0 * (squares / scaled).sqrt()
    } else {
        0.0
    };
    Ok(all)
}

/// A file that is open, and what it says without being decoded.
struct OpenFile {
    clip: Clip,
    metadata: Option<String>,
    /// The box of each mesh and frame.
    boxes: Vec<Vec<Option<Bounds>>>,
}

/// A file, or the files of a live stream.
fn open(bytes: &[u8]) -> Result<Vec<OpenFile>, Error> {
    let clip = match Clip::open(bytes) {
        Err(error) if error.status() == Status::TrailingBytes => return open_stream(bytes),
        other => other?,
    };
    clip.verify()?;
    let metadata = anicodec::read_metadata(bytes)?.map(str::to_owned);
    let mut boxes = Vec::new();
    for mesh in clip.meshes() {
        let frames = 0..clip.info().frame_count;
        let of_frame = |frame| anicodec::read_bounds(bytes, mesh.number, frame..frame + 1);
        boxes.push(frames.map(of_frame).collect::<Result<_, _>>()?);
    }
    Ok(vec![OpenFile {
        clip,
        metadata,
        boxes,
    }])
}

fn open_stream(bytes: &[u8]) -> Result<Vec<OpenFile>, Error> {
    let mut stream = Stream::new()?;
    for piece in bytes.chunks(1000) {
        stream.push(piece)?;
    }
    let mut files = Vec::new();
    loop {
        if !stream.info().complete {
            exit(Status::Truncated.code()); // the last file
        }
        let clip = stream.open()?;
        clip.verify()?;
        files.push(OpenFile {
            clip,
            metadata: None,
            boxes: Vec::new(),
        });
        if stream.info().waiting_bytes == 0 {
            return Ok(files);
        }
        stream.advance()?;
    }
}

fn write_all(files: &[OpenFile], out: &str) -> Result<(), Failure> {
    let clip = &files[0].clip;
    let mut meshes = Vec::new();
    for mesh in clip.meshes() {
        let mut frames = Frames::new();
        for file in files {
            frames.extend(frames_of(&file.clip, mesh.number)?);
        }
        let stem = if mesh.number == 0 {
            out.to_owned()
        } else {
            format!("{out}.{}", mesh.number)
        };
        fs::write(format!("{stem}.pc2"), cache(&frames, mesh.vertex_count))?;
        fs::write(format!("{stem}.obj"), faces(&mesh))?;
        let boxes = files[0]
            .boxes
            .get(mesh.number as usize)
            .map_or(&[][..], Vec::as_slice);
        meshes.push(mesh_facts(clip, &mesh, &frames, boxes)?);
    }
    let (info, mut told) = (clip.info(), Object::default());
    told.add("encoder", quoted(info.encoder))
        .add("up", info.up as u32)
        .add("order", info.order as u32);
    told.add("metres_per_unit", number(info.metres_per_unit));
    if info.origin != [0.0; 3] {
        told.add("origin", list(info.origin, number));
    }
    if let Some(metadata) = &files[0].metadata {
        told.add("metadata", metadata);
    }
    let mut clips = Vec::new();
    for of in clip.clips() {
        clips.push(clip_facts(
            clip,
            &if files.len() > 1 { joined(files)? } else { of },
        )?);
    }
    told.add("clips", list(clips, |text| text))
        .add("meshes", list(meshes, |text| text));
    fs::write(format!("{out}.json"), told.text())?;
    Ok(())
}

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, file, out] = &arguments[..] else {
        return Err("usage: anicodec-tests FILE.anic OUT".into());
    };
    let files = open(&fs::read(file)?).unwrap_or_else(|error| {
        eprintln!("{error}");
        exit(error.status().code())
    });
    write_all(&files, out)
}
