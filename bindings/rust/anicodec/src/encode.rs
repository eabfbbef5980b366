// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! Encoding, by an installed `libanicodec_encoder`. `encode.h` describes every field.
//!
//! ```
//! use anicodec::encode::{EncodeOptions, Encoder, Goal, SourceClip, SourceMesh};
//!
//! let corners = [0, 1, 2, 0, 2, 3];
//! let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
//! let frames = 24;
//! let waves = |frame: usize| square.map(|[x, y, _]| [x, y, (x + frame as f32 / 4.0).sin()]);
//! let positions: Vec<_> = (0..frames).flat_map(waves).collect();
//!
//! let mut encoder = Encoder::new(&SourceClip { name: "flag", frame_count: frames as u32, ..Default::default() })?;
//! let flag = SourceMesh { vertex_count: 4, corners: &corners, ..Default::default() };
//! encoder.add_mesh(&flag, &positions)?;
//! let encoded = encoder.encode(&EncodeOptions { goal: Goal::MaxError(0.01), ..Default::default() })?;
//! assert!(encoded.max_error <= 0.01);
//! assert_eq!(anicodec::Clip::open(&encoded.file)?.info().frame_count, 24);
//! # Ok::<(), anicodec::Error>(())
//! ```
use alloc::boxed::Box;
use alloc::ffi::CString;
use alloc::vec::Vec;
use core::ffi::{c_char, c_int, c_void, CStr};
use core::fmt;
use core::marker::PhantomData;
use core::ops::{ControlFlow, Range};
use core::ptr::{self, NonNull};

use anicodec_sys as sys;

use crate::error::{Error, Result, Status};
use crate::raw::{english, enumeration, init, slice, text};
use crate::{AlphaMode, AttributeKind, BasisKind, Domain, Order, Rate, UpAxis};

/// A clip to be encoded: what all meshes share.
#[derive(Clone, Copy, Debug, Default)]
pub struct SourceClip<'a> {
    /// May be empty.
    pub name: &'a str,
    /// How many frames there are; 0: a live clip, whose frames are pushed: [`Encoder::live`].
    pub frame_count: u32,
    /// Frames per second; none: nobody knows, and 24 is stored, and that it is assumed.
    pub rate: Option<Rate>,
    /// The axis that points up.
    pub up: UpAxis,
    /// Meant to be repeated.
    pub is_loop: bool,
    /// The time of frame 0 on the clock of the source, seconds.
    pub start_time: f64,
    /// 0: unknown.
    pub metres_per_unit: f64,
    /// Ascending seconds from frame 0, one for each frame; empty: evenly by the rate.
    pub times: &'a [f64],
    /// Named times, from frame 0 on.
    pub events: &'a [(&'a str, f64)],
    /// The place that positions count from.
    pub origin: [f64; 3],
    /// Looks for an origin where meshes are small and far from zero.
    pub find_origin: bool,
}

/// A mesh: polygons over vertices.
#[derive(Clone, Debug, Default)]
pub struct SourceMesh<'a> {
    /// Names tell several meshes apart.
    pub name: &'a str,
    /// How many vertices there are.
    pub vertex_count: u32,
    /// Polygon p has the corners `offsets[p]..offsets[p + 1]`; empty: all are triangles.
    pub offsets: &'a [u32],
    /// Vertex of each corner.
    pub corners: &'a [u32],
    /// Frames that show the mesh, ascending; empty: all. Positions and attributes that change have these alone.
    pub runs: &'a [Range<u32>],
}

/// Values beside the positions, or names of polygons.
#[derive(Clone, Copy, Debug, Default)]
pub struct SourceAttribute<'a> {
    /// May be empty.
    pub name: &'a str,
    /// The meaning.
    pub kind: AttributeKind,
    /// The elements that have a value each.
    pub domain: Domain,
    /// Numbers of an element; 0: it has `labels`.
    pub components: u32,
    /// The values of all elements in frame 0, or in each frame of the mesh; empty in a live clip: it moves, and each frame has its own.
    pub values: &'a [f32],
    /// One for each element: 0 for none, or one more than the number of a name; of normals those that share one.
    pub labels: &'a [u32],
    /// Names of labels.
    pub label_names: &'a [&'a str],
    /// Looks of materials, none where one is unknown; empty: all are.
    pub looks: &'a [Option<Look<'a>>],
    /// The largest error of its numbers.
    pub bound: AttributeBound,
    /// The values' unit, as "K", kept in the metadata; may be empty.
    pub unit: &'a str,
}

