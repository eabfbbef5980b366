// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
use alloc::boxed::Box;
use alloc::ffi::CString;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::ffi::{c_char, c_int, c_void};
use core::fmt;
use core::ops::ControlFlow;
use core::ptr;
use core::sync::atomic::{AtomicBool, Ordering};

use anicodec_sys as sys;

use crate::clip::Clip;
use crate::error::{Error, Result};
use crate::raw::{fill, init};
use crate::stream::Stream;

/// Calls a function for each number below a count, on threads if it likes.
pub type Run = dyn Fn(usize, &(dyn Fn(usize) + Sync)) + Send + Sync;

/// Gets the share of an opening that is done, 0 to 1, and breaks to stop it.
pub type Progress = dyn Fn(f64) -> ControlFlow<()> + Send + Sync;

/// How to open a file: limits, quality, clips.
///
/// A file that asks for more than a limit is refused with [`Status::Limit`](crate::Status::Limit), before anything that
/// depends on a count is allocated. The defaults refuse nothing but files that could not be honest.
///
/// ```
/// use anicodec::OpenOptions;
///
/// let file = std::fs::read("examples/walk.anic")?;
/// let clip = OpenOptions::new().max_bytes(64 << 20).bounds(true).clips(["walk"]).open(&file)?;
/// assert!(clip.clip(2)?.is_open && !clip.clip(0)?.is_open);
/// println!("{:?}", clip.bounds(0)?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Default)]
pub struct OpenOptions {
    max_vertices: u64,
    max_frames: u64,
    max_components: u64,
    max_bytes: u64,
    quality: f64,
    flags: u64,
    clips: Vec<Vec<u8>>,
    threads: Option<Arc<Box<Run>>>,
    progress: Option<Arc<Box<Progress>>>,
}

impl OpenOptions {
    /// The defaults.
    pub fn new() -> Self {
        Self::default()
    }

    /// Most vertices of a mesh; 0: 2^31 - 1.
    pub fn max_vertices(mut self, count: u64) -> Self {
        self.max_vertices = count;
        self
    }

    /// Most frames; 0: 2^24 - 1.
    pub fn max_frames(mut self, count: u64) -> Self {
        self.max_frames = count;
        self
    }

    /// Most components of a segment; 0: 2^20.
    pub fn max_components(mut self, count: u64) -> Self {
        self.max_components = count;
        self
    }

    /// Most memory that opening takes; 0: 2^28 bytes, and 2^14 for each byte of the file.
    pub fn max_bytes(mut self, bytes: u64) -> Self {
        self.max_bytes = bytes;
        self
    }

    /// Share of the components to open, in (0, 1]: fewer are coarser, smaller, and faster to open and to play.
    pub fn quality(mut self, quality: f64) -> Self {
        self.quality = quality;
        self
    }

    /// Computes the box of every frame while opening, for [`Clip::bounds`] and [`Clip::frame_bounds`]. This costs what
    /// playing all frames once does, and 24 bytes for each frame and mesh.
    pub fn bounds(self, wanted: bool) -> Self {
        self.flag(sys::ANIC_OPEN_BOUNDS.into(), wanted)
    }

    /// Leaves the order of the source's vertices and polygons alone, which opens faster, for hosts that take faces and
    /// attributes from the clip too.
    pub fn any_order(self, wanted: bool) -> Self {
        self.flag(sys::ANIC_OPEN_ANY_ORDER.into(), wanted)
    }

    /// Leaves the motion of the whole out of positions and boxes, in clips that have it apart:
    /// [`Clip::root_motion`].
    pub fn in_place(self, wanted: bool) -> Self {
        self.flag(sys::ANIC_OPEN_IN_PLACE.into(), wanted)
    }

    /// Leaves the exact positions of a lossless file closed, and plays it from its basis.
    pub fn inexact(self, wanted: bool) -> Self {
        self.flag(sys::ANIC_OPEN_INEXACT.into(), wanted)
    }

