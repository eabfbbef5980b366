// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
use alloc::vec;
use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;
use core::ptr::{self, NonNull};

use anicodec_sys as sys;

use crate::clip::Clip;
use crate::error::{Error, Result};
use crate::mesh::first_and_count;
use crate::output::{Bounds, Hit, Output, Ray, Side, SurfaceFrame, SurfacePoint, ValueOutput};
use crate::raw::{check, enumeration, fill, init};

enumeration! {
    /// The picture between two frames.
    Sampling: Linear {
        /// The frame before.
        Step = ANIC_SAMPLE_STEP,
        /// A straight line from the frame before to the frame after.
        Linear = ANIC_SAMPLE_LINEAR,
        /// A smooth curve through four frames (Catmull-Rom).
        Cubic = ANIC_SAMPLE_CUBIC,
    }
}

enumeration! {
    /// The picture before the first frame and after the last one.
    Wrap: Clamp {
        /// The first and the last frame stay.
        Clamp = ANIC_WRAP_CLAMP,
        /// The first frame follows the last; if [`NamedClip::closed`](crate::NamedClip::closed), they are one.
        Loop = ANIC_WRAP_LOOP,
        /// Backwards after the last frame, forwards after the first.
        PingPong = ANIC_WRAP_PING_PONG,
    }
}

enumeration! {
    /// One of the two times that a context knows.
    When: Current {
        /// Chosen by the last seek.
        Current = ANIC_WHEN_CURRENT,
        /// Chosen by the seek before, for motion vectors; the same as the current time after the first seek.
        Previous = ANIC_WHEN_PREVIOUS,
    }
}

/// An instance of a clip: it knows what is shown now, and what was shown before. Small; many share a clip. `Send`, and
/// any number of threads may read what it shows.
///
/// ```
/// use anicodec::{Clip, Sampling, Wrap};
///
/// let clip = Clip::open(std::fs::read("examples/walk.anic")?)?;
/// let (stand, walk) = (clip.find_clip("stand").unwrap(), clip.find_clip("walk").unwrap());
/// let mut dancer = clip.context()?;
/// dancer.set_clip(stand)?;
/// dancer.seek(1.5, Sampling::Linear, Wrap::Loop)?;
/// dancer.blend(walk, 0.2, Sampling::Linear, Wrap::Loop, 0.3)?; // three tenths of a step
/// let points = std::thread::spawn(move || dancer.positions()).join().unwrap()?;
/// assert_eq!(points.len(), clip.mesh(0)?.vertex_count as usize);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Context {
    raw: NonNull<sys::anic_context>,
    clip: Clip,
}

// SAFETY: a context is bound to no thread.
unsafe impl Send for Context {}
// SAFETY: functions of a const anic_context may run at the same time, and only they take &self.
unsafe impl Sync for Context {}

impl Drop for Context {
    fn drop(&mut self) {
        // SAFETY: the asset is still open: `clip` goes after this.
        unsafe { sys::anic_destroy_context(self.raw.as_ptr()) }
    }
}

impl Context {
    pub(crate) fn new(clip: &Clip) -> Result<Self> {
        let mut raw = ptr::null_mut();
        // SAFETY: the asset is open, and the context keeps it so.
        check(unsafe { sys::anic_create_context(clip.raw(), ptr::null(), &mut raw) })?;
        let raw = NonNull::new(raw).ok_or(Error::of(sys::ANIC_E_INTERNAL))?;
        Ok(Self { raw, clip: clip.clone() })
    }

    /// The clip that it is an instance of.
    pub fn clip(&self) -> &Clip {
        &self.clip
    }

    pub(crate) fn raw(&self) -> *const sys::anic_context {
        self.raw.as_ptr()
    }

    /// Chooses the clip whose times [`seek`](Self::seek) means; that of a new context is the first one that is open. Shows
    /// nothing new by itself.
    pub fn set_clip(&mut self, clip: u32) -> Result<()> {
        // SAFETY: &mut self.
        check(unsafe { sys::anic_set_clip(self.raw.as_ptr(), clip) })
    }

    /// Chooses the share of the clip's components to play, in (0, 1], from the next seek on: coarser, and as much faster,
    /// for instances that are small on the screen.
    pub fn set_quality(&mut self, quality: f64) -> Result<()> {
        // SAFETY: &mut self.
        check(unsafe { sys::anic_set_quality(self.raw.as_ptr(), quality) })
    }

    /// Chooses a frame of the file, whatever the clip.
    pub fn seek_frame(&mut self, frame: u32) -> Result<()> {
        // SAFETY: &mut self.
        check(unsafe { sys::anic_seek_frame(self.raw.as_ptr(), frame) })
    }

    /// Chooses a time of the context's clip in seconds; 0 is its first frame. To play at another speed or backwards, ask for
    /// other times. Time between frames costs what a whole frame does; of geometry interpolation the shape is made here.
    pub fn seek(&mut self, seconds: f64, sampling: Sampling, wrap: Wrap) -> Result<()> {
        // SAFETY: &mut self.
        check(unsafe { sys::anic_seek_time(self.raw.as_ptr(), seconds, sampling.raw(), wrap.raw()) })
    }