/// The largest error of the numbers of an attribute.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum AttributeBound {
    /// As [`EncodeOptions`] say.
    #[default]
    Usual,
    /// In units of the values.
    Units(f64),
    /// In per cent of the range: of the component with the largest, over all frames.
    Percent(f64),
    /// None once values are rounded: they are whole, up to 2^24, up to 2^18 where they move. The metadata say so.
    Exact,
}

impl AttributeBound {
    fn raw(self) -> (sys::anic_bound, f64) {
        match self {
            Self::Usual => (sys::ANIC_BOUND_USUAL, 0.0),
            Self::Units(error) => (sys::ANIC_BOUND_UNITS, error),
            Self::Percent(error) => (sys::ANIC_BOUND_PERCENT, error),
            Self::Exact => (sys::ANIC_BOUND_EXACT, 0.0),
        }
    }
}

/// The look of a material: [`Material`](crate::Material) without its name.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "Material describes them")]
pub struct Look<'a> {
    pub base_colour: [f32; 4],
    pub metallic: f32,
    pub roughness: f32,
    pub emissive: [f32; 3],
    pub alpha: AlphaMode,
    pub alpha_cutoff: f32,
    pub double_sided: bool,
    pub base_colour_texture: &'a str,
    pub metallic_roughness_texture: &'a str,
    pub normal_texture: &'a str,
    pub occlusion_texture: &'a str,
    pub emissive_texture: &'a str,
}

impl Default for Look<'_> {
    /// White, as glTF has it.
    fn default() -> Self {
        Self {
            base_colour: [1.0; 4],
            metallic: 1.0,
            roughness: 1.0,
            emissive: [0.0; 3],
            alpha: AlphaMode::Opaque,
            alpha_cutoff: 0.5,
            double_sided: false,
            base_colour_texture: "",
            metallic_roughness_texture: "",
            normal_texture: "",
            occlusion_texture: "",
            emissive_texture: "",
        }
    }
}

/// The promise that the file keeps. Lengths are in units of the clip, or with [`EncodeOptions::percent`] in per cent of the
/// diagonal of the box around all frames.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Goal {
    /// A largest error of 0.05 %, or with `keyframes` none.
    #[default]
    Default,
    /// Largest distance of any vertex of any frame from its place.
    MaxError(f64),
    /// KG error in per cent.
    Kg(f64),
    /// Root of the mean squared error.
    Rmse(f64),
    /// Bytes, with the smallest error; of one mesh alone.
    Size(f64),
    /// Bits per frame and vertex, with the smallest error.
    Bpfv(f64),
    /// Largest error of any vertex's move from frame to frame.
    Displacement(f64),
    /// STED, an error as viewers see it.
    Sted(f64),
}

impl Goal {
    fn raw(self) -> (i32, f64) {
        match self {
            Self::Default => (sys::ANIC_GOAL_DEFAULT, 0.0),
            Self::MaxError(value) => (sys::ANIC_GOAL_MAX_ERROR, value),
            Self::Kg(value) => (sys::ANIC_GOAL_KG, value),
            Self::Rmse(value) => (sys::ANIC_GOAL_RMSE, value),
            Self::Size(value) => (sys::ANIC_GOAL_SIZE, value),
            Self::Bpfv(value) => (sys::ANIC_GOAL_BPFV, value),
            Self::Displacement(value) => (sys::ANIC_GOAL_DISPLACEMENT, value),
            Self::Sted(value) => (sys::ANIC_GOAL_STED, value),
        }
    }
}

enumeration! {
    /// Kind of basis.
    BasisChoice: Smallest {
        /// The one that makes the smallest file.
        Smallest = ANIC_CHOOSE_SMALLEST,
        /// Frames of the clip.
        Keyframes = ANIC_CHOOSE_KEYFRAMES,
        /// Shapes.
        Eigenshapes = ANIC_CHOOSE_EIGENSHAPES,
        /// Trajectories.
        Eigentrajectories = ANIC_CHOOSE_EIGENTRAJECTORIES,
    }
}

enumeration! {
    /// How key-frames are chosen.
    Selection: Pivot {
        /// The frame that is furthest off, again and again.
        Pivot = ANIC_SELECT_PIVOT,
        /// By a greedy search.
        Gas = ANIC_SELECT_GAS,
        /// Evenly.
        Uniform = ANIC_SELECT_UNIFORM,
    }
}

enumeration! {
    /// How frames come from key-frames.
    Interpolation: Usual {
        /// Linear between key-frames that were asked for, else best.
        Usual = ANIC_INTERPOLATE_USUAL,
        /// Any decoder plays the file.
        Linear = ANIC_INTERPOLATE_LINEAR,
        /// Geometry interpolation, which decoders may lack.
        Msgi = ANIC_INTERPOLATE_MSGI,
        /// The smaller of the two.
        Best = ANIC_INTERPOLATE_BEST,
    }
}

