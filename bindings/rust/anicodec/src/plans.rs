// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
use alloc::vec;
use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;
use core::ptr::{self, NonNull};

use anicodec_sys as sys;

use crate::context::{Context, When};
use crate::error::{Error, Result};
use crate::mesh::{first_and_count, Mesh};
use crate::output::{Output, ValueOutput};
use crate::raw::{check, init, slice};

/// Which corners of a mesh share a normal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NormalOptions {
    /// Degrees; an edge is hard if the normals of its polygons are further apart. 0: no edge is hard. A small angle, such as
    /// 0.001, gives flat shading wherever polygons are not coplanar.
    pub crease_angle: f64,
    /// The frame in which the angles are measured, for all frames.
    pub reference_frame: u32,
    /// Normals for each corner instead of each vertex.
    pub per_corner: bool,
    /// Edges are hard that are hard in the source, whatever the angle, if the file tells; else by `crease_angle`.
    pub source_edges: bool,
}

/// How to make normals of a mesh: [`Mesh::normal_plan`]. Immutable; it does not need the clip any more.
///
/// Copies of a vertex share a normal, so that seams of the source do not show unless they are creases. A normal is the sum
/// of the cross products of the edges at its corners, scaled to length one, or (0, 0, 1).
///
/// ```
/// use anicodec::{Clip, NormalOptions};
///
/// let clip = Clip::open(std::fs::read("examples/walk.anic")?)?;
/// let plan = clip.mesh(0)?.normal_plan(&NormalOptions::default())?;
/// let mut dancer = clip.context()?;
/// dancer.seek_frame(4)?;
/// let mut normals = vec![[0.0; 3]; plan.len()];
/// plan.normals_into(&dancer.positions()?, &mut normals)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct NormalPlan {
    raw: NonNull<sys::anic_normal_plan>,
    vertex_count: usize,
}

// SAFETY: a plan is immutable and bound to no thread.
unsafe impl Send for NormalPlan {}
// SAFETY: as above.
unsafe impl Sync for NormalPlan {}

impl Drop for NormalPlan {
    fn drop(&mut self) {
        // SAFETY: it lives until here.
        unsafe { sys::anic_destroy_normal_plan(self.raw.as_ptr()) }
    }
}

impl NormalPlan {
    pub(crate) fn new(mesh: &Mesh<'_>, asset: *const sys::anic_asset, options: &NormalOptions) -> Result<Self> {
        let mut wanted: sys::anic_normal_plan_options = init();
        wanted.crease_angle = options.crease_angle;
        wanted.reference_frame = options.reference_frame;
        wanted.per_corner = options.per_corner.into();
        wanted.source_edges = options.source_edges.into();
        let mut raw = ptr::null_mut();
        // SAFETY: the asset of `mesh` is open.
        check(unsafe { sys::anic_create_normal_plan(asset, mesh.number, &wanted, ptr::null(), &mut raw) })?;
        let raw = NonNull::new(raw).ok_or(Error::of(sys::ANIC_E_INTERNAL))?;
        Ok(Self { raw, vertex_count: mesh.vertex_count as usize })
    }

    /// How many normals there are: one for each vertex, or one for each corner.
    pub fn len(&self) -> usize {
        // SAFETY: the plan lives.
        unsafe { sys::anic_get_normal_count(self.raw.as_ptr()) as usize }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Writes all normals of a pose, the positions of all vertices of the mesh.
    pub fn normals_into(&self, positions: &[[f32; 3]], out: &mut [[f32; 3]]) -> Result<()> {
        self.write_normals(positions, 0..self.len() as u32, Output::points(out))
    }

    /// Writes a range of them in any format and stride; [`Format::Snorm16x4`](crate::Format::Snorm16x4) suits normals.
    pub fn write_normals(&self, positions: &[[f32; 3]], normals: Range<u32>, out: Output<'_>) -> Result<()> {
        let (first, count) = first_and_count(&normals)?;
        if positions.len() != self.vertex_count {
            return Err(Error::ARGUMENT);
        }
        // SAFETY: there is a position for each vertex, and `out` is an exclusive borrow of what it names.
        check(unsafe {
            sys::anic_write_normals(self.raw.as_ptr(), positions.as_ptr().cast(), 0, first, count, &out.raw)
        })
    }
}

impl fmt::Debug for NormalPlan {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "NormalPlan of {} normals", self.len())
    }
}