    /// Cross-fades what is shown with a moment of a clip: weight 0 changes nothing, 1 shows the moment alone. May be called
    /// again: each time what is shown then counts as one. After an error the context is as before.
    pub fn blend(&mut self, clip: u32, seconds: f64, sampling: Sampling, wrap: Wrap, weight: f64) -> Result<()> {
        // SAFETY: &mut self.
        check(unsafe { sys::anic_blend(self.raw.as_ptr(), clip, seconds, sampling.raw(), wrap.raw(), weight) })
    }

    /// Makes [`When::Previous`] the same as [`When::Current`]: no motion, after a cut.
    pub fn forget_previous(&mut self) -> Result<()> {
        // SAFETY: &mut self.
        check(unsafe { sys::anic_forget_previous(self.raw.as_ptr()) })
    }

    /// The motion of the whole of what is shown, blends included.
    pub fn root_motion(&self, when: When) -> Result<RootMotion> {
        let raw = fill(|out| {
            // SAFETY: the context lives.
            unsafe { sys::anic_get_shown_root_motion(self.raw(), when.raw(), out) }
        })?;
        Ok(RootMotion::from_raw(&raw))
    }

    /// A mesh as it is shown.
    pub fn shown(&self, mesh: u32, when: When) -> Shown<'_> {
        Shown { context: self, mesh, when }
    }

    /// Writes the positions of the first mesh, as many as it has vertices: [`Shown::positions_into`].
    pub fn positions_into(&self, out: &mut [[f32; 3]]) -> Result<()> {
        self.shown(0, When::Current).positions_into(out)
    }

    /// The positions of the first mesh.
    pub fn positions(&self) -> Result<Vec<[f32; 3]>> {
        self.shown(0, When::Current).positions()
    }
}

impl fmt::Debug for Context {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "Context of {:?}", self.clip)
    }
}

/// A mesh as a context shows it: [`Context::shown`].
///
/// All functions fail with [`Status::State`](crate::Status::State) before the first seek, and with
/// [`Status::Absent`](crate::Status::Absent) where the mesh is not there at the time.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a> {
    pub(crate) context: &'a Context,
    pub(crate) mesh: u32,
    pub(crate) when: When,
}

