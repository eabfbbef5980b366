// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
use alloc::ffi::CString;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;
use core::ptr::{self, NonNull};

use anicodec_sys as sys;

use crate::context::{Context, RootMotion, Sampling, Wrap};
use crate::error::{Error, Result, Status};
use crate::mesh::{first_and_count, Mesh};
use crate::options::{OpenOptions, RawOptions};
use crate::output::{Bounds, Output};
use crate::raw::{check, enumeration, fill, init, text};
use crate::text::Text;

enumeration! {
    /// The axis that points up.
    UpAxis: Unknown {
        /// Nobody knows.
        Unknown = ANIC_UP_UNKNOWN,
        /// y.
        Y = ANIC_UP_Y,
        /// z.
        Z = ANIC_UP_Z,
    }
}

enumeration! {
    /// How much of the source's order a file keeps.
    Order: Vertices {
        /// Vertices are numbered as in the source.
        Vertices = ANIC_ORDER_VERTICES,
        /// The encoder chose the order of vertices and polygons.
        Free = ANIC_ORDER_FREE,
        /// Vertices, polygons and their first corners as in the source.
        All = ANIC_ORDER_ALL,
    }
}

/// An opened file. Immutable; clones share it, on any thread.
///
/// ```
/// use anicodec::{Clip, Sampling, Wrap};
///
/// let clip = Clip::open(std::fs::read("examples/walk.anic")?)?;
/// let mut dancer = clip.context()?;
/// let mut points = vec![[0.0; 3]; clip.mesh(0)?.vertex_count as usize];
/// dancer.seek(0.25, Sampling::Linear, Wrap::Loop)?;
/// dancer.positions_into(&mut points)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct Clip(Arc<Asset>);

struct Asset(NonNull<sys::anic_asset>);

// SAFETY: an asset is immutable, and any thread may use and close it.
unsafe impl Send for Asset {}
// SAFETY: as above.
unsafe impl Sync for Asset {}

impl Drop for Asset {
    fn drop(&mut self) {
        // SAFETY: contexts hold a clip, so that none is left.
        unsafe { sys::anic_close_asset(self.0.as_ptr()) }
    }
}

impl Clip {
    /// Opens a whole file in memory, borrowed or owned, with the default [`OpenOptions`]. The bytes are not needed afterwards.
    ///
    /// Decodes all coefficients once, which takes microseconds for each vertex.
    pub fn open(file: impl AsRef<[u8]>) -> Result<Self> {
        OpenOptions::new().open(file)
    }

    pub(crate) fn open_with(file: &[u8], options: &RawOptions) -> Result<Self> {
        Self::opened(|out, failure| {
            // SAFETY: file and options live during the call.
            unsafe { sys::anic_open_asset(file.as_ptr().cast(), file.len(), &options.raw, out, failure) }
        })
    }

    /// Takes what a function opens.
    pub(crate) fn opened(
        open: impl FnOnce(*mut *mut sys::anic_asset, *mut sys::anic_failure) -> sys::anic_status,
    ) -> Result<Self> {
        let mut asset = ptr::null_mut();
        let mut failure = init();
        open(&mut asset, &mut failure);
        NonNull::new(asset).map(Asset).map(Arc::new).map(Self).ok_or_else(|| Error::of_failure(&failure))
    }

    pub(crate) fn raw(&self) -> *const sys::anic_asset {
        self.0 .0.as_ptr()
    }

    /// Makes another clip of the same memory, with clips or a quality of its own: some of the clips open here, and no more
    /// of the components. Nothing is decoded.
    pub fn share(&self, options: &OpenOptions) -> Result<Self> {
        let options = RawOptions::new(options)?;
        let mut asset = ptr::null_mut();
        // SAFETY: the options live during the call.
        check(unsafe { sys::anic_share_asset(self.raw(), &options.raw, &mut asset) })?;
        NonNull::new(asset).map(Asset).map(Arc::new).map(Self).ok_or(Error::of(sys::ANIC_E_INTERNAL))
    }

    /// Makes an instance of the clip. It allocates here and nowhere else.
    pub fn context(&self) -> Result<Context> {
        Context::new(self)
    }

    /// Compares the hashes in the file with what was decoded; [`Status::State`] of a clip that is not complete.
    pub fn verify(&self) -> Result<()> {
        // SAFETY: the asset is open.
        check(unsafe { sys::anic_verify_asset(self.raw()) })
    }