enumeration! {
    /// The coder of the poses of key-frames.
    KeyframeCoder: Native {
        /// Any decoder plays the file.
        Native = ANIC_KEYFRAMES_NATIVE,
        /// Draco, which decoders may lack.
        Draco = ANIC_KEYFRAMES_DRACO,
        /// The smaller of the two.
        Smallest = ANIC_KEYFRAMES_SMALLEST,
    }
}

enumeration! {
    /// Whether vertices are moved along their surface first, of one mesh alone.
    Massage: Off {
        /// Never.
        Off = ANIC_MASSAGE_OFF,
        /// Always.
        On = ANIC_MASSAGE_ON,
        /// Only if the file becomes smaller.
        Auto = ANIC_MASSAGE_AUTO,
    }
}

enumeration! {
    /// How long to search for a small file.
    Effort: Normal {
        /// A balance.
        Normal = ANIC_EFFORT_NORMAL,
        /// A third of the time, for 29 % more bytes.
        Fast = ANIC_EFFORT_FAST,
        /// 1.8 times the time, for 2 % fewer.
        Best = ANIC_EFFORT_BEST,
    }
}

/// How to encode; the default is a largest error of 0.05 % of the size, for any vertex.
#[derive(Clone, Copy, Debug, Default)]
pub struct EncodeOptions<'a> {
    /// The promise of the file.
    pub goal: Goal,
    /// A length of `goal` is in per cent of the diagonal.
    pub percent: bool,
    /// A largest error beside another goal; 0: none.
    pub max_error: f64,
    /// `max_error` is in per cent of the diagonal.
    pub cap_percent: bool,
    /// How much of the source's order is kept.
    pub order: Order,
    /// The positions come back bit for bit; instead of a goal.
    pub lossless: bool,
    /// The smallest file that the search finds, however long it takes to open.
    pub smallest: bool,
    /// The motion of the whole apart, of one mesh alone.
    pub root_motion: bool,
    /// Positions and polygons alone.
    pub no_attributes: bool,
    /// Refuse what would hold more memory; 0: no limit.
    pub max_bytes: u64,
    /// 0: as many as the machine has.
    pub threads: u32,
    /// How long to search.
    pub effort: Effort,
    /// Kind of basis.
    pub basis: BasisChoice,
    /// Exact number of key-frames; 0: as few as do.
    pub keyframes: u32,
    /// How key-frames are chosen.
    pub selection: Selection,
    /// How frames come from them.
    pub interpolation: Interpolation,
    /// Their coder.
    pub keyframe_coder: KeyframeCoder,
    /// Whether vertices are moved first.
    pub massage: Massage,
    /// The weight of shape against distance, between 0 and 1; 0 means 0.5.
    pub massage_strength: f64,
    /// How far the surface may move; 0: any.
    pub massage_tolerance: f64,
    /// Texture coordinates in steps of 2^-uv_bits; 0 means 12.
    pub uv_bits: u32,
    /// Colours in so many bits for each component; 0 means 8.
    pub colour_bits: u32,
    /// Largest error of attributes that change; 0: half a step of `colour_bits` for colours, 0.1 % of their range for others.
    pub attribute_error: f64,
    /// `attribute_error` is in per cent of the range of its values.
    pub error_percent: bool,
    /// Degrees: normals and tangents as numbers that are not further off; 0: hard edges alone.
    pub normal_error: f64,
    /// A JSON object that the file keeps, at most 2^20 bytes; empty: none.
    pub metadata: &'a str,
}

/// The file, and what was measured of it by decoding it. Lengths are in units of the clip.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Encoding {
    /// The bytes.
    pub file: Vec<u8>,
    /// Largest distance of a vertex from its place.
    pub max_error: f64,
    /// Root of the mean squared error.
    pub rmse: f64,
    /// KG error, per cent.
    pub kg: f64,
    /// The diagonal of the box around all frames of all clips.
    pub diagonal: f64,
    /// How far massage moved the surface at most.
    pub surface_error: f64,
    /// The components of the largest basis.
    pub components: u32,
    /// The basis of the first mesh.
    pub basis: BasisKind,
    /// Vertices were moved first.
    pub massaged: bool,
    /// The largest error of a vertex's move from frame to frame.
    pub max_displacement_error: f64,
}

/// Elements of a mesh, which its attributes have values for.
#[derive(Clone, Copy)]
struct Counts {
    vertices: usize,
    corners: usize,
    polygons: usize,
    frames: usize,
}

/// A clip to be encoded. It borrows the positions of its meshes, and copies everything else.
pub struct Encoder<'a> {
    raw: NonNull<sys::anic_encoder>,
    frame_count: usize,
    meshes: Vec<Counts>,
    /// Numbers of each attribute that a live stream moves, in a frame.
    moving: Vec<usize>,
    positions: PhantomData<&'a [[f32; 3]]>,
}