impl Shown<'_> {
    /// Writes all positions. Takes one for each vertex, neither more nor less.
    pub fn positions_into(&self, out: &mut [[f32; 3]]) -> Result<()> {
        if out.len() < self.context.clip.mesh(self.mesh)?.vertex_count as usize {
            return Err(Error::BUFFER_SIZE);
        }
        self.positions_from(0, out)
    }

    /// Writes positions of as many vertices as `out` has, from `first` on. Threads may write parts of a mesh at the same
    /// time; the result does not depend on how it is cut. Parts begin best at multiples of 16.
    pub fn positions_from(&self, first: u32, out: &mut [[f32; 3]]) -> Result<()> {
        let count = u32::try_from(out.len()).map_err(|_| Error::ARGUMENT)?;
        let end = first.checked_add(count).ok_or(Error::ARGUMENT)?;
        self.write_positions(first..end, Output::points(out))
    }

    /// All positions.
    pub fn positions(&self) -> Result<Vec<[f32; 3]>> {
        let mut out = vec![[0.0; 3]; self.context.clip.mesh(self.mesh)?.vertex_count as usize];
        self.positions_from(0, &mut out)?;
        Ok(out)
    }

    /// Writes positions of a range of vertices in any format and stride.
    pub fn write_positions(&self, vertices: Range<u32>, out: Output<'_>) -> Result<()> {
        let (first, count) = first_and_count(&vertices)?;
        // SAFETY: `out` is an exclusive borrow of what it names.
        check(unsafe {
            sys::anic_write_positions(self.context.raw(), self.mesh, self.when.raw(), first, count, &out.raw)
        })
    }

    /// Writes all values of an attribute, elements x components numbers; the attribute need not move.
    ///
    /// ```
    /// use anicodec::{AttributeKind, Clip, When};
    ///
    /// let clip = Clip::open(std::fs::read("examples/heated.anic")?)?;
    /// let mut heated = clip.context()?;
    /// heated.seek_frame(5)?;
    /// let mesh = clip.mesh(0)?;
    /// let colours = mesh.attributes().find(|a| a.kind == AttributeKind::Colour).unwrap();
    /// let mut values = vec![0.0; colours.values.len()];
    /// heated.shown(0, When::Current).attribute_into(colours.number, &mut values)?;
    /// assert!(colours.moves && values != colours.values);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn attribute_into(&self, attribute: u32, out: &mut [f32]) -> Result<()> {
        let found = self.context.clip.mesh(self.mesh)?;
        let count = found.attribute(attribute)?.count;
        self.write_attribute(attribute, 0..count, ValueOutput::values(out))
    }

    /// Writes values of a range of elements in any format and stride.
    pub fn write_attribute(&self, attribute: u32, elements: Range<u32>, out: ValueOutput<'_>) -> Result<()> {
        let (first, count) = first_and_count(&elements)?;
        // SAFETY: `out` is an exclusive borrow of what it names.
        check(unsafe {
            sys::anic_write_attribute(self.context.raw(), self.mesh, attribute, self.when.raw(), first, count, &out.raw)
        })
    }

    /// Computes the exact box of the mesh, at the cost of its positions.
    pub fn bounds(&self) -> Result<Bounds> {
        let mut raw = sys::anic_box { min: [0.0; 3], max: [0.0; 3] };
        // SAFETY: the context lives.
        check(unsafe { sys::anic_compute_bounds(self.context.raw(), self.mesh, self.when.raw(), &mut raw) })?;
        Ok(Bounds { min: raw.min, max: raw.max })
    }

    /// Axes at a point of the surface, for what is attached to it, at the cost of three vertices.
    ///
    /// ```
    /// use anicodec::{Clip, Ray, When};
    ///
    /// let clip = Clip::open(std::fs::read("examples/walk.anic")?)?;
    /// let triangles = clip.mesh(0)?.indices()?;
    /// let mut walker = clip.context()?;
    /// walker.seek_frame(3)?;
    /// let shown = walker.shown(0, When::Current);
    /// let bounds = shown.bounds()?;
    /// let middle = [0, 1, 2].map(|c| (bounds.min[c] + bounds.max[c]) / 2.0);
    /// let above = [middle[0], middle[1], bounds.max[2] + 1.0];
    /// let mut work = vec![0.0; 3 * clip.mesh(0)?.vertex_count as usize];
    /// if let Some(hit) = shown.intersect_ray(&Ray::new(above, [0.0, 0.0, -1.0]), &triangles, &mut work)? {
    ///     println!("hit at {:?}", shown.surface_frame(&hit.point)?.position);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn surface_frame(&self, point: &SurfacePoint) -> Result<SurfaceFrame> {
        let raw = sys::anic_surface_point { vertices: point.vertices, weights: point.weights };
        let mut out = sys::anic_surface_frame { position: [0.0; 3], normal: [0.0; 3], tangent: [0.0; 3] };
        // SAFETY: the context lives, and the point is checked against its mesh.
        check(unsafe { sys::anic_get_surface_frame(self.context.raw(), self.mesh, self.when.raw(), &raw, &mut out) })?;
        Ok(SurfaceFrame { position: out.position, normal: out.normal, tangent: out.tangent })
    }

    /// The first of the triangles on a ray; none where it meets none. `triangles` holds three vertices each, as
    /// [`Mesh::indices`](crate::Mesh::indices) gives them, and `work` three numbers for each vertex of the mesh. Costs what
    /// positions do, and O(triangles); allocates nothing.
    pub fn intersect_ray(&self, ray: &Ray, triangles: &[u32], work: &mut [f32]) -> Result<Option<Hit>> {
        let mut raw: sys::anic_ray = init();
        raw.origin = ray.origin;
        raw.direction = ray.direction;
        raw.side = ray.side.raw();
        if ray.farthest <= 0.0 {
            return Err(Error::ARGUMENT);
        }
        raw.farthest = ray.farthest;
        let count = u32::try_from(triangles.len() / 3).map_err(|_| Error::ARGUMENT)?;
        let mut out = sys::anic_hit {
            point: sys::anic_surface_point { vertices: [0; 3], weights: [0.0; 3] },
            distance: 0.0,
            triangle: 0,
            side: 0,
        };
        // SAFETY: the sizes are those of the slices, and vertices are checked against the mesh.
        check(unsafe {
            sys::anic_intersect_ray(
                self.context.raw(),
                self.mesh,
                self.when.raw(),
                &raw,
                triangles.as_ptr(),
                count,
                work.as_mut_ptr(),
                core::mem::size_of_val(work),
                &mut out,
            )
        })?;
        Ok((out.triangle != u32::MAX).then(|| Hit {
            point: SurfacePoint { vertices: out.point.vertices, weights: out.point.weights },
            distance: out.distance,
            triangle: out.triangle,
            side: Side::from_raw(out.side),
        }))
    }
}

/// The motion of the whole at a time: a turn about the up axis through the pivot, then a move along the ground, both from
/// where the clip was before.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RootMotion {
    /// The clip holds moves, or a blended clip does.
    pub moves: bool,
    /// The same of turns.
    pub turns: bool,
    /// Radians, counter-clockwise seen from above; whole turns count.
    pub turn: f64,
    /// The move.
    pub movement: [f64; 3],
    /// A point of the axis of the turn.
    pub pivot: [f64; 3],
    /// The same as one map, 3 x 4, row-major: from positions without the motion
    /// ([`OpenOptions::in_place`](crate::OpenOptions::in_place)) to positions with it.
    pub matrix: [f32; 12],
}

impl RootMotion {
    pub(crate) fn from_raw(raw: &sys::anic_root_motion) -> Self {
        Self {
            moves: raw.moves != 0,
            turns: raw.turns != 0,
            turn: raw.turn,
            movement: raw.move_,
            pivot: raw.pivot,
            matrix: raw.matrix,
        }
    }
}