    /// The facts of all clips and meshes.
    pub fn info(&self) -> Info<'_> {
        // Asked for with an asset and a struct, it cannot fail.
        let raw = fill(|out| {
            // SAFETY: the asset is open.
            unsafe { sys::anic_get_asset_info(self.raw(), out) }
        });
        Info::from_raw(&raw.unwrap_or_else(|_| init()))
    }

    /// The clips of the file: what its character does. There is one at least.
    pub fn clips(&self) -> impl ExactSizeIterator<Item = NamedClip<'_>> {
        // SAFETY: the asset is open.
        let count = unsafe { sys::anic_get_clip_count(self.raw()) };
        (0..count as usize).map(|number| self.named(number as u32).unwrap_or_default())
    }

    /// A clip by its number; [`Status::Argument`] where there is none.
    pub fn clip(&self, number: u32) -> Result<NamedClip<'_>> {
        self.named(number)
    }

    /// The number of a clip by its name; none where no clip has it.
    pub fn find_clip(&self, name: impl AsRef<[u8]>) -> Option<u32> {
        let name = CString::new(name.as_ref()).ok()?;
        let mut number = 0;
        // SAFETY: the name is ended by 0.
        let status = unsafe { sys::anic_find_clip(self.raw(), name.as_ptr(), &mut number) };
        (status == sys::ANIC_OK).then_some(number)
    }

    fn named(&self, number: u32) -> Result<NamedClip<'_>> {
        let raw = fill(|out| {
            // SAFETY: the asset is open.
            unsafe { sys::anic_get_clip(self.raw(), number, out) }
        })?;
        Ok(NamedClip::from_raw(number, &raw))
    }

    /// Named times of a clip, open or not, ascending.
    pub fn events(&self, clip: u32) -> impl ExactSizeIterator<Item = Event<'_>> {
        // SAFETY: the asset is open.
        let count = unsafe { sys::anic_get_event_count(self.raw(), clip) };
        (0..count as usize).map(move |number| {
            let raw = fill(|out| {
                // SAFETY: the asset is open.
                unsafe { sys::anic_get_event(self.raw(), clip, number as u32, out) }
            });
            let raw: sys::anic_event = raw.unwrap_or_else(|_| init());
            // SAFETY: strings belong to the asset.
            Event { name: unsafe { text(raw.name) }, seconds: raw.seconds }
        })
    }

    /// The meshes.
    pub fn meshes(&self) -> impl Iterator<Item = Mesh<'_>> {
        (0..self.info().mesh_count).filter_map(|number| self.mesh(number).ok())
    }

    /// A mesh by its number; [`Status::Argument`] where there is none.
    pub fn mesh(&self, number: u32) -> Result<Mesh<'_>> {
        Mesh::new(self, number)
    }

    /// Time of a frame in seconds, from the first frame of its clip on. Frames behind the last count as the last.
    pub fn frame_time(&self, frame: u32) -> f64 {
        // SAFETY: the asset is open.
        unsafe { sys::anic_get_frame_time(self.raw(), frame) }
    }

    /// The motion of the whole at a time of a clip, part of the positions or not. A loop begins again where it began:
    /// [`root_step`](Self::root_step) is for characters that go on.
    pub fn root_motion(&self, clip: u32, seconds: f64, sampling: Sampling, wrap: Wrap) -> Result<RootMotion> {
        let raw = fill(|out| {
            // SAFETY: the asset is open.
            unsafe { sys::anic_get_root_motion(self.raw(), clip, seconds, sampling.raw(), wrap.raw(), out) }
        })?;
        Ok(RootMotion::from_raw(&raw))
    }

    /// The motion that takes a character from one time of a clip to another, in the axes that it has at the first: loops go on from
    /// where they end, any number of times. Either time may be the earlier one.
    ///
    /// ```
    /// use anicodec::{Clip, Sampling, Wrap};
    ///
    /// let clip = Clip::open(std::fs::read("examples/walk.anic")?)?;
    /// let walk = clip.find_clip("walk").unwrap();
    /// let step = clip.root_step(walk, 0.0, 10.0, Sampling::Linear, Wrap::Loop)?;
    /// assert!(step.moves && step.movement[0].hypot(step.movement[1]) > 1.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn root_step(&self, clip: u32, from: f64, to: f64, sampling: Sampling, wrap: Wrap) -> Result<RootMotion> {
        let raw = fill(|out| {
            // SAFETY: the asset is open.
            unsafe { sys::anic_get_root_step(self.raw(), clip, from, to, sampling.raw(), wrap.raw(), out) }
        })?;
        Ok(RootMotion::from_raw(&raw))
    }

    /// The exact box of a mesh around all frames, of a clip opened with [`OpenOptions::bounds`]; none where the mesh is in no
    /// frame. Between frames, positions leave it a little with [`Sampling::Cubic`] or rigid motions alone.
    pub fn bounds(&self, mesh: u32) -> Result<Option<Bounds>> {
        Bounds::unless_absent(|out| {
            // SAFETY: the asset is open.
            unsafe { sys::anic_get_clip_bounds(self.raw(), mesh, out) }
        })
    }

    /// The exact box of a mesh in a frame, of a clip opened with [`OpenOptions::bounds`]; none where the mesh is not there.
    pub fn frame_bounds(&self, mesh: u32, frame: u32) -> Result<Option<Bounds>> {
        Bounds::unless_absent(|out| {
            // SAFETY: the asset is open.
            unsafe { sys::anic_get_frame_bounds(self.raw(), mesh, frame, out) }
        })
    }

    /// Writes positions of a range of vertices in up to 16 whole frames, `frames[i]` to `outputs[i]`, without a context.
    /// Consecutive frames, four at a time, take about half the time of single ones. [`Status::State`] of geometry
    /// interpolation, which needs the memory of a context.
    pub fn write_frames(
        &self,
        mesh: u32,
        frames: &[u32],
        vertices: Range<u32>,
        outputs: &mut [Output<'_>],
    ) -> Result<()> {
        if frames.len() != outputs.len() {
            return Err(Error::ARGUMENT);
        }
        let (first, vertex_count) = first_and_count(&vertices)?;
        let count = u32::try_from(frames.len()).map_err(|_| Error::ARGUMENT)?;
        let raw: Vec<sys::anic_output> = outputs.iter_mut().map(|output| output.raw).collect();
        // SAFETY: outputs are exclusive borrows of what they name, so that none overlap.
        check(unsafe {
            sys::anic_write_frames(self.raw(), mesh, frames.as_ptr(), count, first, vertex_count, raw.as_ptr())
        })
    }
}

