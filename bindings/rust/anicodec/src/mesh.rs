// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
use alloc::vec;
use alloc::vec::Vec;
use core::fmt;
use core::mem::size_of_val;
use core::ops::Range;
use core::ptr;

use anicodec_sys as sys;

use crate::clip::Clip;
use crate::error::{Error, Result, Status};
use crate::plans::{NormalOptions, NormalPlan, RenderOptions, RenderPlan};
use crate::raw::{check, enumeration, fill, init, slice, text};
use crate::text::Text;

/// A mesh of a clip: its faces and attributes.
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct Mesh<'a> {
    clip: &'a Clip,
    /// Its number.
    pub number: u32,
    /// As in the source.
    pub name: Text<'a>,
    /// Vertices of the source, each once.
    pub vertex_count: u32,
    /// Distinct vertices: the others are copies that move along.
    pub coded_vertex_count: u32,
    /// Polygons as in the source.
    pub polygon_count: u32,
    /// The corners of all polygons.
    pub corner_count: u32,
    /// After [`indices`](Self::indices) has cut the polygons.
    pub triangle_count: u32,
    /// How many attributes it has.
    pub attribute_count: u32,
}

impl<'a> Mesh<'a> {
    pub(crate) fn new(clip: &'a Clip, number: u32) -> Result<Self> {
        let raw: sys::anic_mesh = fill(|out| {
            // SAFETY: the asset is open.
            unsafe { sys::anic_get_mesh(clip.raw(), number, out) }
        })?;
        Ok(Self {
            clip,
            number,
            // SAFETY: strings belong to the asset.
            name: unsafe { text(raw.name) },
            vertex_count: raw.vertex_count,
            coded_vertex_count: raw.coded_vertex_count,
            polygon_count: raw.polygon_count,
            corner_count: raw.corner_count,
            triangle_count: raw.triangle_count,
            attribute_count: raw.attribute_count,
        })
    }

    /// Polygons as in the source.
    pub fn polygons(&self) -> Polygons<'a> {
        let raw: Result<sys::anic_polygons> = fill(|out| {
            // SAFETY: the asset is open.
            unsafe { sys::anic_get_polygons(self.clip.raw(), self.number, out) }
        });
        let raw = raw.unwrap_or_else(|_| init());
        if raw.polygon_count == 0 {
            return Polygons { offsets: &[0], corners: &[] };
        }
        // SAFETY: the arrays belong to the asset; corners end where the last polygon does.
        unsafe {
            let offsets = slice(raw.offsets, raw.polygon_count as usize + 1);
            Polygons { offsets, corners: slice(raw.corners, offsets.last().map_or(0, |&end| end as usize)) }
        }
    }

    /// Vertices of all triangles, counter-clockwise seen from the front: every polygon in order, as a fan from its first
    /// corner or, where it is concave in the first frame that shows the mesh, as triangles that cover it once.
    pub fn indices(&self) -> Result<Vec<u32>> {
        let mut out = vec![0; 3 * self.triangle_count as usize];
        self.indices_into(&mut out)?;
        Ok(out)
    }

    /// The same into a buffer of three numbers for each triangle: `u32`, or `u16` of meshes with at most 65,536 vertices.
    pub fn indices_into<I: Index>(&self, out: &mut [I]) -> Result<()> {
        let size = size_of_val(out);
        // SAFETY: C writes `size` bytes at most, and any bytes are an Index.
        check(unsafe { sys::anic_write_indices(self.clip.raw(), self.number, I::BYTES, out.as_mut_ptr().cast(), size) })
    }

    /// The coded vertex that each vertex is a copy of: vertices with the same number have the same position in every frame.
    pub fn coded_vertices(&self) -> &'a [u32] {
        let mut from = ptr::null();
        // SAFETY: the asset is open.
        let status = unsafe { sys::anic_get_coded_vertices(self.clip.raw(), self.number, &mut from) };
        // SAFETY: the array belongs to the asset and has a number for each vertex.
        unsafe { slice(from, if status == sys::ANIC_OK { self.vertex_count as usize } else { 0 }) }
    }

    /// Texture coordinates, colours, materials and the like.
    pub fn attributes(&self) -> impl Iterator<Item = Attribute<'a>> {
        let mesh = *self;
        (0..self.attribute_count).filter_map(move |number| mesh.attribute(number).ok())
    }

    /// An attribute by its number; [`Status::Argument`] where there is none.
    pub fn attribute(&self, number: u32) -> Result<Attribute<'a>> {
        let raw: sys::anic_attribute = fill(|out| {
            // SAFETY: the asset is open.
            unsafe { sys::anic_get_attribute(self.clip.raw(), self.number, number, out) }
        })?;
        let count = raw.count as usize;
        // SAFETY: strings and arrays belong to the asset.
        Ok(unsafe {
            Attribute {
                mesh: *self,
                number,
                name: text(raw.name),
                kind: AttributeKind::from_raw(raw.kind),
                domain: Domain::from_raw(raw.domain),
                count: raw.count,
                components: raw.components,
                values: slice(raw.values, count * raw.components as usize),
                labels: slice(raw.labels, count),
                label_count: raw.label_count,
                moves: raw.moves != 0,
            }
        })
    }

    /// Prepares normals that are computed from positions.
    pub fn normal_plan(&self, options: &NormalOptions) -> Result<NormalPlan> {
        NormalPlan::new(self, self.clip.raw(), options)
    }

    /// Prepares the vertices that a graphics card needs.
    pub fn render_plan(&self, options: &RenderOptions) -> Result<RenderPlan> {
        RenderPlan::new(self, self.clip.raw(), options)
    }
}