// SAFETY: one thread at a time may use an encoder, whichever it is.
unsafe impl Send for Encoder<'_> {}

impl Drop for Encoder<'_> {
    fn drop(&mut self) {
        // SAFETY: it lives until here.
        unsafe { sys::anic_destroy_encoder(self.raw.as_ptr()) }
    }
}

impl<'a> Encoder<'a> {
    /// An encoder of a clip without meshes.
    pub fn new(clip: &SourceClip<'_>) -> Result<Self> {
        let mut raw = ptr::null_mut();
        // SAFETY: `raw` is a place for it.
        crate::raw::check(unsafe { sys::anic_create_encoder(&mut raw) })?;
        let raw = NonNull::new(raw).ok_or(Error::of(sys::ANIC_E_INTERNAL))?;
        let mut encoder = Self { raw, frame_count: 0, meshes: Vec::new(), moving: Vec::new(), positions: PhantomData };
        encoder.give_clip(clip, sys::anic_set_source_clip)?;
        Ok(encoder)
    }

    /// Adds a clip to a file of several, before meshes are added: its frames come behind those that are there, and every mesh
    /// has the frames of all clips, one after the other. Such a file has one mesh, shown in all frames.
    pub fn add_clip(&mut self, clip: &SourceClip<'_>) -> Result<()> {
        self.give_clip(clip, sys::anic_add_source_clip)
    }

    fn give_clip(
        &mut self,
        clip: &SourceClip<'_>,
        give: unsafe extern "C" fn(*mut sys::anic_encoder, *const sys::anic_source_clip) -> i32,
    ) -> Result<()> {
        if !clip.times.is_empty() && clip.times.len() != clip.frame_count as usize {
            return Err(refused("there is not one time for each frame"));
        }
        let name = c_text(clip.name)?;
        let (names, seconds): (Vec<&str>, Vec<f64>) = clip.events.iter().copied().unzip();
        let names = Texts::new(&names)?;
        let rate = clip.rate.unwrap_or(Rate { numerator: 0, denominator: 0 });
        let mut raw: sys::anic_source_clip = init();
        raw.name = name.as_ptr();
        raw.frame_count = clip.frame_count;
        raw.rate_numerator = rate.numerator;
        raw.rate_denominator = rate.denominator;
        raw.up = clip.up.raw();
        raw.loop_ = clip.is_loop.into();
        raw.start_time = clip.start_time;
        raw.metres_per_unit = clip.metres_per_unit;
        raw.times = address(clip.times);
        raw.event_names = address(&names.addresses);
        raw.event_seconds = address(&seconds);
        raw.event_count = count(seconds.len())?;
        raw.origin = clip.origin;
        raw.find_origin = clip.find_origin.into();
        // SAFETY: everything is copied.
        let status = unsafe { give(self.raw.as_ptr(), &raw) };
        self.check(status)?;
        self.frame_count += clip.frame_count as usize;
        Ok(())
    }

    /// Adds a mesh with its positions: those of frame 0, then of frame 1 and so on. [`encode`](Self::encode) reads them. The
    /// result is the number of the mesh.
    pub fn add_mesh(&mut self, mesh: &SourceMesh<'_>, positions: &'a [[f32; 3]]) -> Result<u32> {
        let polygons = match mesh.offsets {
            [] if mesh.corners.len() % 3 != 0 => return Err(refused("corners of triangles come in threes")),
            [] => mesh.corners.len() / 3,
            [0, ..] if mesh.offsets.last().map(|&end| end as usize) == Some(mesh.corners.len()) => {
                mesh.offsets.len() - 1
            }
            _ => return Err(refused("offsets do not lead from 0 to the end of the corners")),
        };
        if mesh.offsets.windows(2).any(|ends| ends[0] > ends[1]) {
            return Err(refused("offsets do not ascend"));
        }
        let runs: Vec<sys::anic_frame_run> = mesh
            .runs
            .iter()
            .map(|run| sys::anic_frame_run { first: run.start, count: run.end.saturating_sub(run.start) })
            .collect();
        let frames = if runs.is_empty() { self.frame_count } else { runs.iter().map(|run| run.count as usize).sum() };
        if frames.checked_mul(mesh.vertex_count as usize) != Some(positions.len()) {
            return Err(refused("there is not one position for each vertex and frame"));
        }
        let name = c_text(mesh.name)?;
        let mut raw: sys::anic_source_mesh = init();
        raw.name = name.as_ptr();
        raw.vertex_count = mesh.vertex_count;
        raw.polygon_count = count(polygons)?;
        raw.offsets = address(mesh.offsets);
        raw.corners = address(mesh.corners);
        raw.positions = address(positions).cast();
        raw.scalar = sys::ANIC_SCALAR_FLOAT32;
        raw.run_count = count(runs.len())?;
        raw.runs = address(&runs);
        let mut number = 0;
        // SAFETY: all but the positions is copied; they are borrowed for 'a, and there are enough of them.
        let status = unsafe { sys::anic_add_source_mesh(self.raw.as_ptr(), &raw, &mut number) };
        self.check(status)?;
        let vertices = mesh.vertex_count as usize;
        self.meshes.push(Counts { vertices, corners: mesh.corners.len(), polygons, frames });
        Ok(number)
    }

