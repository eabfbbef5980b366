// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! Structs and strings as the C interface wants them.
use core::ffi::{c_char, CStr};
use core::mem::size_of;

use anicodec_sys as sys;

use crate::error::{Error, Result};
use crate::text::Text;

/// A struct of C that begins with its size, and may be all zero besides.
///
/// # Safety
/// All fields are numbers, pointers or optional functions.
pub(crate) unsafe trait Versioned: Sized {
    fn set_struct_size(&mut self, size: usize);
}

macro_rules! versioned {
    ($($name:ident)*) => {$(
        unsafe impl Versioned for sys::$name {
            fn set_struct_size(&mut self, size: usize) {
                self.struct_size = size;
            }
        }
    )*};
}

versioned! {
    anic_failure anic_options anic_requirements anic_asset_info anic_clip anic_event anic_mesh anic_polygons anic_attribute
    anic_material anic_root_motion anic_output anic_value_output anic_normal_plan_options anic_render_plan_options
    anic_render_info anic_basis anic_parts anic_texture_layout anic_stream_info anic_ray
}

#[cfg(feature = "encoder")]
versioned! {
    anic_source_clip anic_source_mesh anic_source_attribute anic_encode_options anic_encoding
    anic_live_options anic_live_frame anic_live_piece anic_live_info
}

/// A struct with its size, and 0 in every other field.
pub(crate) fn init<T: Versioned>() -> T {
    // SAFETY: Versioned says that all zero is a value of it.
    let mut value: T = unsafe { core::mem::zeroed() };
    value.set_struct_size(size_of::<T>());
    value
}

pub(crate) fn check(status: sys::anic_status) -> Result<()> {
    if status == sys::ANIC_OK {
        Ok(())
    } else {
        Err(Error::of(status))
    }
}

/// Fills a struct by a function that gets its address.
pub(crate) fn fill<T: Versioned>(get: impl FnOnce(*mut T) -> sys::anic_status) -> Result<T> {
    let mut value = init();
    check(get(&mut value))?;
    Ok(value)
}

/// # Safety
/// `from` is NULL or the address of `count` elements that live as long as the result.
pub(crate) unsafe fn slice<'a, T>(from: *const T, count: usize) -> &'a [T] {
    if from.is_null() || count == 0 {
        return &[];
    }
    // SAFETY: the caller's.
    unsafe { core::slice::from_raw_parts(from, count) }
}

/// # Safety
/// `from` is NULL or a text ended by 0 that lives as long as the result.
pub(crate) unsafe fn text<'a>(from: *const c_char) -> Text<'a> {
    if from.is_null() {
        return Text(b"");
    }
    // SAFETY: the caller's.
    Text(unsafe { CStr::from_ptr(from) }.to_bytes())
}

/// English text of the library. It is ASCII.
///
/// # Safety
/// `from` is NULL or a text ended by 0 that lives for good.
pub(crate) unsafe fn english(from: *const c_char) -> &'static str {
    // SAFETY: the caller's.
    core::str::from_utf8(unsafe { text(from) }.as_bytes()).unwrap_or_default()
}

/// An enumeration with the numbers of C.
macro_rules! enumeration {
    ($(#[$doc:meta])* $name:ident: $default:ident { $($(#[$variant_doc:meta])* $variant:ident = $number:ident,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $name {
            $($(#[$variant_doc])* $variant,)*
        }

        impl Default for $name {
            fn default() -> Self {
                Self::$default
            }
        }

        #[allow(dead_code, reason = "some go to C alone, some come from there")]
        impl $name {
            pub(crate) fn from_raw(number: i32) -> Self {
                match number {
                    $(anicodec_sys::$number => Self::$variant,)*
                    _ => Self::$default,
                }
            }

            pub(crate) fn raw(self) -> i32 {
                match self {
                    $(Self::$variant => anicodec_sys::$number,)*
                }
            }
        }
    };
}
pub(crate) use enumeration;
