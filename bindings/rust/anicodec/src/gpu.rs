// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! The basis of a clip for shaders: uploaded once, played by a handful of weights a frame.
use alloc::vec;
use alloc::vec::Vec;
use core::mem::size_of_val;

use anicodec_sys as sys;

use crate::clip::Clip;
use crate::context::Shown;
use crate::error::{Error, Result};
use crate::raw::{check, enumeration, fill, init, slice};

enumeration! {
    /// How the basis of a segment was found.
    BasisKind: Keyframes {
        /// Frames of the clip.
        Keyframes = ANIC_BASIS_KEYFRAMES,
        /// Shapes, by principal components.
        Eigenshapes = ANIC_BASIS_EIGENSHAPES,
        /// Trajectories, by principal components.
        Eigentrajectories = ANIC_BASIS_EIGENTRAJECTORIES,
    }
}

enumeration! {
    /// How positions come from a basis.
    Reconstruction: Linear {
        /// A linear combination.
        Linear = ANIC_RECONSTRUCTION_LINEAR,
        /// Multi-scale geometry interpolation between key-frames, by the CPU.
        Msgi = ANIC_RECONSTRUCTION_MSGI,
    }
}

/// Vertices or values that a basis moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// The positions of a mesh.
    Positions,
    /// Three components of an attribute, or fewer, of its elements in place of vertices. The value of a part is to be added
    /// to [`Attribute::values`](crate::Attribute::values).
    Attribute {
        /// Its number.
        attribute: u32,
        /// The first of the components.
        first_component: u32,
    },
}

/// The basis of a segment: [`Clip::basis`]. With b = v / 16 and i = v % 16:
///
/// - pose(v)\[c\] = `pose[(b * 3 + c) * 16 + i]`
/// - basis(j, v)\[c\] = `wide[((b * wide_components + j) * channels + c) * 16 + i]` for j below `wide_components`
/// - basis(j, v)\[c\] = `narrow[((b * n + j - wide_components) * channels + c) * 16 + i]` for the other j, with
///   n = `components - wide_components`
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Basis<'a> {
    /// How it was found.
    pub kind: BasisKind,
    /// How positions come from it.
    pub reconstruction: Reconstruction,
    /// The quantity that it moves.
    pub target: Target,
    /// The mesh that it is of.
    pub mesh: u32,
    /// Its first frame in the file.
    pub first_frame: u32,
    /// How many frames it has.
    pub frame_count: u32,
    /// Vertices, or elements of an attribute.
    pub vertex_count: u32,
    /// How many components there are.
    pub components: u32,
    /// The first of them, as `i32`.
    pub wide_components: u32,
    /// 3: basis(j, v) is a vector, with one weight; 1: it is a number, with a weight for each of x, y, z.
    pub channels: u32,
    /// Weights of a component: 1 for vectors, 3 for numbers.
    pub weight_channels: u32,
    /// The origin of key-frames, added to every vertex before the motion.
    pub origin: [f32; 3],
    /// Empty: none.
    pub pose: &'a [f32],
    /// Wide components.
    pub wide: &'a [i32],
    /// The others.
    pub narrow: &'a [i16],
    /// Regions of the surface, each with weights and a pose_map of its own; 1: none.
    pub regions: u32,
    /// Region of each vertex; empty: all are of region 0.
    pub vertex_region: &'a [u8],
}

enumeration! {
    /// Textures that hold the basis of a segment for shaders, of four numbers a texel.
    Texture: Pose {
        /// `f32`: x, y, z, region.
        Pose = ANIC_TEXTURE_POSE,
        /// `i32`.
        Wide = ANIC_TEXTURE_WIDE,
        /// `i16`.
        Narrow = ANIC_TEXTURE_NARROW,
    }
}

/// How a basis lies in textures: a layer is `rows` rows of `width` texels, a texel for each vertex; layers lie below one
/// another. `gpu.h` describes them with `anic_texture_layout`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct TextureLayout {
    /// Texels of a row.
    pub width: u32,
    /// Rows of a layer: 1 unless the mesh has more vertices than a row may have texels.
    pub rows: u32,
    /// Rows of the texture; 0: there is none.
    pub pose_height: u32,
    /// As above.
    pub wide_height: u32,
    /// As above.
    pub narrow_height: u32,
    /// Numbers that [`Shown::state`] gives.
    pub state_floats: u32,
    /// States of so many regions follow one another in them.
    pub regions: u32,
}

