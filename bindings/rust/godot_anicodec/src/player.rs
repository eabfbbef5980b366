// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
use anicodec::Wrap;
use godot::classes::mesh::{ArrayType, PrimitiveType};
use godot::classes::{ArrayMesh, Engine, IMeshInstance3D, MeshInstance3D};
use godot::prelude::*;

use crate::clip::AnicClip;
use crate::playback::{Fade, Playback, Track, advance};

/// The state of a player, of one file and mesh.
struct Instance {
    playback: Playback,
    shown: Gd<ArrayMesh>,
    /// Indices and texture coordinates, which never move.
    indices: PackedInt32Array,
    uvs: Option<PackedVector2Array>,
}

/// Plays a mesh of a clip. `time` may be set, animated or bound like any other property.
#[derive(GodotClass)]
#[class(tool, init, base = MeshInstance3D)]
struct AnicPlayer {
    /// The file.
    #[export]
    #[var(set = set_clip)]
    clip: Option<Gd<AnicClip>>,
    /// Mesh of the file.
    #[export]
    #[var(set = set_mesh_number)]
    mesh_number: u32,
    /// Clip of the file by its name; empty: the first one.
    #[export]
    #[var(set = set_clip_name)]
    clip_name: GString,
    /// Seconds; 0 is the first frame of the clip.
    #[export]
    #[var(set = set_time)]
    time: f64,
    /// Seconds of the clip in a second; negative: backwards.
    #[export]
    #[init(val = 1.0)]
    speed: f64,
    /// The clip begins again at its end.
    #[export]
    #[init(val = true)]
    looped: bool,
    /// Time goes on by itself in a running scene.
    #[export]
    #[init(val = true)]
    playing: bool,
    /// Share of the components to play: less for what is far away.
    #[export(range = (0.01, 1.0))]
    #[init(val = 1.0)]
    quality: f64,
    fade: Option<Fade>,
    instance: Option<Instance>,
    /// The last complaint, which is not repeated in every frame.
    fault: String,
    base: Base<MeshInstance3D>,
}

#[godot_api]
impl IMeshInstance3D for AnicPlayer {
    fn ready(&mut self) {
        self.show();
    }

    fn process(&mut self, delta: f64) {
        if !self.playing || Engine::singleton().is_editor_hint() {
            return;
        }
        let mut track = self.track();
        advance(&mut track, &mut self.fade, self.speed, delta);
        (self.clip_name, self.time) = (GString::from(track.clip.as_str()), track.time);
        self.show();
    }
}

#[godot_api]
impl AnicPlayer {
    #[func]
    fn set_clip(&mut self, clip: Option<Gd<AnicClip>>) {
        self.clip = clip;
        self.begin_again();
    }

    #[func]
    fn set_mesh_number(&mut self, number: u32) {
        self.mesh_number = number;
        self.begin_again();
    }

    #[func]
    fn set_clip_name(&mut self, name: GString) {
        (self.clip_name, self.fade) = (name, None);
        self.show();
    }

    #[func]
    fn set_time(&mut self, seconds: f64) {
        self.time = seconds;
        self.show();
    }

    /// Fades to another clip of the file within some seconds.
    #[func]
    fn cross_fade(&mut self, to: GString, seconds: f64) {
        let to = Track { clip: to.to_string(), time: 0.0 };
        self.fade = Some(Fade { to, done: 0.0, length: seconds });
    }

    fn track(&self) -> Track {
        Track { clip: self.clip_name.to_string(), time: self.time }
    }

    fn begin_again(&mut self) {
        self.instance = None;
        self.show();
    }

    /// Shows the time that the properties say.
    fn show(&mut self) {
        if !self.base().is_node_ready() {
            return;
        }
        if let Err(fault) = self.try_show()
            && fault != self.fault
        {
            godot_error!("{}: {fault}", self.base().get_name());
            self.fault = fault;
        }
    }

    fn try_show(&mut self) -> Result<(), String> {
        if self.instance.is_none() {
            let Some(opened) = self.clip.as_ref().and_then(|clip| clip.bind().opened()) else { return Ok(()) };
            let instance = Instance::new(Playback::new(opened, self.mesh_number as usize)?)?;
            self.base_mut().set_mesh(&instance.shown);
            self.instance = Some(instance);
        }
        let track = self.track();
        let Some(instance) = &mut self.instance else { return Ok(()) };
        let wrap = if self.looped { Wrap::Loop } else { Wrap::Clamp };
        let is_there = instance.playback.show(&track, self.fade.as_ref(), wrap, self.quality)?;
        instance.upload(is_there);
        Ok(())
    }
}

impl Instance {
    fn new(playback: Playback) -> Result<Self, String> {
        // Turned round: Godot's fronts are clockwise.
        let triangles = playback.opened.plans[playback.mesh].indices().as_chunks::<3>().0;
        let indices = triangles.iter().flat_map(|&[a, b, c]| [a, c, b].map(|index| index as i32)).collect();
        // v is upwards in the file, downwards in Godot.
        let turned = |values: Vec<[f32; 2]>| values.iter().map(|&[u, v]| Vector2::new(u, 1.0 - v)).collect();
        let uvs = playback.texture_coordinates()?.map(turned);
        Ok(Self { playback, shown: ArrayMesh::new_gd(), indices, uvs })
    }

    /// Hands the mesh to Godot; without a surface where it is not there.
    fn upload(&mut self, is_there: bool) {
        self.shown.clear_surfaces();
        if !is_there {
            return;
        }
        let opened = &self.playback.opened;
        let turned =
            |points: &[[f32; 3]]| points.iter().map(|&point| opened.turned(point)).collect::<PackedVector3Array>();
        let mut arrays = VarArray::new();
        arrays.resize(ArrayType::MAX.ord() as usize, &Variant::nil());
        arrays.set(ArrayType::VERTEX.ord() as usize, &turned(&self.playback.points).to_variant());
        arrays.set(ArrayType::NORMAL.ord() as usize, &turned(&self.playback.normals).to_variant());
        arrays.set(ArrayType::INDEX.ord() as usize, &self.indices.to_variant());
        if let Some(uvs) = &self.uvs {
            arrays.set(ArrayType::TEX_UV.ord() as usize, &uvs.to_variant());
        }
        self.shown.add_surface_from_arrays(PrimitiveType::TRIANGLES, &arrays);
        if let Ok(Some(bounds)) = opened.clip.bounds(self.playback.mesh as u32) {
            self.shown.set_custom_aabb(opened.turned_box(&bounds));
        }
    }
}
