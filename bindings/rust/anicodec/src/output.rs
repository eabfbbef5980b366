// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
use core::marker::PhantomData;
use core::mem::size_of_val;

use anicodec_sys as sys;

use crate::raw::{enumeration, init};

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bounds {
    /// Least x, y, z.
    pub min: [f32; 3],
    /// Largest x, y, z.
    pub max: [f32; 3],
}

/// A point of a mesh's surface: vertices of a triangle, counter-clockwise seen from its front, and barycentric coordinates
/// in it, whose sum is 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfacePoint {
    /// The vertices.
    pub vertices: [u32; 3],
    /// One for each vertex.
    pub weights: [f32; 3],
}

/// Axes at a point of the surface, of length 1; the third one is normal x tangent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceFrame {
    /// The point.
    pub position: [f32; 3],
    /// The triangle's, on its front.
    pub normal: [f32; 3],
    /// From the triangle's first vertex to the second one.
    pub tangent: [f32; 3],
}

enumeration! {
    /// A side of triangles, whose corners run counter-clockwise on the front.
    Side: Any {
        /// Front or back.
        Any = ANIC_SIDE_ANY,
        /// The front.
        Front = ANIC_SIDE_FRONT,
        /// The back.
        Back = ANIC_SIDE_BACK,
    }
}

/// A ray in the space of the positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Its begin.
    pub origin: [f32; 3],
    /// Any length but 0.
    pub direction: [f32; 3],
    /// The distance that still counts, in lengths of the direction.
    pub farthest: f32,
    /// The side of triangles that count.
    pub side: Side,
}

impl Ray {
    /// A ray without an end, which meets both sides.
    pub fn new(origin: [f32; 3], direction: [f32; 3]) -> Self {
        Self { origin, direction, farthest: f32::INFINITY, side: Side::Any }
    }
}

/// The first point of the surface on a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// It, for [`Shown::surface_frame`](crate::Shown::surface_frame).
    pub point: SurfacePoint,
    /// From the origin, in lengths of the direction.
    pub distance: f32,
    /// Its number in the list of triangles.
    pub triangle: u32,
    /// The one that the ray meets.
    pub side: Side,
}

enumeration! {
    /// How a position or normal is stored, in the machine's byte order. Formats of four components have 1 as the last one.
    /// The 16-bit formats store t = (x - offset) / scale: see [`Output::scaled`].
    Format: F32x3 {
        /// Three `f32`.
        F32x3 = ANIC_FORMAT_FLOAT32X3,
        /// Four `f32`.
        F32x4 = ANIC_FORMAT_FLOAT32X4,
        /// Three IEEE binary16, rounded to nearest.
        F16x3 = ANIC_FORMAT_FLOAT16X3,
        /// Four of them.
        F16x4 = ANIC_FORMAT_FLOAT16X4,
        /// Three `u16`, round(65535 t), t clamped to 0 to 1.
        Unorm16x3 = ANIC_FORMAT_UNORM16X3,
        /// Four of them.
        Unorm16x4 = ANIC_FORMAT_UNORM16X4,
        /// Three `i16`, round(32767 t), t clamped to -1 to 1.
        Snorm16x3 = ANIC_FORMAT_SNORM16X3,
        /// Four of them.
        Snorm16x4 = ANIC_FORMAT_SNORM16X4,
    }
}

/// The place for positions or normals in a vertex buffer of any stride and format. Every component is written once, at
/// ascending addresses, and nothing is read; bytes between elements stay untouched.
///
/// ```
/// use anicodec::{Clip, Format, Output, When};
///
/// const STRIDE: usize = 32;
/// let clip = Clip::open(std::fs::read("examples/walk.anic")?)?;
/// let count = clip.mesh(0)?.vertex_count;
/// let mut vertices = vec![0; STRIDE * count as usize];
/// let mut dancer = clip.context()?;
/// dancer.seek_frame(3)?;
/// let shown = dancer.shown(0, When::Current);
/// let bounds = shown.bounds()?;
/// let out = Output::new(&mut vertices, Format::Unorm16x4).stride(STRIDE).within(&bounds);
/// shown.write_positions(0..count, out)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Output<'a> {
    pub(crate) raw: sys::anic_output,
    bytes: PhantomData<&'a mut [u8]>,
}

impl<'a> Output<'a> {
    /// A place from the first byte on, packed.
    pub fn new(bytes: &'a mut [u8], format: Format) -> Self {
        let mut raw: sys::anic_output = init();
        raw.data = bytes.as_mut_ptr().cast();
        raw.size = bytes.len();
        raw.format = format.raw();
        Self { raw, bytes: PhantomData }
    }