    /// Adds an attribute to a mesh.
    pub fn add_attribute(&mut self, mesh: u32, attribute: &SourceAttribute<'_>) -> Result<()> {
        let of = *self.meshes.get(mesh as usize).ok_or(refused("there is no such mesh"))?;
        let elements = match attribute.domain {
            Domain::Vertices => of.vertices,
            Domain::Corners => of.corners,
            Domain::Polygons => of.polygons,
        };
        let a_frame = elements.saturating_mul(attribute.components as usize);
        let frames = attribute.values.len().checked_div(a_frame).unwrap_or(0);
        let is_pushed = self.frame_count == 0 && frames == 0;
        if a_frame.saturating_mul(frames) != attribute.values.len()
            || (frames != 1 && frames != of.frames && a_frame > 0 && !is_pushed)
        {
            return Err(refused("there is not one value for each element, of one frame or of all"));
        }
        let labels = if attribute.components == 0 { elements } else { 0 };
        if attribute.labels.len() != labels {
            return Err(refused("there is not one label for each element"));
        }
        if !attribute.looks.is_empty() && attribute.looks.len() != attribute.label_names.len() {
            return Err(refused("there is not one look for each name"));
        }
        let (name, unit) = (c_text(attribute.name)?, c_text(attribute.unit)?);
        let names = Texts::new(attribute.label_names)?;
        let looks = attribute.looks.iter().map(|look| look.as_ref().map(RawLook::new).transpose());
        let looks: Vec<Option<RawLook>> = looks.collect::<Result<_>>()?;
        let materials: Vec<*const sys::anic_material> =
            looks.iter().map(|look| look.as_ref().map_or(ptr::null(), |look| &raw const look.raw)).collect();
        let mut raw: sys::anic_source_attribute = init();
        raw.name = name.as_ptr();
        raw.kind = attribute.kind.raw();
        raw.domain = attribute.domain.raw();
        raw.components = attribute.components;
        raw.frames = count(frames)?;
        raw.values = address(attribute.values);
        raw.labels = address(attribute.labels);
        raw.label_names = address(&names.addresses);
        raw.label_count = count(attribute.label_names.len())?;
        raw.materials = address(&materials);
        raw.unit = unit.as_ptr();
        (raw.bound, raw.error) = attribute.bound.raw();
        // SAFETY: everything is copied, and there is as much of it as was checked.
        let status = unsafe { sys::anic_add_source_attribute(self.raw.as_ptr(), mesh, &raw) };
        self.check(status)?;
        if is_pushed && attribute.components > 0 {
            self.moving.push(a_frame);
        }
        Ok(())
    }

    /// Encodes the meshes to one file, decodes it, and checks that it keeps what was asked. The same input and options give
    /// the same bytes, which are those of the command `anicodec encode`.
    pub fn encode(&mut self, options: &EncodeOptions<'_>) -> Result<Encoding> {
        self.encode_with(options, |_, _| ControlFlow::Continue(()))
    }

    /// The same, and `report` gets the name of each stage and its share done; it breaks to stop the encoding, which fails
    /// with [`Status::Cancelled`] then. A panic of `report` ends the process.
    pub fn encode_with(
        &mut self,
        options: &EncodeOptions<'_>,
        report: impl FnMut(&str, f64) -> ControlFlow<()>,
    ) -> Result<Encoding> {
        let mut report: Box<Report<'_>> = Box::new(report);
        let metadata = c_text(options.metadata)?;
        let mut raw = options.raw();
        if !options.metadata.is_empty() {
            raw.metadata = metadata.as_ptr();
        }
        raw.progress.user = ptr::from_mut(&mut report).cast();
        raw.progress.report = Some(report_stage);
        let mut out: sys::anic_encoding = init();
        // SAFETY: positions are borrowed, and the options live during the call.
        let status = unsafe { sys::anic_encode(self.raw.as_ptr(), &raw, &mut out) };
        self.check(status)?;
        Ok(Encoding {
            // SAFETY: the file belongs to the encoder until the next call.
            file: unsafe { slice(out.file.cast::<u8>(), out.size) }.to_vec(),
            max_error: out.max_error,
            rmse: out.rmse,
            kg: out.kg,
            diagonal: out.diagonal,
            surface_error: out.surface_error,
            components: out.components,
            basis: BasisKind::from_raw(out.basis),
            massaged: out.massaged != 0,
            max_displacement_error: out.max_displacement_error,
        })
    }

