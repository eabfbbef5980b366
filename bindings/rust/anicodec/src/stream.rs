// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
use core::fmt;
use core::ptr::{self, NonNull};

use anicodec_sys as sys;

use crate::clip::Clip;
use crate::error::{Error, Result};
use crate::options::{OpenOptions, RawOptions};
use crate::raw::{check, fill, init};

/// A file that arrives from the front, piece by piece; of a live stream, one file after the other.
///
/// ```
/// use anicodec::Stream;
///
/// let file = std::fs::read("examples/walk.anic")?;
/// let mut stream = Stream::new()?;
/// let mut clip = None;
/// for piece in file.chunks(100) {
///     stream.push(piece)?;
///     if stream.info().playable {
///         clip = Some(stream.open()?); // coarse at first; clips that were opened before stay as they are
///     }
/// }
/// assert!(stream.info().complete && !clip.unwrap().info().partial);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Stream {
    raw: NonNull<sys::anic_stream>,
    /// The library reads them until the stream goes.
    _options: RawOptions,
}

// SAFETY: a stream is bound to no thread.
unsafe impl Send for Stream {}
// SAFETY: only functions of a const anic_stream take &self.
unsafe impl Sync for Stream {}

impl Drop for Stream {
    fn drop(&mut self) {
        // SAFETY: it lives until here; clips of it live on.
        unsafe { sys::anic_destroy_stream(self.raw.as_ptr()) }
    }
}

impl Stream {
    /// A stream whose clips open in the default way: [`OpenOptions::stream`] makes others.
    pub fn new() -> Result<Self> {
        OpenOptions::new().stream()
    }

    pub(crate) fn with(options: RawOptions) -> Result<Self> {
        let mut raw = ptr::null_mut();
        // SAFETY: the options are copied; what they lead to is kept.
        check(unsafe { sys::anic_create_stream(&options.raw, &mut raw) })?;
        let raw = NonNull::new(raw).ok_or(Error::of(sys::ANIC_E_INTERNAL))?;
        Ok(Self { raw, _options: options })
    }

    /// Takes the next bytes, and checks everything as soon as it is there: a stream that cannot become a good file fails at
    /// once and stays failed. Bytes of the next file of a live stream wait until [`advance`](Self::advance).
    pub fn push(&mut self, bytes: &[u8]) -> Result<()> {
        // SAFETY: &mut self; the bytes are copied.
        let status = unsafe { sys::anic_push_bytes(self.raw.as_ptr(), bytes.as_ptr().cast(), bytes.len()) };
        self.check(status)
    }

    /// Turns to the next file of a live stream. Open the file at hand before: files of a stream that learns continue those
    /// before them, and after one that was lost, or not opened when it was complete, the others are refused with
    /// [`Status::SegmentMissing`](crate::Status::SegmentMissing) up to the next that begins anew.
    pub fn advance(&mut self) -> Result<()> {
        // SAFETY: &mut self.
        let status = unsafe { sys::anic_advance_stream(self.raw.as_ptr()) };
        self.check(status)
    }

    /// Opens what has arrived, at the cost of decoding all of it, the meshes once; [`Status::State`](crate::Status::State)
    /// where nothing is playable yet. The clip of a complete stream is that of the whole file.
    pub fn open(&mut self) -> Result<Clip> {
        Clip::opened(|out, failure| {
            // SAFETY: &mut self.
            unsafe { sys::anic_open_asset_from_stream(self.raw.as_ptr(), out, failure) }
        })
    }

    /// How much has arrived.
    pub fn info(&self) -> StreamInfo {
        let raw = fill(|out| {
            // SAFETY: the stream lives.
            unsafe { sys::anic_get_stream_info(self.raw.as_ptr(), out) }
        });
        StreamInfo::from_raw(&raw.unwrap_or_else(|_| init()))
    }

    /// The fault of the bytes that came; none if there is none.
    pub fn failure(&self) -> Option<Error> {
        let raw: Result<sys::anic_failure> = fill(|out| {
            // SAFETY: the stream lives.
            unsafe { sys::anic_get_stream_failure(self.raw.as_ptr(), out) }
        });
        match raw {
            Ok(raw) if raw.status == sys::ANIC_OK => None,
            Ok(raw) => Some(Error::of_failure(&raw)),
            Err(error) => Some(error),
        }
    }

    /// The error of a status, with its place where the stream knows it.
    fn check(&self, status: sys::anic_status) -> Result<()> {
        check(status).map_err(|error| self.failure().filter(|f| f.status() == error.status()).unwrap_or(error))
    }
}

impl fmt::Debug for Stream {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.info(), to)
    }
}

/// How much of a file has arrived, in a live stream of the one at hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct StreamInfo {
    /// Bytes of the file that are there.
    pub received_bytes: u64,
    /// 0 while the header is not there.
    pub file_bytes: u64,
    /// 0 while the head is not there.
    pub segment_count: u32,
    /// Segments that can be opened, coarsely at least.
    pub playable_segments: u32,
    /// Chunks with components of the bases of all segments.
    pub layers: u32,
    /// Layers that are there.
    pub arrived_layers: u32,
    /// [`Stream::open`] gives a clip that plays at least one segment of positions.
    pub playable: bool,
    /// The whole file is there.
    pub complete: bool,
    /// In a live stream, from 0 on.
    pub file_number: u32,
    /// Bytes of the next files of a live stream.
    pub waiting_bytes: u64,
}

impl StreamInfo {
    fn from_raw(raw: &sys::anic_stream_info) -> Self {
        Self {
            received_bytes: raw.received_bytes,
            file_bytes: raw.file_bytes,
            segment_count: raw.segment_count,
            playable_segments: raw.playable_segments,
            layers: raw.layers,
            arrived_layers: raw.arrived_layers,
            playable: raw.playable != 0,
            complete: raw.complete != 0,
            file_number: raw.file_number,
            waiting_bytes: raw.waiting_bytes,
        }
    }
}