    /// Packed points.
    pub fn points(points: &'a mut [[f32; 3]]) -> Self {
        let mut raw: sys::anic_output = init();
        raw.size = size_of_val(points);
        raw.data = points.as_mut_ptr().cast();
        Self { raw, bytes: PhantomData }
    }

    /// Bytes from an element to the next; 0: packed.
    pub fn stride(mut self, bytes: usize) -> Self {
        self.raw.stride = bytes;
        self
    }

    /// Offset and scale of the 16-bit formats; a scale of 0 counts as 1.
    pub fn scaled(mut self, offset: [f32; 3], scale: [f32; 3]) -> Self {
        self.raw.offset = offset;
        self.raw.scale = scale;
        self
    }

    /// Offset and scale that fit a box.
    pub fn within(self, bounds: &Bounds) -> Self {
        let centred = matches!(self.raw.format, sys::ANIC_FORMAT_SNORM16X3 | sys::ANIC_FORMAT_SNORM16X4);
        let share = if centred { 0.5 } else { 1.0 };
        let (mut offset, mut scale) = (bounds.min, [0.0; 3]);
        for c in 0..3 {
            scale[c] = (bounds.max[c] - bounds.min[c]) * share;
            if centred {
                offset[c] += scale[c];
            }
        }
        self.scaled(offset, scale)
    }

    /// Offset and scale, which give a shader the values back: x = offset + scale * t.
    pub fn offset_and_scale(&self) -> ([f32; 3], [f32; 3]) {
        (self.raw.offset, self.raw.scale)
    }
}

enumeration! {
    /// How a value of an attribute is stored, in the machine's byte order.
    ValueFormat: F32 {
        /// `f32`.
        F32 = ANIC_VALUE_FLOAT32,
        /// IEEE binary16, rounded to nearest.
        F16 = ANIC_VALUE_FLOAT16,
        /// `u8`, round(255 x), x clamped to 0 to 1.
        Unorm8 = ANIC_VALUE_UNORM8,
        /// `u16`, round(65535 x), x clamped to 0 to 1.
        Unorm16 = ANIC_VALUE_UNORM16,
    }
}

/// The place for values of an attribute, written as an [`Output`] is.
pub struct ValueOutput<'a> {
    pub(crate) raw: sys::anic_value_output,
    bytes: PhantomData<&'a mut [u8]>,
}

impl<'a> ValueOutput<'a> {
    /// A place from the first byte on, packed.
    pub fn new(bytes: &'a mut [u8], format: ValueFormat) -> Self {
        let mut raw: sys::anic_value_output = init();
        raw.data = bytes.as_mut_ptr().cast();
        raw.size = bytes.len();
        raw.format = format.raw();
        Self { raw, bytes: PhantomData }
    }

    /// Packed numbers.
    pub fn values(values: &'a mut [f32]) -> Self {
        let mut raw: sys::anic_value_output = init();
        raw.size = size_of_val(values);
        raw.data = values.as_mut_ptr().cast();
        Self { raw, bytes: PhantomData }
    }

    /// Bytes from an element to the next; 0: packed.
    pub fn stride(mut self, bytes: usize) -> Self {
        self.raw.stride = bytes;
        self
    }

    /// Numbers to be written of each element, at most 16; 0: as many as the attribute has. One that it does not have is 0,
    /// or 1 if it is the fourth.
    pub fn components(mut self, count: u32) -> Self {
        self.raw.components = count;
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outputs_fit_a_box() {
        let bounds = Bounds { min: [-1.0, 0.0, 2.0], max: [3.0, 0.0, 4.0] };
        let mut bytes = [0; 8];
        let unsigned = Output::new(&mut bytes, Format::Unorm16x3).within(&bounds);
        assert_eq!(unsigned.offset_and_scale(), ([-1.0, 0.0, 2.0], [4.0, 0.0, 2.0]));
        let signed = Output::new(&mut bytes, Format::Snorm16x4).within(&bounds).stride(12);
        assert_eq!(signed.offset_and_scale(), ([1.0, 0.0, 3.0], [2.0, 0.0, 1.0]));
        assert_eq!((signed.raw.size, signed.raw.stride, signed.raw.format), (8, 12, sys::ANIC_FORMAT_SNORM16X4));
    }

    #[test]
    fn slices_give_their_bytes() {
        let mut points = [[0.0; 3]; 5];
        assert_eq!(Output::points(&mut points).raw.size, 60);
        let mut values = [0.0; 5];
        let out = ValueOutput::values(&mut values).components(4);
        assert_eq!((out.raw.size, out.raw.components, out.raw.format), (20, 4, sys::ANIC_VALUE_FLOAT32));
    }
}