    fn check(&self, status: sys::anic_status) -> Result<()> {
        if status == sys::ANIC_OK {
            return Ok(());
        }
        // SAFETY: the text is good until the next call.
        let said = unsafe { text(sys::anic_get_encoder_text(self.raw.as_ptr())) };
        let status = Status::from_raw(status);
        Err(Error::Encode { status, text: said.to_string_lossy().into_owned() })
    }
}

impl fmt::Debug for Encoder<'_> {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "Encoder of {} meshes, {} frames", self.meshes.len(), self.frame_count)
    }
}

impl EncodeOptions<'_> {
    fn raw(&self) -> sys::anic_encode_options {
        let mut raw: sys::anic_encode_options = init();
        (raw.goal, raw.goal_value) = self.goal.raw();
        raw.order = self.order.raw();
        raw.max_error = self.max_error;
        for (wanted, flag) in [
            (self.percent, sys::ANIC_ENCODE_PERCENT),
            (self.cap_percent, sys::ANIC_ENCODE_CAP_PERCENT),
            (self.error_percent, sys::ANIC_ENCODE_ERROR_PERCENT),
            (self.no_attributes, sys::ANIC_ENCODE_NO_ATTRIBUTES),
            (self.root_motion, sys::ANIC_ENCODE_ROOT_MOTION),
            (self.lossless, sys::ANIC_ENCODE_LOSSLESS),
            (self.smallest, sys::ANIC_ENCODE_SMALLEST),
        ] {
            raw.flags |= if wanted { u64::from(flag) } else { 0 };
        }
        raw.max_bytes = self.max_bytes;
        raw.threads = self.threads;
        raw.effort = self.effort.raw();
        raw.basis = self.basis.raw();
        raw.keyframes = self.keyframes;
        raw.selection = self.selection.raw();
        raw.interpolation = self.interpolation.raw();
        raw.keyframe_coder = self.keyframe_coder.raw();
        raw.massage = self.massage.raw();
        raw.uv_bits = self.uv_bits;
        raw.colour_bits = self.colour_bits;
        raw.massage_strength = self.massage_strength;
        raw.massage_tolerance = self.massage_tolerance;
        raw.attribute_error = self.attribute_error;
        raw.normal_error = self.normal_error;
        raw
    }
}

/// How a live stream is cut.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LiveOptions {
    /// Seconds of a file; 0: 1.
    pub piece_seconds: f64,
    /// A file begins anew so many seconds after the last that did; whoever joins late, or has lost a file, goes on there. 0: 4;
    /// below 0: every file does.
    pub key_seconds: f64,
    /// The diagonal that a goal in per cent is of; 0: that of the first file's frames.
    pub diagonal: f64,
    /// Frames that wait for being encoded at most, at least those of a file; 0: any number, whatever memory they take.
    pub most_waiting_frames: u64,
}

/// A capture that is encoded while it goes on: frames in, files of a live stream out, which a [`Stream`](crate::Stream) plays
/// one after the other. A thread of the library encodes.
///
/// ```
/// use anicodec::encode::{Effort, EncodeOptions, Encoder, LiveOptions, SourceClip, SourceMesh};
///
/// let mut encoder = Encoder::new(&SourceClip { name: "capture", ..Default::default() })?; // no frames: they are pushed
/// encoder.add_mesh(&SourceMesh { vertex_count: 3, corners: &[0, 1, 2], ..Default::default() }, &[])?;
/// let mut live = encoder.live(&EncodeOptions { effort: Effort::Fast, ..Default::default() }, &LiveOptions::default())?;
/// for frame in 0..60 {
///     let x = frame as f32 / 60.0;
///     live.push(&[[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x, 1.0, x * x]], &[], f64::INFINITY)?;
/// }
/// live.end()?;
/// let mut stream = anicodec::Stream::new()?;
/// let mut frames = 0;
/// while let Some(piece) = live.take(f64::INFINITY)? {
///     stream.push(&piece.file)?;
///     if piece.first_frame > 0 {
///         stream.advance()?;
///     }
///     frames += stream.open()?.info().frame_count;
/// }
/// assert_eq!(frames, 60);
/// # Ok::<(), anicodec::Error>(())
/// ```
pub struct Live {
    raw: NonNull<sys::anic_live>,
    vertex_count: usize,
    /// Numbers of each attribute that moves, in a frame.
    value_counts: Vec<usize>,
}