    /// Names of the clips to open; none: all. Frames of others are [`Status::Absent`](crate::Status::Absent).
    pub fn clips<I>(mut self, names: I) -> Self
    where
        I: IntoIterator,
        I::Item: Into<Vec<u8>>,
    {
        self.clips = names.into_iter().map(Into::into).collect();
        self
    }

    /// Lends threads to opening, which gets the same result from any number of them. With rayon:
    /// `|count, body| (0..count).into_par_iter().for_each(body)`.
    ///
    /// A panic of `run` ends the process. Numbers that `run` leaves out are done on its thread.
    ///
    /// ```
    /// use anicodec::OpenOptions;
    ///
    /// let options = OpenOptions::new().threads(|count, body| {
    ///     std::thread::scope(|scope| {
    ///         for first in 0..4 {
    ///             scope.spawn(move || (first..count).step_by(4).for_each(body));
    ///         }
    ///     });
    /// });
    /// options.open(std::fs::read("examples/walk.anic")?)?.verify()?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn threads(mut self, run: impl Fn(usize, &(dyn Fn(usize) + Sync)) + Send + Sync + 'static) -> Self {
        self.threads = Some(Arc::new(Box::new(run)));
        self
    }

    /// Follows and stops an opening, which fails with [`Status::Cancelled`](crate::Status::Cancelled) then. A panic of
    /// `report` ends the process.
    pub fn progress(mut self, report: impl Fn(f64) -> ControlFlow<()> + Send + Sync + 'static) -> Self {
        self.progress = Some(Arc::new(Box::new(report)));
        self
    }

    /// Opens a whole file in memory, borrowed or owned. The bytes are not needed afterwards.
    ///
    /// Decodes all coefficients once, which takes microseconds for each vertex.
    pub fn open(&self, file: impl AsRef<[u8]>) -> Result<Clip> {
        Clip::open_with(file.as_ref(), &RawOptions::new(self)?)
    }

    /// Makes a stream whose clips open in this way.
    pub fn stream(&self) -> Result<Stream> {
        Stream::with(RawOptions::new(self)?)
    }

    /// Tells what a file will take, all of its clips, from its first bytes: header, chunk table and first chunk.
    ///
    /// With fewer bytes it fails with [`Status::Truncated`](crate::Status::Truncated); [`Requirements::head_bytes`] of
    /// [`head_bytes`](Self::head_bytes) are wanted.
    pub fn requirements(&self, head: &[u8]) -> Result<Requirements> {
        let options = RawOptions::new(self)?;
        let filled = fill(|out| {
            // SAFETY: `head` and the options live during the call.
            unsafe { sys::anic_get_requirements(head.as_ptr().cast(), head.len(), &options.raw, out) }
        })?;
        Ok(Requirements::from_raw(&filled))
    }

    /// How many first bytes of a file [`requirements`](Self::requirements) wants, or wants next to tell that.
    pub fn head_bytes(&self, head: &[u8]) -> Result<u64> {
        let options = RawOptions::new(self)?;
        let mut filled: sys::anic_requirements = init();
        // SAFETY: as above.
        let status = unsafe { sys::anic_get_requirements(head.as_ptr().cast(), head.len(), &options.raw, &mut filled) };
        match status {
            sys::ANIC_OK | sys::ANIC_E_TRUNCATED => Ok(filled.head_bytes),
            status => Err(Error::of(status)),
        }
    }

    fn flag(mut self, flag: u64, wanted: bool) -> Self {
        self.flags = if wanted { self.flags | flag } else { self.flags & !flag };
        self
    }
}

impl fmt::Debug for OpenOptions {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        to.debug_struct("OpenOptions")
            .field("max_vertices", &self.max_vertices)
            .field("max_frames", &self.max_frames)
            .field("max_components", &self.max_components)
            .field("max_bytes", &self.max_bytes)
            .field("quality", &self.quality)
            .field("flags", &self.flags)
            .field("clips", &self.clips.len())
            .field("threads", &self.threads.is_some())
            .field("progress", &self.progress.is_some())
            .finish()
    }
}