impl TextureLayout {
    /// Width and height of a texture, and bytes of one without a gap between its rows.
    pub fn size(&self, texture: Texture) -> (u32, u32, usize) {
        let (height, texel) = match texture {
            Texture::Pose => (self.pose_height, 16),
            Texture::Wide => (self.wide_height, 16),
            Texture::Narrow => (self.narrow_height, 8),
        };
        (self.width, height, self.width as usize * height as usize * texel)
    }
}

impl Clip {
    /// The basis of a segment, a number below [`Info::segment_count`](crate::Info::segment_count);
    /// [`Status::State`](crate::Status::State) where it has not arrived yet.
    pub fn basis(&self, segment: u32) -> Result<Basis<'_>> {
        let raw: sys::anic_basis = fill(|out| {
            // SAFETY: the asset is open.
            unsafe { sys::anic_get_basis(self.raw(), segment, out) }
        })?;
        let target = match raw.target {
            sys::ANIC_TARGET_ATTRIBUTE => {
                Target::Attribute { attribute: raw.attribute, first_component: raw.first_component }
            }
            _ => Target::Positions,
        };
        // SAFETY: the arrays belong to the asset.
        Ok(unsafe {
            Basis {
                kind: BasisKind::from_raw(raw.kind),
                reconstruction: Reconstruction::from_raw(raw.reconstruction),
                target,
                mesh: raw.mesh,
                first_frame: raw.first_frame,
                frame_count: raw.frame_count,
                vertex_count: raw.vertex_count,
                components: raw.components,
                wide_components: raw.wide_components,
                channels: raw.channels,
                weight_channels: raw.weight_channels,
                origin: raw.origin,
                pose: slice(raw.pose, raw.pose_count),
                wide: slice(raw.wide, raw.wide_count),
                narrow: slice(raw.narrow, raw.narrow_count),
                regions: raw.regions,
                vertex_region: slice(raw.vertex_region, raw.vertex_count as usize),
            }
        })
    }

    /// Finds the layout that wastes least of textures with at most `max_size` texels in width and height;
    /// [`Status::Limit`](crate::Status::Limit) where none holds the basis, [`Status::State`](crate::Status::State) of
    /// geometry interpolation.
    pub fn texture_layout(&self, segment: u32, max_size: u32) -> Result<TextureLayout> {
        let raw: sys::anic_texture_layout = fill(|out| {
            // SAFETY: the asset is open.
            unsafe { sys::anic_get_texture_layout(self.raw(), segment, max_size, out) }
        })?;
        Ok(TextureLayout {
            width: raw.width,
            rows: raw.rows,
            pose_height: raw.pose_height,
            wide_height: raw.wide_height,
            narrow_height: raw.narrow_height,
            state_floats: raw.state_floats,
            regions: raw.regions,
        })
    }

    /// Writes a texture, ready to be uploaded. `row_bytes`: from a row to the next, as the graphics interface wants it; 0:
    /// packed.
    ///
    /// ```
    /// use anicodec::{Clip, Texture, When};
    ///
    /// let clip = Clip::open(std::fs::read("examples/walk.anic")?)?;
    /// let layout = clip.texture_layout(0, 8192)?;
    /// let (_width, _height, bytes) = layout.size(Texture::Pose);
    /// let mut pose = vec![0; bytes];
    /// clip.write_texture(0, Texture::Pose, &layout, 0, &mut pose)?;
    /// let mut dancer = clip.context()?;
    /// dancer.seek_frame(3)?;
    /// let weights = dancer.shown(0, When::Current).state(0)?; // all that a frame uploads
    /// assert_eq!(weights.len(), layout.state_floats as usize);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write_texture(
        &self,
        segment: u32,
        texture: Texture,
        layout: &TextureLayout,
        row_bytes: usize,
        out: &mut [u8],
    ) -> Result<()> {
        let mut raw: sys::anic_texture_layout = init();
        raw.width = layout.width;
        raw.rows = layout.rows;
        raw.pose_height = layout.pose_height;
        raw.wide_height = layout.wide_height;
        raw.narrow_height = layout.narrow_height;
        raw.state_floats = layout.state_floats;
        raw.regions = layout.regions;
        let to = out.as_mut_ptr().cast();
        // SAFETY: C writes out.len() bytes at most, and checks the layout.
        check(unsafe { sys::anic_write_texture(self.raw(), segment, texture.raw(), &raw, row_bytes, to, out.len()) })
    }
}