/// How render vertices get their normals: smooth everywhere by default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RenderOptions {
    /// As in [`NormalOptions`].
    pub crease_angle: f64,
    /// As in [`NormalOptions`].
    pub reference_frame: u32,
    /// As in [`NormalOptions`].
    pub source_edges: bool,
}

/// The vertices that a graphics card needs: [`Mesh::render_plan`]. One for each distinct pair of a vertex and what its
/// corners carry: the values of all attributes of corners, and the normal. Immutable; it does not need the clip any more.
///
/// ```
/// use anicodec::{Clip, RenderOptions, When};
///
/// let clip = Clip::open(std::fs::read("examples/heated.anic")?)?;
/// let plan = clip.mesh(0)?.render_plan(&RenderOptions { crease_angle: 40.0, ..Default::default() })?;
/// let mut heated = clip.context()?;
/// heated.seek_frame(2)?;
/// let count = plan.vertices().len();
/// let (mut positions, mut normals) = (vec![[0.0; 3]; count], vec![[0.0; 3]; count]);
/// plan.positions_into(&heated, When::Current, &mut positions)?;
/// plan.normals_into(&positions, &mut normals)?;
/// assert!(plan.indices().iter().all(|&vertex| (vertex as usize) < count));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct RenderPlan {
    raw: NonNull<sys::anic_render_plan>,
    info: sys::anic_render_info,
}

// SAFETY: a plan is immutable and bound to no thread, and so are its arrays.
unsafe impl Send for RenderPlan {}
// SAFETY: as above.
unsafe impl Sync for RenderPlan {}

impl Drop for RenderPlan {
    fn drop(&mut self) {
        // SAFETY: it lives until here.
        unsafe { sys::anic_destroy_render_plan(self.raw.as_ptr()) }
    }
}

impl RenderPlan {
    pub(crate) fn new(mesh: &Mesh<'_>, asset: *const sys::anic_asset, options: &RenderOptions) -> Result<Self> {
        let mut wanted: sys::anic_render_plan_options = init();
        wanted.crease_angle = options.crease_angle;
        wanted.reference_frame = options.reference_frame;
        wanted.source_edges = options.source_edges.into();
        let mut raw = ptr::null_mut();
        // SAFETY: the asset of `mesh` is open.
        check(unsafe { sys::anic_create_render_plan(asset, mesh.number, &wanted, ptr::null(), &mut raw) })?;
        let raw = NonNull::new(raw).ok_or(Error::of(sys::ANIC_E_INTERNAL))?;
        let mut plan = Self { raw, info: init() };
        // SAFETY: the plan lives.
        check(unsafe { sys::anic_get_render_info(raw.as_ptr(), &mut plan.info) })?;
        Ok(plan)
    }

    /// The mesh that it is of.
    pub fn mesh(&self) -> u32 {
        self.info.mesh
    }

    /// Vertex of each render vertex, ascending: every value of a vertex is found by it.
    pub fn vertices(&self) -> &[u32] {
        self.array(self.info.vertices, self.info.vertex_count)
    }

    /// A corner of each render vertex: every value of a corner is found by it. Empty in a mesh without corners.
    pub fn corners(&self) -> &[u32] {
        self.array(self.info.corners, self.info.vertex_count)
    }

    /// Three render vertices of each triangle, ordered by material.
    pub fn indices(&self) -> &[u32] {
        // SAFETY: the array belongs to the plan.
        unsafe { slice(self.info.indices, 3 * self.info.triangle_count as usize) }
    }

    /// Polygon of each triangle.
    pub fn triangle_polygons(&self) -> &[u32] {
        self.array(self.info.triangle_polygons, self.info.triangle_count)
    }