// SAFETY: calls come one after the other, as &mut self says, from whichever thread.
unsafe impl Send for Live {}

impl Drop for Live {
    fn drop(&mut self) {
        // SAFETY: it lives until here.
        unsafe { sys::anic_destroy_live(self.raw.as_ptr()) }
    }
}

/// A file of a live stream, and what was measured of it.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Piece {
    /// The bytes.
    pub file: Vec<u8>,
    /// The number of its first frame, counted from the first that was pushed.
    pub first_frame: u64,
    /// How many frames it has.
    pub frame_count: u32,
    /// The time of its first frame, on the clock of the clip.
    pub start_time: f64,
    /// That encoding took.
    pub encode_seconds: f64,
    /// Largest distance of a vertex from its place.
    pub max_error: f64,
    /// Root of the mean squared error.
    pub rmse: f64,
    /// KG error, per cent.
    pub kg: f64,
    /// It begins anew: whoever has lost a file goes on here.
    pub key: bool,
    /// It is no continuation: whoever joins needs the last of these, and then a key.
    pub has_mesh: bool,
}

/// How far a live stream is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct LiveInfo {
    /// Frames that came.
    pub pushed_frames: u64,
    /// Frames of which no file is made yet.
    pub waiting_frames: u64,
    /// Waiting frames of full files that are not begun: 0 while the encoder keeps up.
    pub late_frames: u64,
    /// Files made, and not taken.
    pub waiting_pieces: u64,
    /// That the last file took.
    pub encode_seconds: f64,
    /// Frames of a file, but for the last.
    pub piece_frames: u32,
    /// All files are taken.
    pub ended: bool,
}

impl Encoder<'_> {
    /// Begins a live stream of the clip, whose `frame_count` is 0, and its mesh, of which there is one; both are copied. An
    /// attribute without values moves: every frame has values of it. `Effort::Fast` is fast enough for 10,000 vertices at 30
    /// frames a second.
    pub fn live(&mut self, options: &EncodeOptions<'_>, live: &LiveOptions) -> Result<Live> {
        let metadata = c_text(options.metadata)?;
        let mut wanted = options.raw();
        if !options.metadata.is_empty() {
            wanted.metadata = metadata.as_ptr();
        }
        let mut cut: sys::anic_live_options = init();
        cut.piece_seconds = live.piece_seconds;
        cut.key_seconds = live.key_seconds;
        cut.box_ = live.diagonal;
        cut.most_waiting_frames = live.most_waiting_frames;
        let mut raw = ptr::null_mut();
        // SAFETY: the options live during the call; clip and mesh are copied.
        let status = unsafe { sys::anic_begin_live(self.raw.as_ptr(), &wanted, &cut, &mut raw) };
        self.check(status)?;
        let raw = NonNull::new(raw).ok_or(Error::of(sys::ANIC_E_INTERNAL))?;
        let vertex_count = self.meshes.first().map_or(0, |mesh| mesh.vertices);
        Ok(Live { raw, vertex_count, value_counts: self.moving.clone() })
    }
}

impl Live {
    /// Copies a frame: a position for each vertex, and the values of all attributes that move, in the order in which they were
    /// added. Waits at most `wait` seconds for room; [`Status::Limit`] where there is none: nothing was taken.
    pub fn push(&mut self, positions: &[[f32; 3]], values: &[&[f32]], wait: f64) -> Result<()> {
        if positions.len() != self.vertex_count || !values.iter().map(|v| v.len()).eq(self.value_counts.iter().copied())
        {
            return Err(refused("there is not one position for each vertex, or one value for each element"));
        }
        let addresses: Vec<*const f32> = values.iter().map(|values| values.as_ptr()).collect();
        let mut frame: sys::anic_live_frame = init();
        frame.positions = positions.as_ptr().cast();
        frame.scalar = sys::ANIC_SCALAR_FLOAT32;
        frame.value_count = count(values.len())?;
        frame.values = address(&addresses);
        // SAFETY: &mut self; the frame is copied, and there is as much of it as was checked.
        check_live(unsafe { sys::anic_push_live_frame(self.raw.as_ptr(), &frame, wait) })
    }

    /// No frame follows: the last file gets those that are there.
    pub fn end(&mut self) -> Result<()> {
        // SAFETY: &mut self.
        check_live(unsafe { sys::anic_end_live(self.raw.as_ptr()) })
    }