/// Moves one vertex in one frame, after everything else.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Correction {
    /// The vertex.
    pub vertex: u32,
    /// Added to its position.
    pub delta: [f32; 3],
}

/// Data that a shader needs for one time, beside the basis of a segment:
///
/// - x = pose_map * (pose(v), 1) + sum over j of `weights[j * weight_channels + c]` * basis(j, v)\[c\]
/// - x = motion * (x + origin, 1)
/// - x = x + delta of the corrections of v, which are few and ascending by vertex
///
/// If the basis has regions, r = `vertex_region[v]` has a pose_map and weights of its own. Matrices are 3 x 4, row-major.
/// Parts of geometry interpolation have neither weights nor pose maps: the CPU writes their positions.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Part<'a> {
    /// The segment whose basis it is of.
    pub segment: u32,
    /// The position is the sum of share * x over the parts.
    pub share: f32,
    /// How many components are to be used: all unless [`Context::set_quality`](crate::Context::set_quality) said otherwise.
    pub components: u32,
    /// The weights of region 0, then of the others.
    pub weights: &'a [f32],
    /// The map of each region; empty: the basis has no pose.
    pub pose_maps: &'a [[f32; 12]],
    /// The motion of the whole.
    pub motion: [f32; 12],
    /// Single vertices.
    pub corrections: &'a [Correction],
}

impl<'a> Shown<'a> {
    /// The parts of the mesh for the GPU: one, unless the time lies between two segments; four at most.
    pub fn parts(&self) -> Result<Vec<Part<'a>>> {
        let raw = fill(|out| {
            // SAFETY: the context lives.
            unsafe { sys::anic_get_parts(self.context.raw(), self.mesh, self.when.raw(), out) }
        })?;
        self.parts_of(&raw)
    }

    /// The parts of three components of an attribute, from a multiple of three on: their sum is to be added to the value in
    /// the first frame. None: the value is that of the first frame.
    pub fn attribute_parts(&self, attribute: u32, first_component: u32) -> Result<Vec<Part<'a>>> {
        let raw = fill(|out| {
            // SAFETY: the context lives.
            unsafe {
                sys::anic_get_attribute_parts(
                    self.context.raw(),
                    self.mesh,
                    attribute,
                    first_component,
                    self.when.raw(),
                    out,
                )
            }
        })?;
        self.parts_of(&raw)
    }

    fn parts_of(&self, raw: &sys::anic_parts) -> Result<Vec<Part<'a>>> {
        let count = raw.count as usize;
        let parts = raw.parts.iter().zip(&raw.components).zip(&raw.pose_maps).take(count);
        parts
            .map(|((part, &components), &pose_maps)| {
                let basis = self.context.clip().basis(part.segment)?;
                let (mut weights, mut maps) = (0, 0);
                if basis.reconstruction == Reconstruction::Linear {
                    weights = basis.regions as usize * basis.components as usize * basis.weight_channels as usize;
                    maps = basis.regions as usize;
                }
                // SAFETY: the arrays belong to the context until it is sought in, which the borrow of it forbids. A
                // Correction is laid out as C's.
                Ok(unsafe {
                    Part {
                        segment: part.segment,
                        share: part.share,
                        components,
                        weights: slice(part.weights, weights),
                        pose_maps: slice(pose_maps.cast(), maps),
                        motion: part.motion,
                        corrections: slice(part.corrections.cast(), part.correction_count as usize),
                    }
                })
            })
            .collect()
    }

    /// The numbers that a shader needs for one part, ready to be uploaded for each instance: `gpu.h` tells its layout with
    /// `anic_write_state`.
    pub fn state(&self, part: u32) -> Result<Vec<f32>> {
        let parts = self.parts()?;
        let found = parts.get(part as usize).ok_or(Error::ARGUMENT)?;
        let size = self.context.clip().texture_layout(found.segment, u32::MAX)?.state_floats;
        let mut out = vec![0.0; size as usize];
        self.state_into(part, &mut out)?;
        Ok(out)
    }

    /// The same into a buffer of [`TextureLayout::state_floats`] numbers; it allocates nothing.
    pub fn state_into(&self, part: u32, out: &mut [f32]) -> Result<()> {
        let size = size_of_val(out);
        // SAFETY: C writes `size` bytes at most.
        check(unsafe {
            sys::anic_write_state(self.context.raw(), self.mesh, self.when.raw(), part, out.as_mut_ptr(), size)
        })
    }
}