impl fmt::Debug for Mesh<'_> {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "Mesh({:?}, {} vertices, {} triangles)", self.name, self.vertex_count, self.triangle_count)
    }
}

/// A number of an index buffer: `u16` or `u32`.
pub trait Index: sealed::Sealed + Copy {
    #[doc(hidden)]
    const BYTES: u32;
}

impl Index for u16 {
    const BYTES: u32 = 2;
}

impl Index for u32 {
    const BYTES: u32 = 4;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for u16 {}
    impl Sealed for u32 {}
}

/// Polygons as in the source.
#[derive(Clone, Copy, Debug)]
pub struct Polygons<'a> {
    /// One more than there are polygons: polygon p has the corners `offsets[p]..offsets[p + 1]`.
    pub offsets: &'a [u32],
    /// Vertex of each corner.
    pub corners: &'a [u32],
}

impl<'a> Polygons<'a> {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.offsets.len().saturating_sub(1)
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The vertices of each polygon.
    pub fn iter(&self) -> impl Iterator<Item = &'a [u32]> {
        let corners = self.corners;
        self.offsets.windows(2).map(move |ends| &corners[ends[0] as usize..ends[1] as usize])
    }
}

enumeration! {
    /// The meaning of an attribute.
    AttributeKind: Custom {
        /// Texture coordinates, v upwards: (0, 0) is the lower left corner of an image; some graphics interfaces want 1 - v.
        Uv = ANIC_ATTRIBUTE_UV,
        /// Normals of the first frame. Without components: labels that say which corners share a normal.
        Normal = ANIC_ATTRIBUTE_NORMAL,
        /// Tangents of the first frame.
        Tangent = ANIC_ATTRIBUTE_TANGENT,
        /// RGB or RGBA, 0 to 1.
        Colour = ANIC_ATTRIBUTE_COLOUR,
        /// Anything else.
        Custom = ANIC_ATTRIBUTE_CUSTOM,
        /// Names of materials, for polygons.
        Material = ANIC_ATTRIBUTE_MATERIAL,
        /// Names of the meshes or objects of the source, for polygons.
        Part = ANIC_ATTRIBUTE_PART,
    }
}

enumeration! {
    /// The elements that have a value each.
    Domain: Vertices {
        /// Vertices.
        Vertices = ANIC_DOMAIN_VERTICES,
        /// Corners of polygons.
        Corners = ANIC_DOMAIN_CORNERS,
        /// Polygons.
        Polygons = ANIC_DOMAIN_POLYGONS,
    }
}

/// An attribute, as in the first frame.
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct Attribute<'a> {
    mesh: Mesh<'a>,
    /// Its number.
    pub number: u32,
    /// As in the source, may be empty.
    pub name: Text<'a>,
    /// Its meaning.
    pub kind: AttributeKind,
    /// The elements that have a value each.
    pub domain: Domain,
    /// Elements of the domain.
    pub count: u32,
    /// Numbers of an element; 0: it has `labels`.
    pub components: u32,
    /// count x components.
    pub values: &'a [f32],
    /// One for each element. A polygon has 0 for none, or one more than the number of a name. Corners at a vertex with the
    /// same label share a value.
    pub labels: &'a [u32],
    /// Names of labels.
    pub label_count: u32,
    /// Other frames have other values: [`Shown::attribute_into`](crate::Shown::attribute_into).
    pub moves: bool,
}

