// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
use std::cell::OnceCell;
use std::rc::Rc;

use anicodec::{Bounds, Clip, OpenOptions, RenderOptions, RenderPlan, UpAxis};
use godot::prelude::*;

/// A file, opened, with the vertices that a graphics card needs.
pub struct Opened {
    pub clip: Clip,
    pub plans: Vec<RenderPlan>,
}

impl Opened {
    /// Opens a file, with hard edges as in the source or, where it does not tell, beyond 60 degrees.
    pub fn new(file: &[u8], in_place: bool) -> anicodec::Result<Self> {
        let clip = OpenOptions::new().bounds(true).in_place(in_place).open(file)?;
        let mut opened = Self { clip, plans: Vec::new() };
        for mesh in opened.clip.meshes() {
            let reference_frame = opened.first_frame(mesh.number);
            opened.plans.push(mesh.render_plan(&RenderOptions {
                crease_angle: 60.0,
                source_edges: true,
                reference_frame,
            })?);
        }
        Ok(opened)
    }

    /// The first frame that shows a mesh.
    pub fn first_frame(&self, mesh: u32) -> u32 {
        let shown = |&frame: &u32| matches!(self.clip.frame_bounds(mesh, frame), Ok(Some(_)));
        (0..self.clip.info().frame_count).find(shown).unwrap_or(0)
    }

    /// A point of the file in the axes of Godot, y up.
    pub fn turned(&self, [x, y, z]: [f32; 3]) -> Vector3 {
        if self.clip.info().up == UpAxis::Z { Vector3::new(x, z, -y) } else { Vector3::new(x, y, z) }
    }

    pub fn turned_box(&self, bounds: &Bounds) -> Aabb {
        let (a, b) = (self.turned(bounds.min), self.turned(bounds.max));
        let least = a.coord_min(b);
        Aabb { position: least, size: a.coord_max(b) - least }
    }
}

/// An imported `.anic` file, shared by all players. It is opened when one first needs it.
#[derive(GodotClass)]
#[class(tool, init, base = Resource)]
pub struct AnicClip {
    /// The bytes of the file.
    #[var(set = set_data, usage_flags = [STORAGE])]
    data: PackedByteArray,
    /// Leaves the motion of the whole out of the positions, for scenes that move the node by `get_root_step`.
    #[var(set = set_in_place, usage_flags = [STORAGE, EDITOR])]
    in_place: bool,
    opened: OnceCell<Option<Rc<Opened>>>,
    base: Base<Resource>,
}

#[godot_api]
impl AnicClip {
    #[func]
    pub fn set_data(&mut self, data: PackedByteArray) {
        self.data = data;
        self.forget();
    }

    #[func]
    pub fn set_in_place(&mut self, in_place: bool) {
        self.in_place = in_place;
        self.forget();
    }

    /// Names of the clips of the file.
    #[func]
    fn get_clip_names(&self) -> PackedStringArray {
        let Some(opened) = self.opened() else { return PackedStringArray::new() };
        opened.clip.clips().map(|clip| GString::from(&*clip.name.to_string_lossy())).collect()
    }

    /// Seconds of a turn of a clip in a loop; 0 where there is none of the name.
    #[func]
    fn get_clip_duration(&self, name: GString) -> f64 {
        let Some(opened) = self.opened() else { return 0.0 };
        let name = name.to_string();
        opened.clip.clips().find(|clip| clip.name == *name).map_or(0.0, |clip| clip.loop_duration)
    }

    /// How many meshes there are.
    #[func]
    fn get_mesh_count(&self) -> u32 {
        self.opened().map_or(0, |opened| opened.plans.len() as u32)
    }

    /// The motion of the whole between two times of a clip, in a loop or not.
    #[func]
    fn get_root_step(&self, name: GString, from: f64, to: f64, looped: bool) -> Transform3D {
        let Some(opened) = self.opened() else { return Transform3D::IDENTITY };
        let wrap = if looped { anicodec::Wrap::Loop } else { anicodec::Wrap::Clamp };
        let number = opened.clip.find_clip(name.to_string()).unwrap_or(0);
        let Ok(step) = opened.clip.root_step(number, from, to, anicodec::Sampling::Linear, wrap) else {
            return Transform3D::IDENTITY;
        };
        // About the up axis, which is Godot's y in either case.
        let movement = step.movement.map(|number| number as f32);
        let pivot = opened.turned(step.pivot.map(|number| number as f32));
        let basis = Basis::from_axis_angle(Vector3::UP, step.turn as f32);
        Transform3D::new(basis, pivot - basis * pivot + opened.turned(movement))
    }

    fn forget(&mut self) {
        self.opened.take();
        self.base_mut().emit_changed();
    }
}

impl AnicClip {
    /// The opened file; none after a fault, which is told once.
    pub fn opened(&self) -> Option<Rc<Opened>> {
        let open = || match Opened::new(self.data.as_slice(), self.in_place) {
            Ok(opened) => Some(Rc::new(opened)),
            Err(error) => {
                godot_error!("{}: {error}", self.base().get_path());
                None
            }
        };
        self.opened.get_or_init(open).clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_with_z_up_are_turned() {
        let opened = Opened::new(include_bytes!("../../anicodec/examples/walk.anic"), false).unwrap();
        assert_eq!(opened.clip.info().up, UpAxis::Z);
        assert_eq!(opened.turned([1.0, 2.0, 3.0]), Vector3::new(1.0, 3.0, -2.0));
        let turned = opened.turned_box(&Bounds { min: [0.0, 1.0, 2.0], max: [3.0, 5.0, 9.0] });
        assert_eq!((turned.position, turned.size), (Vector3::new(0.0, 2.0, -5.0), Vector3::new(3.0, 7.0, 4.0)));
    }
}