impl fmt::Debug for Clip {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        let info = self.info();
        write!(to, "Clip({:?}, {} meshes, {} frames)", info.name, info.mesh_count, info.frame_count)
    }
}

/// Frames per second: a hint where frames have times of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rate {
    /// Frames.
    pub numerator: u32,
    /// In so many seconds.
    pub denominator: u32,
}

impl Rate {
    /// Frames per second.
    pub fn per_second(self) -> f64 {
        f64::from(self.numerator) / f64::from(self.denominator)
    }
}

impl Default for Rate {
    fn default() -> Self {
        Self { numerator: 24, denominator: 1 }
    }
}

/// The facts of all clips and meshes of a file: [`Clip::info`]. Each clip has a clock and errors: [`NamedClip`].
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Info<'a> {
    /// The name of the first clip.
    pub name: Text<'a>,
    /// The program that wrote the file.
    pub encoder: Text<'a>,
    /// How many meshes there are.
    pub mesh_count: u32,
    /// How many segments: what [`Clip::basis`] counts.
    pub segment_count: u32,
    /// The frames of all clips.
    pub frame_count: u32,
    /// The axis that points up.
    pub up: UpAxis,
    /// How much of the source's order is kept.
    pub order: Order,
    /// Made from a stream that was not complete: parts are missing or coarser.
    pub partial: bool,
    /// 0: unknown.
    pub metres_per_unit: f64,
    /// The place that positions count from, as the source has it: added in `f64`, it gives the source's coordinates, which
    /// may be too far from zero for `f32`.
    pub origin: [f64; 3],
    /// Held by this clip.
    pub resident_bytes: u64,
    /// Held by each context.
    pub context_bytes: u64,
}

impl Info<'_> {
    fn from_raw(raw: &sys::anic_asset_info) -> Self {
        Self {
            // SAFETY: strings belong to the asset, which the lifetime of the caller's borrow keeps.
            name: unsafe { text(raw.name) },
            // SAFETY: as above.
            encoder: unsafe { text(raw.encoder) },
            mesh_count: raw.mesh_count,
            segment_count: raw.segment_count,
            frame_count: raw.frame_count,
            up: UpAxis::from_raw(raw.up),
            order: Order::from_raw(raw.order),
            partial: raw.partial != 0,
            metres_per_unit: raw.metres_per_unit,
            origin: raw.origin,
            resident_bytes: raw.resident_bytes,
            context_bytes: raw.context_bytes,
        }
    }
}