impl<'a> Attribute<'a> {
    /// The name of a label, of a number below `label_count`.
    pub fn label_name(&self, label: u32) -> Option<Text<'a>> {
        // SAFETY: the asset is open, and its strings belong to it.
        unsafe {
            let name = sys::anic_get_label_name(self.mesh.clip.raw(), self.mesh.number, self.number, label);
            (!name.is_null()).then(|| text(name))
        }
    }

    /// The names of all labels.
    pub fn label_names(&self) -> impl Iterator<Item = Text<'a>> {
        let attribute = *self;
        (0..self.label_count).filter_map(move |label| attribute.label_name(label))
    }

    /// The look of the material that a label names; none where the file has its name alone.
    pub fn material(&self, label: u32) -> Result<Option<Material<'a>>> {
        let raw = fill(|out| {
            // SAFETY: the asset is open.
            unsafe { sys::anic_get_material(self.mesh.clip.raw(), self.mesh.number, self.number, label, out) }
        });
        match raw {
            Ok(raw) => Ok(Some(Material::from_raw(&raw))),
            Err(error) if error.status() == Status::Absent => Ok(None),
            Err(error) => Err(error),
        }
    }
}

impl fmt::Debug for Attribute<'_> {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "Attribute({:?}, {:?} of {:?}, {} components)", self.name, self.kind, self.domain, self.components)
    }
}

enumeration! {
    /// How a surface lets light through.
    AlphaMode: Opaque {
        /// Not at all.
        Opaque = ANIC_ALPHA_OPAQUE,
        /// Wholly below [`Material::alpha_cutoff`], else not at all.
        Mask = ANIC_ALPHA_MASK,
        /// By its alpha.
        Blend = ANIC_ALPHA_BLEND,
    }
}

/// The look of a material, in the terms of glTF 2.0. Textures are paths or names as in the source, empty where there is
/// none: images are not in the file.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Material<'a> {
    /// As in the source.
    pub name: Text<'a>,
    /// Linear RGBA; a texture's colour is multiplied by it.
    pub base_colour: [f32; 4],
    /// 0 to 1.
    pub metallic: f32,
    /// 0 to 1.
    pub roughness: f32,
    /// Linear RGB, 0 and more.
    pub emissive: [f32; 3],
    /// How light goes through.
    pub alpha: AlphaMode,
    /// The cutoff of [`AlphaMode::Mask`].
    pub alpha_cutoff: f32,
    /// The back is drawn, too.
    pub double_sided: bool,
    /// Colour.
    pub base_colour_texture: Text<'a>,
    /// Roughness in green, metallic in blue.
    pub metallic_roughness_texture: Text<'a>,
    /// Normals in the surface's axes.
    pub normal_texture: Text<'a>,
    /// Shadows of near surfaces.
    pub occlusion_texture: Text<'a>,
    /// Light.
    pub emissive_texture: Text<'a>,
}

impl Material<'_> {
    fn from_raw(raw: &sys::anic_material) -> Self {
        // SAFETY: strings belong to the asset, which the lifetime of the caller's borrow keeps.
        unsafe {
            Self {
                name: text(raw.name),
                base_colour: raw.base_colour,
                metallic: raw.metallic,
                roughness: raw.roughness,
                emissive: raw.emissive,
                alpha: AlphaMode::from_raw(raw.alpha),
                alpha_cutoff: raw.alpha_cutoff,
                double_sided: raw.double_sided != 0,
                base_colour_texture: text(raw.base_colour_texture),
                metallic_roughness_texture: text(raw.metallic_roughness_texture),
                normal_texture: text(raw.normal_texture),
                occlusion_texture: text(raw.occlusion_texture),
                emissive_texture: text(raw.emissive_texture),
            }
        }
    }
}

/// First and count of a range, which C checks against what there is.
pub(crate) fn first_and_count(range: &Range<u32>) -> Result<(u32, u32)> {
    let count = range.end.checked_sub(range.start).ok_or(Error::ARGUMENT)?;
    Ok((range.start, count))
}