    /// Triangles of one material each, in order: the label of their polygons, 0 for none or one more than the number of a
    /// name, and a range of triangles.
    pub fn groups(&self) -> impl ExactSizeIterator<Item = (u32, Range<u32>)> + '_ {
        let count = self.info.group_count;
        let begin = self.array(self.info.group_begin, if count > 0 { count + 1 } else { 0 });
        let materials = self.array(self.info.group_materials, count);
        materials.iter().zip(begin.windows(2)).map(|(&material, ends)| (material, ends[0]..ends[1]))
    }

    /// Render vertices whose corners each normal is summed over, for normals on a graphics card.
    pub fn normal_groups(&self) -> NormalGroups<'_> {
        let count = self.info.normal_group_count;
        let begin = self.array(self.info.normal_begin, if count > 0 { count + 1 } else { 0 });
        NormalGroups {
            groups: self.array(self.info.normal_groups, self.info.vertex_count),
            centres: self.array(self.info.normal_centres, count),
            begin,
            // SAFETY: the array belongs to the plan, and holds two numbers for each corner.
            corners: unsafe { slice(self.info.normal_corners.cast(), begin.last().map_or(0, |&end| end as usize)) },
        }
    }

    fn array(&self, from: *const u32, count: u32) -> &[u32] {
        // SAFETY: the arrays of the info belong to the plan.
        unsafe { slice(from, count as usize) }
    }

    /// Writes positions of all render vertices. The context may be of any clip of the same file.
    pub fn positions_into(&self, context: &Context, when: When, out: &mut [[f32; 3]]) -> Result<()> {
        self.write_positions(context, when, 0..self.info.vertex_count, Output::points(out))
    }

    /// Writes positions of a range of render vertices in any format and stride.
    pub fn write_positions(&self, context: &Context, when: When, vertices: Range<u32>, out: Output<'_>) -> Result<()> {
        let (first, count) = first_and_count(&vertices)?;
        // SAFETY: `out` is an exclusive borrow of what it names; the library compares the mesh with the plan's.
        check(unsafe {
            sys::anic_write_render_positions(self.raw.as_ptr(), context.raw(), when.raw(), first, count, &out.raw)
        })
    }

    /// Writes normals of all render vertices from their positions.
    pub fn normals_into(&self, positions: &[[f32; 3]], out: &mut [[f32; 3]]) -> Result<()> {
        self.write_normals(positions, 0..self.info.vertex_count, Output::points(out))
    }

    /// Writes normals of a range of render vertices in any format and stride, from the positions of all.
    pub fn write_normals(&self, positions: &[[f32; 3]], vertices: Range<u32>, out: Output<'_>) -> Result<()> {
        let (first, count) = first_and_count(&vertices)?;
        if positions.len() != self.info.vertex_count as usize {
            return Err(Error::ARGUMENT);
        }
        // SAFETY: there is a position for each render vertex, and `out` is an exclusive borrow of what it names.
        check(unsafe {
            sys::anic_write_render_normals(self.raw.as_ptr(), positions.as_ptr().cast(), 0, first, count, &out.raw)
        })
    }

    /// Values of an attribute of vertices or corners, of all render vertices, with this many components.
    pub fn attribute(&self, context: &Context, when: When, attribute: u32, components: u32) -> Result<Vec<f32>> {
        let mut values = vec![0.0; components as usize * self.info.vertex_count as usize];
        let out = ValueOutput::values(&mut values).components(components);
        self.write_attribute(context, when, attribute, 0..self.info.vertex_count, out)?;
        Ok(values)
    }

    /// Writes values of an attribute of vertices or corners, of a range of render vertices.
    pub fn write_attribute(
        &self,
        context: &Context,
        when: When,
        attribute: u32,
        vertices: Range<u32>,
        out: ValueOutput<'_>,
    ) -> Result<()> {
        let (first, count) = first_and_count(&vertices)?;
        // SAFETY: `out` is an exclusive borrow of what it names; the library compares the mesh with the plan's.
        check(unsafe {
            sys::anic_write_render_attribute(
                self.raw.as_ptr(),
                context.raw(),
                attribute,
                when.raw(),
                first,
                count,
                &out.raw,
            )
        })
    }
}

impl fmt::Debug for RenderPlan {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "RenderPlan of {} vertices, {} triangles", self.info.vertex_count, self.info.triangle_count)
    }
}

/// The sums that make normals on a graphics card: a normal is the sum of the cross products (next - centre) x (previous - centre)
/// over the corners of a group, scaled to length one; (0, 0, 1) if that is 0.
#[derive(Clone, Copy, Debug)]
pub struct NormalGroups<'a> {
    /// Group of each render vertex.
    pub groups: &'a [u32],
    /// A render vertex of each group.
    pub centres: &'a [u32],
    /// Group g has the corners `begin[g]..begin[g + 1]`.
    pub begin: &'a [u32],
    /// Render vertices after and before each corner.
    pub corners: &'a [[u32; 2]],
}