/// One of the clips of a file, with a clock and a promise of its own. Lengths are in units of the clip.
#[derive(Clone, Copy, Debug, Default)]
#[non_exhaustive]
pub struct NamedClip<'a> {
    /// Its number.
    pub number: u32,
    /// As in the source.
    pub name: Text<'a>,
    /// Its first frame in the file.
    pub first_frame: u32,
    /// How many frames it has.
    pub frame_count: u32,
    /// Frames per second.
    pub rate: Rate,
    /// The source told no rate.
    pub rate_assumed: bool,
    /// Frames have times of their own: [`Clip::frame_time`].
    pub uneven: bool,
    /// Meant to be played with [`Wrap::Loop`].
    pub is_loop: bool,
    /// The last frame repeats the first.
    pub closed: bool,
    /// The mesh was changed before coding: see `surface_error`.
    pub massaged: bool,
    /// [`OpenOptions::clips`] names it, or none.
    pub is_open: bool,
    /// The time of its first frame on the clock of the source, seconds: for tools alone. Times of this crate count from that frame.
    pub start_time: f64,
    /// Seconds from the first frame to the last.
    pub duration: f64,
    /// Seconds of one turn of [`Wrap::Loop`].
    pub loop_duration: f64,
    /// The diagonal of the box around its frames of the source.
    pub diagonal: f64,
    /// Largest distance of a vertex from its place in the source, at full quality.
    pub max_error: f64,
    /// Root of the mean squared error.
    pub rmse: f64,
    /// KG error, per cent.
    pub kg: f64,
    /// Largest distance from the source's surface.
    pub surface_error: f64,
    /// Mean distance from it.
    pub surface_error_mean: f64,
    /// Largest error of a vertex's move from frame to frame.
    pub max_displacement_error: f64,
}

impl NamedClip<'_> {
    fn from_raw(number: u32, raw: &sys::anic_clip) -> Self {
        Self {
            number,
            // SAFETY: strings belong to the asset, which the lifetime of the caller's borrow keeps.
            name: unsafe { text(raw.name) },
            first_frame: raw.first_frame,
            frame_count: raw.frame_count,
            rate: Rate { numerator: raw.rate_numerator, denominator: raw.rate_denominator },
            rate_assumed: raw.rate_assumed != 0,
            uneven: raw.uneven != 0,
            is_loop: raw.loop_ != 0,
            closed: raw.closed != 0,
            massaged: raw.massaged != 0,
            is_open: raw.open != 0,
            start_time: raw.start_time,
            duration: raw.duration,
            loop_duration: raw.loop_duration,
            diagonal: raw.diagonal,
            max_error: raw.max_error,
            rmse: raw.rmse,
            kg: raw.kg,
            surface_error: raw.surface_error,
            surface_error_mean: raw.surface_error_mean,
            max_displacement_error: raw.max_displacement_error,
        }
    }
}

/// A named time of a clip.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Event<'a> {
    /// As in the source.
    pub name: Text<'a>,
    /// From the clip's first frame on, 0 or more.
    pub seconds: f64,
}

/// The metadata of a file that is not opened: a JSON object; none where it has none. `file` holds the first bytes of it.
///
/// ```
/// let file = std::fs::read("examples/walk.anic")?;
/// assert_eq!(anicodec::read_metadata(&file)?, None);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_metadata(file: &[u8]) -> Result<Option<&str>> {
    let (mut from, mut bytes) = (ptr::null(), 0);
    // SAFETY: `file` lives during the call.
    match unsafe { sys::anic_read_metadata(file.as_ptr().cast(), file.len(), &mut from, &mut bytes) } {
        sys::ANIC_E_ABSENT => Ok(None),
        status => {
            check(status)?;
            // SAFETY: the text lies in `file`.
            let json = unsafe { crate::raw::slice(from.cast::<u8>(), bytes) };
            core::str::from_utf8(json).map(Some).map_err(|_| Error::of(sys::ANIC_E_RECORD))
        }
    }
}

/// A box around frames of a mesh of a file that is not opened, to cull it before it is decoded; none where the mesh is in
/// none of the frames, or the file has no boxes of them. `file` holds the first bytes of it. An empty range: all frames
/// from its start on.
///
/// The box contains all positions of these frames, up to rounding, and is larger than they are: it is kept for 64 frames
/// as a rule.
pub fn read_bounds(file: &[u8], mesh: u32, frames: Range<u32>) -> Result<Option<Bounds>> {
    let count = frames.end.saturating_sub(frames.start);
    Bounds::unless_absent(|out| {
        // SAFETY: `file` lives during the call.
        unsafe { sys::anic_read_bounds(file.as_ptr().cast(), file.len(), mesh, frames.start, count, out) }
    })
}

/// Version of the decoder: major, minor, patch.
pub fn version() -> (u8, u8, u8) {
    // SAFETY: there is nothing to be wrong.
    let [_, major, minor, patch] = unsafe { sys::anic_get_version() }.to_be_bytes();
    (major, minor, patch)
}

impl Bounds {
    pub(crate) fn unless_absent(get: impl FnOnce(*mut sys::anic_box) -> sys::anic_status) -> Result<Option<Self>> {
        let mut raw = sys::anic_box { min: [0.0; 3], max: [0.0; 3] };
        match check(get(&mut raw)) {
            Ok(()) => Ok(Some(Self { min: raw.min, max: raw.max })),
            Err(error) if error.status() == Status::Absent => Ok(None),
            Err(error) => Err(error),
        }
    }
}