    /// Takes the next file, once it is made. Waits at most `wait` seconds; none was made in time, or all are taken.
    pub fn take(&mut self, wait: f64) -> Result<Option<Piece>> {
        let mut out: sys::anic_live_piece = init();
        // SAFETY: &mut self.
        match unsafe { sys::anic_take_live_piece(self.raw.as_ptr(), wait, &mut out) } {
            sys::ANIC_E_ABSENT => return Ok(None),
            status => check_live(status)?,
        }
        Ok(Some(Piece {
            // SAFETY: the file belongs to the stream until the next call.
            file: unsafe { slice(out.file.cast::<u8>(), out.size) }.to_vec(),
            first_frame: out.first_frame,
            frame_count: out.frame_count,
            start_time: out.start_time,
            encode_seconds: out.encode_seconds,
            max_error: out.max_error,
            rmse: out.rmse,
            kg: out.kg,
            key: out.key != 0,
            has_mesh: out.has_mesh != 0,
        }))
    }

    /// How far the stream is.
    pub fn info(&mut self) -> LiveInfo {
        let mut raw: sys::anic_live_info = init();
        // SAFETY: the stream lives. Asked for with a stream and a struct, it cannot fail.
        unsafe { sys::anic_get_live_info(self.raw.as_ptr(), &mut raw) };
        LiveInfo {
            pushed_frames: raw.pushed_frames,
            waiting_frames: raw.waiting_frames,
            late_frames: raw.late_frames,
            waiting_pieces: raw.waiting_pieces,
            encode_seconds: raw.encode_seconds,
            piece_frames: raw.piece_frames,
            ended: raw.ended != 0,
        }
    }
}

impl fmt::Debug for Live {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "Live of {} vertices", self.vertex_count)
    }
}

fn check_live(status: sys::anic_status) -> Result<()> {
    if status == sys::ANIC_OK {
        return Ok(());
    }
    // SAFETY: the text is good until this thread's next call.
    let said = unsafe { text(sys::anic_get_live_text()) };
    Err(Error::Encode { status: Status::from_raw(status), text: said.to_string_lossy().into_owned() })
}

type Report<'a> = dyn FnMut(&str, f64) -> ControlFlow<()> + 'a;

unsafe extern "C" fn report_stage(user: *mut c_void, stage: *const c_char, done: f64) -> c_int {
    // SAFETY: `user` is the Box of encode_with(), which outlives the call and is used by its thread alone.
    let report = unsafe { &mut *user.cast::<Box<Report<'_>>>() };
    // SAFETY: names of stages are static.
    c_int::from(report(unsafe { english(stage) }, done).is_break())
}

/// An error of what is checked before the library gets it.
fn refused(text: &str) -> Error {
    Error::Encode { status: Status::Argument, text: text.into() }
}

fn c_text(from: &str) -> Result<CString> {
    CString::new(from).map_err(|_| refused("a text has a NUL in it"))
}

/// NULL for nothing, as C wants it.
fn address<T>(from: &[T]) -> *const T {
    if from.is_empty() {
        ptr::null()
    } else {
        from.as_ptr()
    }
}

fn count(from: usize) -> Result<u32> {
    u32::try_from(from).map_err(|_| refused("there are more than 2^32 - 1 elements"))
}

/// Texts and their addresses, as C wants them.
struct Texts {
    addresses: Vec<*const c_char>,
    _texts: Vec<CString>,
}

impl Texts {
    fn new(from: &[&str]) -> Result<Self> {
        let texts = from.iter().map(|text| c_text(text)).collect::<Result<Vec<_>>>()?;
        Ok(Self { addresses: texts.iter().map(|text| CStr::as_ptr(text)).collect(), _texts: texts })
    }
}

/// A look as C takes it.
struct RawLook {
    raw: sys::anic_material,
    _textures: Texts,
}

impl RawLook {
    fn new(from: &Look<'_>) -> Result<Self> {
        let textures = Texts::new(&[
            from.base_colour_texture,
            from.metallic_roughness_texture,
            from.normal_texture,
            from.occlusion_texture,
            from.emissive_texture,
        ])?;
        let mut raw: sys::anic_material = init();
        raw.base_colour = from.base_colour;
        raw.metallic = from.metallic;
        raw.roughness = from.roughness;
        raw.emissive = from.emissive;
        raw.alpha = from.alpha.raw();
        raw.alpha_cutoff = from.alpha_cutoff;
        raw.double_sided = from.double_sided.into();
        raw.base_colour_texture = textures.addresses[0];
        raw.metallic_roughness_texture = textures.addresses[1];
        raw.normal_texture = textures.addresses[2];
        raw.occlusion_texture = textures.addresses[3];
        raw.emissive_texture = textures.addresses[4];
        Ok(Self { raw, _textures: textures })
    }
}