/// Memory that opening a file takes, and its counts: [`OpenOptions::requirements`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Requirements {
    /// First bytes of the file that had to be seen.
    pub head_bytes: u64,
    /// The whole file.
    pub file_bytes: u64,
    /// Held while the clip is open, within 5 %; of geometry interpolation a bound of up to three times it.
    pub resident_bytes: u64,
    /// Held at most while the file opens, resident bytes included, the bytes of the file excluded.
    pub opening_bytes: u64,
    /// Bytes of one context, at most.
    pub context_bytes: u64,
    /// How many meshes there are.
    pub mesh_count: u32,
    /// How many segments there are.
    pub segment_count: u32,
    /// Frames of all clips.
    pub frame_count: u32,
    /// Vertices of the largest mesh.
    pub max_vertices: u32,
    /// Components of the largest segment.
    pub max_components: u32,
}

impl Requirements {
    fn from_raw(raw: &sys::anic_requirements) -> Self {
        Self {
            head_bytes: raw.head_bytes,
            file_bytes: raw.file_bytes,
            resident_bytes: raw.resident_bytes,
            opening_bytes: raw.opening_bytes,
            context_bytes: raw.context_bytes,
            mesh_count: raw.mesh_count,
            segment_count: raw.segment_count,
            frame_count: raw.frame_count,
            max_vertices: raw.max_vertices,
            max_components: raw.max_components,
        }
    }
}

/// Options as C takes them, with all that they point to.
pub(crate) struct RawOptions {
    pub(crate) raw: sys::anic_options,
    _clips: Vec<CString>,
    _names: Vec<*const c_char>,
    _threads: Option<Arc<Box<Run>>>,
    _progress: Option<Arc<Box<Progress>>>,
}

// SAFETY: the pointers are to what is owned here, all of which may be sent and shared.
unsafe impl Send for RawOptions {}
// SAFETY: as above.
unsafe impl Sync for RawOptions {}

impl RawOptions {
    pub(crate) fn new(from: &OpenOptions) -> Result<Self> {
        let clips = from.clips.iter().map(|name| CString::new(&name[..])).collect::<Result<Vec<_>, _>>();
        let clips = clips.map_err(|_| Error::ARGUMENT)?;
        let names: Vec<*const c_char> = clips.iter().map(|name| name.as_ptr()).collect();
        let threads = from.threads.clone();
        let progress = from.progress.clone();
        let mut raw: sys::anic_options = init();
        raw.max_vertices = from.max_vertices;
        raw.max_frames = from.max_frames;
        raw.max_components = from.max_components;
        raw.max_bytes = from.max_bytes;
        raw.quality = from.quality;
        raw.flags = from.flags;
        raw.clips = if names.is_empty() { ptr::null() } else { names.as_ptr() };
        raw.clip_count = u32::try_from(names.len()).map_err(|_| Error::ARGUMENT)?;
        if let Some(run) = &threads {
            raw.threads.user = Arc::as_ptr(run).cast_mut().cast();
            raw.threads.run = Some(run_on_threads);
        }
        if let Some(report) = &progress {
            raw.progress.user = Arc::as_ptr(report).cast_mut().cast();
            raw.progress.report = Some(report_progress);
        }
        Ok(Self { raw, _clips: clips, _names: names, _threads: threads, _progress: progress })
    }
}

type Body = Option<unsafe extern "C" fn(context: *mut c_void, i: usize)>;

