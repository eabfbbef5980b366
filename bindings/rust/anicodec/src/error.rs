// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
use core::fmt;

use anicodec_sys as sys;

use crate::raw::english;

/// A result of this crate.
pub type Result<T, E = Error> = core::result::Result<T, E>;

macro_rules! statuses {
    ($($(#[$doc:meta])* $variant:ident = $number:ident,)*) => {
        /// The kind of fault, by the numbers of the format (spec/12).
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum Status {
            $($(#[$doc])* $variant,)*
            /// A number that this version does not know, of a newer encoder.
            Unknown(i32),
        }

        impl Status {
            /// The number, which is an exit status, too.
            pub fn code(self) -> i32 {
                match self {
                    $(Self::$variant => sys::$number,)*
                    Self::Unknown(code) => code,
                }
            }

            pub(crate) fn from_raw(code: i32) -> Self {
                match code {
                    $(sys::$number => Self::$variant,)*
                    code => Self::Unknown(code),
                }
            }

            #[cfg(test)]
            const ALL: &'static [Status] = &[$(Self::$variant,)*];
        }
    };
}

statuses! {
    /// An argument makes no sense.
    Argument = ANIC_E_ARGUMENT,
    /// The call is not possible now.
    State = ANIC_E_STATE,
    /// A buffer of the caller is too small.
    BufferSize = ANIC_E_BUFFER_SIZE,
    /// There is no such frame.
    FrameRange = ANIC_E_FRAME_RANGE,
    /// The mesh is not there at this time, the clip was not opened, or no clip has this name.
    Absent = ANIC_E_ABSENT,
    /// These bytes are no file of the format.
    Magic = ANIC_E_MAGIC,
    /// Another version of the format.
    Version = ANIC_E_VERSION,
    /// The file needs what this build lacks.
    Feature = ANIC_E_FEATURE,
    /// The file ends early.
    Truncated = ANIC_E_TRUNCATED,
    /// The header is malformed.
    Header = ANIC_E_HEADER,
    /// The checksum of header and table does not match.
    HeaderChecksum = ANIC_E_HEADER_CHECKSUM,
    /// A chunk lies outside the file or over another one.
    ChunkBounds = ANIC_E_CHUNK_BOUNDS,
    /// The checksum of a chunk does not match.
    ChunkChecksum = ANIC_E_CHUNK_CHECKSUM,
    /// A chunk is there twice.
    ChunkDuplicate = ANIC_E_CHUNK_DUPLICATE,
    /// A chunk is missing.
    ChunkMissing = ANIC_E_CHUNK_MISSING,
    /// A chunk that a decoder must know is unknown.
    ChunkUnknown = ANIC_E_CHUNK_UNKNOWN,
    /// Bytes follow the file.
    TrailingBytes = ANIC_E_TRAILING_BYTES,
    /// The size in the header is not that of the file.
    FileSize = ANIC_E_FILE_SIZE,
    /// A record is malformed.
    Record = ANIC_E_RECORD,
    /// Entropy-coded bytes are malformed.
    Entropy = ANIC_E_ENTROPY,
    /// A frame of Zstandard is malformed.
    Zstd = ANIC_E_ZSTD,
    /// Polygons are malformed.
    Topology = ANIC_E_TOPOLOGY,
    /// A corner is no vertex.
    IndexRange = ANIC_E_INDEX_RANGE,
    /// A quantizer is malformed.
    Quantizer = ANIC_E_QUANTIZER,
    /// A number is not finite.
    NonFinite = ANIC_E_NON_FINITE,
    /// A mesh by Draco is malformed.
    Draco = ANIC_E_DRACO,
    /// A segment contradicts its counts or its mesh.
    Segment = ANIC_E_SEGMENT,
    /// The decoded integers are not those of the encoder.
    Hash = ANIC_E_HASH,
    /// A file of a live stream follows one with other meshes.
    Meshes = ANIC_E_MESHES,
    /// A file of a live stream continues one that was lost, or was not opened in full.
    SegmentMissing = ANIC_E_SEGMENT_MISSING,
    /// More than the options allow.
    Limit = ANIC_E_LIMIT,
    /// There is no memory.
    Memory = ANIC_E_MEMORY,
    /// A callback could not read or write.
    Read = ANIC_E_READ,
    /// The progress callback stopped the call.
    Cancelled = ANIC_E_CANCELLED,
    /// A defect of the library.
    Internal = ANIC_E_INTERNAL,
}

impl fmt::Display for Status {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        // SAFETY: the text is static for any number.
        to.write_str(unsafe { english(sys::anic_get_status_text(self.code())) })
    }
}

/// Type of a chunk of a file: four characters.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Chunk([u8; 4]);

impl Chunk {
    /// The characters, which a damaged file need not have printable.
    pub fn as_bytes(&self) -> &[u8; 4] {
        &self.0
    }

    /// From the chunk that C gives: empty outside any chunk.
    fn from_raw(raw: [core::ffi::c_char; 8]) -> Option<Self> {
        let mut bytes = [0; 4];
        for (to, from) in bytes.iter_mut().zip(raw) {
            *to = from as u8;
        }
        (bytes != [0; 4]).then_some(Self(bytes))
    }
}

impl fmt::Display for Chunk {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "{}", self.0.escape_ascii())
    }
}

impl fmt::Debug for Chunk {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "\"{self}\"")
    }
}

