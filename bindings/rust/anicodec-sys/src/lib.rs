// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! The C interface of anicodec, as `anicodec.h` declares and describes it; the crate `anicodec` is a safe one over it.
//!
//! A struct that begins with `struct_size` is to be zeroed, and `struct_size` set to its size, before a function gets it.
//!
//! ```
//! let version = unsafe { anicodec_sys::anic_get_version() };
//! assert_eq!(version >> 16, anicodec_sys::ANIC_VERSION_MAJOR);
//! ```
//!
//! The decoder's C++ source is in this package and compiled by its build script, which wants GCC or Clang. The folder of its
//! headers is in `DEP_ANICODEC_INCLUDE` for build scripts of crates that depend on this one.
//!
//! | feature | brings |
//! |---|---|
//! | `draco` | key-frames that Draco coded, by the system's Draco. Without it such files are refused with `ANIC_E_FEATURE` |
//! | `encoder` | the functions of `encode.h`, by the installed `libanicodec_encoder`, which pkg-config finds |
#![no_std]

// The symbols of zstd, which the decoder calls.
use zstd_sys as _;

mod decoder;
#[cfg(feature = "encoder")]
mod encoder;

pub use decoder::*;
#[cfg(feature = "encoder")]
pub use encoder::*;