unsafe extern "C" fn run_on_threads(user: *mut c_void, count: usize, body: Body, context: *mut c_void) {
    struct Context(*mut c_void);
    // SAFETY: the library gives it to any thread.
    unsafe impl Sync for Context {}
    let (Some(body), context) = (body, &Context(context)) else { return };
    // SAFETY: `user` is the Box<Run> of RawOptions, which outlives the call.
    let run = unsafe { &*user.cast_const().cast::<Box<Run>>() };
    // SAFETY: `run_once` calls it once for every number below `count`.
    run_once(&**run, count, &|i| unsafe { body({ context }.0, i) });
}

/// Calls `body` once for every number below `count`, whatever `run` does.
fn run_once(run: &Run, count: usize, body: &(dyn Fn(usize) + Sync)) {
    let begun: Vec<AtomicBool> = (0..count).map(|_| AtomicBool::new(false)).collect();
    let once = |i: usize| {
        if begun.get(i).is_some_and(|begun| !begun.swap(true, Ordering::Relaxed)) {
            body(i);
        }
    };
    run(count, &once);
    (0..count).for_each(once);
}

unsafe extern "C" fn report_progress(user: *mut c_void, done: f64) -> c_int {
    // SAFETY: `user` is the Box<Progress> of RawOptions, which outlives the call.
    let report = unsafe { &*user.cast_const().cast::<Box<Progress>>() };
    c_int::from(report(done).is_break())
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;
    use core::sync::atomic::AtomicUsize;

    #[test]
    fn what_options_say_is_what_c_gets() {
        let options =
            OpenOptions::new().max_bytes(5).quality(0.5).bounds(true).in_place(true).bounds(false).clips(["a", "b"]);
        let raw = RawOptions::new(&options).unwrap();
        assert_eq!((raw.raw.max_bytes, raw.raw.quality), (5, 0.5));
        assert_eq!(raw.raw.flags, u64::from(sys::ANIC_OPEN_IN_PLACE));
        assert_eq!(raw.raw.clip_count, 2);
        // SAFETY: the second of two names.
        let second = unsafe { core::ffi::CStr::from_ptr(*raw.raw.clips.add(1)) };
        assert_eq!(second, c"b");
        assert!(RawOptions::new(&OpenOptions::new().clips([vec![b'a', 0]])).is_err());
    }

    #[test]
    fn every_number_is_done_once() {
        let runs: [&Run; 4] = [
            &|_, _| {},
            &|count, body| (0..count).rev().for_each(body),
            &|count, body| (0..2 * count).for_each(|i| body(i / 2)),
            &|_, body| body(1 << 40),
        ];
        for run in runs {
            let done: Vec<AtomicUsize> = (0..7).map(|_| AtomicUsize::new(0)).collect();
            run_once(run, 7, &|i| {
                done[i].fetch_add(1, Ordering::Relaxed);
            });
            assert!(done.iter().all(|n| n.load(Ordering::Relaxed) == 1));
        }
    }

    #[test]
    fn callbacks_reach_their_closures() {
        let options = OpenOptions::new().threads(|count, body| (0..count).for_each(body)).progress(|done| {
            if done < 0.5 {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        });
        let raw = RawOptions::new(&options).unwrap().raw;
        let kept = RawOptions::new(&options).unwrap();
        let moved = alloc::boxed::Box::new(kept);
        unsafe extern "C" fn add(context: *mut c_void, i: usize) {
            // SAFETY: the test's number.
            unsafe { *context.cast::<usize>() += i };
        }
        let mut sum = 0_usize;
        // SAFETY: `moved` holds what the pointers lead to.
        unsafe {
            moved.raw.threads.run.unwrap()(moved.raw.threads.user, 5, Some(add), ptr::from_mut(&mut sum).cast());
            assert_eq!(moved.raw.progress.report.unwrap()(moved.raw.progress.user, 0.4), 0);
            assert_eq!(moved.raw.progress.report.unwrap()(moved.raw.progress.user, 0.6), 1);
        }
        assert_eq!(sum, 10);
        assert!(raw.threads.run.is_some());
    }
}