/// A fault, and its place.
///
/// ```
/// use anicodec::{Clip, Error, Status};
///
/// let mut file = std::fs::read("examples/walk.anic")?;
/// file[300] ^= 1;
/// match Clip::open(&file) {
///     Err(Error::File { status: Status::ChunkChecksum, chunk: Some(chunk), offset, .. }) => {
///         println!("chunk {chunk} at byte {offset} is damaged");
///     }
///     other => panic!("{other:?}"),
/// }
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A file is refused, with the place of its fault.
    #[non_exhaustive]
    File {
        /// The kind of fault: no format, container or payload, or [`Status::Limit`].
        status: Status,
        /// The chunk; none outside any.
        chunk: Option<Chunk>,
        /// Byte in the file, as exact as is known.
        offset: u64,
        /// More of it in English, or nothing.
        detail: &'static str,
    },
    /// A call makes no sense, is not possible now, or has no memory.
    #[non_exhaustive]
    Call {
        /// The kind of fault.
        status: Status,
        /// More of it in English, or nothing.
        detail: &'static str,
    },
    /// The encoder refuses what it was given.
    #[cfg(feature = "encoder")]
    #[non_exhaustive]
    Encode {
        /// The kind of fault.
        status: Status,
        /// The place and the reason, in a line of English.
        text: alloc::string::String,
    },
}

impl Error {
    /// The kind of fault.
    pub fn status(&self) -> Status {
        match self {
            Self::File { status, .. } | Self::Call { status, .. } => *status,
            #[cfg(feature = "encoder")]
            Self::Encode { status, .. } => *status,
        }
    }

    /// An error that names no place.
    pub(crate) fn of(status: sys::anic_status) -> Self {
        let detail = "";
        let status = Status::from_raw(status);
        if is_of_files(status) {
            Self::File { status, chunk: None, offset: 0, detail }
        } else {
            Self::Call { status, detail }
        }
    }

    pub(crate) const ARGUMENT: Self = Self::Call { status: Status::Argument, detail: "" };
    pub(crate) const BUFFER_SIZE: Self = Self::Call { status: Status::BufferSize, detail: "" };

    pub(crate) fn of_failure(failure: &sys::anic_failure) -> Self {
        // SAFETY: `detail` is static.
        let detail = unsafe { english(failure.detail) };
        let status = Status::from_raw(failure.status);
        if is_of_files(status) {
            Self::File { status, chunk: Chunk::from_raw(failure.chunk), offset: failure.offset, detail }
        } else {
            Self::Call { status, detail }
        }
    }
}

/// Whether a file is to blame, of a caller's limits too.
fn is_of_files(status: Status) -> bool {
    (sys::ANIC_E_MAGIC..=sys::ANIC_E_LIMIT).contains(&status.code())
}

impl fmt::Display for Error {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        let detail = match self {
            Self::File { status, chunk, offset, detail } => {
                write!(to, "byte {offset}")?;
                if let Some(chunk) = chunk {
                    write!(to, ", chunk {chunk}")?;
                }
                write!(to, ": {status}")?;
                detail
            }
            Self::Call { status, detail } => {
                write!(to, "{status}")?;
                detail
            }
            #[cfg(feature = "encoder")]
            Self::Encode { text, .. } => return to.write_str(text),
        };
        if detail.is_empty() {
            Ok(())
        } else {
            write!(to, " ({detail})")
        }
    }
}

impl core::error::Error for Error {}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::format;

    #[test]
    fn statuses_keep_their_numbers() {
        for &status in Status::ALL {
            assert_eq!(Status::from_raw(status.code()), status);
        }
        assert_eq!(Status::from_raw(1234), Status::Unknown(1234));
        assert_eq!(Status::Unknown(1234).code(), 1234);
    }

    #[test]
    fn failures_name_their_place() {
        let mut failure: sys::anic_failure = crate::raw::init();
        failure.status = sys::ANIC_E_RECORD;
        for (to, from) in failure.chunk.iter_mut().zip(b"CL\nP") {
            *to = *from as core::ffi::c_char;
        }
        failure.offset = 77;
        failure.detail = c"too long".as_ptr();
        let error = Error::of_failure(&failure);
        let Error::File { status: Status::Record, chunk: Some(chunk), offset: 77, detail: "too long" } = error else {
            panic!("{error:?}");
        };
        assert_eq!((format!("{chunk}"), chunk.as_bytes()), ("CL\\nP".into(), b"CL\nP"));
        failure.status = sys::ANIC_E_MEMORY;
        assert_eq!(Error::of_failure(&failure), Error::Call { status: Status::Memory, detail: "too long" });
    }

    #[test]
    fn files_and_calls_are_told_apart() {
        assert!(matches!(Error::of(sys::ANIC_E_STATE), Error::Call { status: Status::State, .. }));
        assert!(matches!(Error::of(sys::ANIC_E_LIMIT), Error::File { status: Status::Limit, chunk: None, .. }));
        assert_eq!(Error::of(sys::ANIC_E_HASH).status(), Status::Hash);
    }
}
