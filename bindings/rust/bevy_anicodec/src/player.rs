// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
use anicodec::{Context, NamedClip, Sampling, Status, Wrap};
use bevy::camera::primitives::Aabb;
use bevy::camera::visibility::NoAutoAabb;
use bevy::prelude::*;

use crate::clip::AnicClip;
use crate::crowd::AnicCrowdMaterial;

/// A clip of the file at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// The clip's name; empty: the first one that is open.
    pub clip: String,
    /// Seconds; 0 is the first frame of the clip.
    pub time: f64,
    /// Seconds of the clip in a second of the game; negative: backwards.
    pub speed: f64,
    /// The picture before the first frame and after the last one.
    pub wrap: Wrap,
    /// The picture between two frames.
    pub sampling: Sampling,
}

impl Track {
    /// The begin of a clip by its name, in a loop.
    pub fn new(clip: impl Into<String>) -> Self {
        Self { clip: clip.into(), time: 0.0, speed: 1.0, wrap: Wrap::Loop, sampling: Sampling::Linear }
    }
}

/// Plays a mesh of a file on its entity. With a `MeshMaterial3d<StandardMaterial>`, or any other material, the entity gets a
/// mesh of its own, which the CPU fills. With a `MeshMaterial3d<AnicCrowdMaterial>` the graphics card makes its vertices.
///
/// All fields may be changed at any time.
#[derive(Component, Clone, Debug)]
#[require(Transform, Visibility)]
pub struct AnicPlayer {
    /// The file.
    pub file: Handle<AnicClip>,
    /// Number of the mesh in the file.
    pub mesh: u32,
    /// The clip that is shown.
    pub track: Track,
    /// A clip that is blended with it.
    pub other: Option<Track>,
    /// Share of the other clip, 0 to 1.
    pub weight: f64,
    /// Seconds until the other clip has taken over; 0: the weight stays as it is.
    pub fade: f64,
    /// Time stands still.
    pub paused: bool,
    /// Share of the components to play, in (0, 1]: less for what is far away.
    pub quality: f64,
}

impl AnicPlayer {
    /// Plays the first mesh and the first clip of a file in a loop.
    pub fn new(file: Handle<AnicClip>) -> Self {
        let track = Track::new("");
        Self { file, mesh: 0, track, other: None, weight: 0.0, fade: 0.0, paused: false, quality: 1.0 }
    }

    /// Chooses another mesh of the file.
    pub fn with_mesh(mut self, mesh: u32) -> Self {
        self.mesh = mesh;
        self
    }

    /// Chooses the clip and how it is played.
    pub fn with_track(mut self, track: Track) -> Self {
        self.track = track;
        self
    }

    /// Fades to another clip within some seconds; 0: at once.
    pub fn cross_fade(&mut self, track: Track, seconds: f64) {
        if seconds > 0.0 {
            (self.other, self.weight, self.fade) = (Some(track), 0.0, seconds);
        } else {
            (self.track, self.other, self.weight, self.fade) = (track, None, 0.0, 0.0);
        }
    }

    /// Moves times on, and a fade.
    fn advance(&mut self, seconds: f64) {
        self.track.time += self.track.speed * seconds;
        let Some(other) = &mut self.other else { return };
        other.time += other.speed * seconds;
        if self.fade > 0.0 {
            // The rest of the weight within the rest of the time.
            self.weight += (1.0 - self.weight) * (seconds / self.fade).min(1.0);
            self.fade -= seconds;
            if self.fade <= 0.0
                && let Some(other) = self.other.take()
            {
                (self.track, self.weight, self.fade) = (other, 0.0, 0.0);
            }
        }
    }
}

/// The player's state of a file: it knows what is shown now.
#[derive(Component)]
pub(crate) struct Instance {
    pub(crate) file: AssetId<AnicClip>,
    pub(crate) mesh: u32,
    pub(crate) context: Context,
    /// The mesh is there at the time.
    pub(crate) present: bool,
    /// The last complaint, which is not repeated in every frame.
    fault: String,
}

impl Instance {
    /// Says what is wrong, once.
    fn complain(&mut self, entity: Entity, fault: String) {
        if self.fault != fault {
            error!("AnicPlayer of entity {entity}: {fault}");
            self.fault = fault;
        }
    }

    /// Shows what a player says, and returns the box around it.
    fn seek(&mut self, player: &AnicPlayer, clip: &AnicClip) -> Result<Option<Aabb>, String> {
        let named = |track: &Track| find(clip, &track.clip);
        let track = named(&player.track)?;
        let told = |error: anicodec::Error| error.to_string();
        self.context.set_quality(player.quality).map_err(told)?;
        self.context.set_clip(track.number).map_err(told)?;
        self.context.seek(player.track.time, player.track.sampling, player.track.wrap).map_err(told)?;
        let mut shown = box_around(clip, self.mesh, &track, &player.track);
        if let Some(other) = player.other.as_ref().filter(|_| player.weight > 0.0) {
            let named = named(other)?;
            let weight = player.weight.min(1.0);
            self.context.blend(named.number, other.time, other.sampling, other.wrap, weight).map_err(told)?;
            shown = united(shown, box_around(clip, self.mesh, &named, other));
        }
        Ok(shown)
    }
}

fn find<'a>(clip: &'a AnicClip, name: &str) -> Result<NamedClip<'a>, String> {
    let clip = clip.clip();
    let is_meant = |one: &NamedClip| if name.is_empty() { one.is_open } else { one.name == name };
    clip.clips().find(is_meant).ok_or_else(|| {
        let names: Vec<_> = clip.clips().map(|one| format!("{:?}", one.name)).collect();
        format!("the file has no clip \"{name}\", but {}", names.join(", "))
    })
}

fn united(a: Option<Aabb>, b: Option<Aabb>) -> Option<Aabb> {
    let (Some(first), Some(second)) = (a, b) else { return a.or(b) };
    Some(Aabb::from_min_max(first.min().min(second.min()).into(), first.max().max(second.max()).into()))
}

/// The boxes of the two frames around a time; those of all frames where frames have times of their own, or curves leave them.
fn box_around(clip: &AnicClip, mesh: u32, named: &NamedClip, track: &Track) -> Option<Aabb> {
    let file = clip.clip();
    if named.uneven || track.sampling == Sampling::Cubic || named.frame_count < 2 || !track.time.is_finite() {
        return clip.bounds(mesh);
    }
    let last = f64::from(named.frame_count - 1);
    let turn = if named.closed { last } else { last + 1.0 };
    let frame = track.time * named.rate.per_second();
    let frame = match track.wrap {
        Wrap::Loop => frame.rem_euclid(turn),
        Wrap::PingPong => last - (frame.rem_euclid(2.0 * last) - last).abs(),
        _ => frame.clamp(0.0, last),
    };
    let before = (frame as u32).min(named.frame_count - 1);
    let boxes = [before, (before + 1) % named.frame_count].map(|frame| {
        let bounds = file.frame_bounds(mesh, named.first_frame + frame).ok().flatten();
        bounds.map(|bounds| clip.turned_box(&bounds))
    });
    united(boxes[0], boxes[1])
}

pub(crate) fn advance(time: Res<Time>, mut players: Query<&mut AnicPlayer>) {
    for mut player in &mut players {
        if !player.paused {
            player.advance(time.delta_secs_f64());
        }
    }
}

/// Ends what plays a file that was loaded again.
pub(crate) fn forget_changed(
    mut commands: Commands,
    mut events: MessageReader<AssetEvent<AnicClip>>,
    instances: Query<(Entity, &Instance)>,
) {
    for event in events.read() {
        if let AssetEvent::Modified { id } = event {
            for (entity, _) in instances.iter().filter(|(_, instance)| instance.file == *id) {
                commands.entity(entity).remove::<(Instance, Mesh3d)>();
            }
        }
    }
}

type Material = MeshMaterial3d<AnicCrowdMaterial>;

/// Gives players whose file is there a context and, unless the graphics card plays them, a mesh.
pub(crate) fn attach(
    mut commands: Commands,
    clips: Res<Assets<AnicClip>>,
    mut meshes: ResMut<Assets<Mesh>>,
    players: Query<
        (Entity, &AnicPlayer, Option<&Instance>, Has<Material>),
        Or<(Changed<AnicPlayer>, Without<Instance>)>,
    >,
) {
    for (entity, player, instance, is_crowd) in &players {
        if instance.is_some_and(|one| one.file == player.file.id() && one.mesh == player.mesh) {
            continue;
        }
        let Some(clip) = clips.get(&player.file) else { continue };
        if !clip.has_mesh(player.mesh) {
            error_once!("AnicPlayer of entity {entity}: the file has no mesh {}", player.mesh);
            continue;
        }
        let context = match clip.clip().context() {
            Ok(context) => context,
            Err(error) => {
                error_once!("AnicPlayer of entity {entity}: {error}");
                continue;
            }
        };
        let (file, mesh, fault) = (player.file.id(), player.mesh, String::new());
        commands.entity(entity).insert((
            Instance { file, mesh, context, present: false, fault },
            NoAutoAabb,
            Aabb::default(),
        ));
        if !is_crowd {
            match clip.build_mesh(mesh) {
                Ok(built) => drop(commands.entity(entity).insert(Mesh3d(meshes.add(built)))),
                Err(error) => error_once!("AnicPlayer of entity {entity}: {error}"),
            }
        }
    }
}

/// Shows the times of all players, in boxes that culling takes.
pub(crate) fn seek(clips: Res<Assets<AnicClip>>, mut players: Query<(Entity, &AnicPlayer, &mut Instance, &mut Aabb)>) {
    players.par_iter_mut().for_each(|(entity, player, mut instance, mut aabb)| {
        let Some(clip) = clips.get(instance.file) else { return };
        match instance.seek(player, clip) {
            Ok(shown) => {
                instance.present = shown.is_some();
                aabb.set_if_neq(shown.unwrap_or_default());
            }
            Err(fault) => instance.complain(entity, fault),
        }
    });
}

/// Whether the mesh is not there, which is no fault.
pub(crate) fn is_absent(error: &anicodec::Error) -> bool {
    error.status() == Status::Absent
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fade_takes_its_time_and_ends_in_the_other_clip() {
        let mut player = AnicPlayer::new(Handle::default());
        player.cross_fade(Track { speed: 2.0, ..Track::new("run") }, 1.0);
        player.advance(0.25);
        assert_eq!((player.weight, player.other.as_ref().unwrap().time), (0.25, 0.5));
        player.advance(0.25);
        assert!((player.weight - 0.5).abs() < 1e-12);
        player.advance(0.75);
        assert_eq!((player.other, player.weight, player.fade), (None, 0.0, 0.0));
        assert_eq!((player.track.clip.as_str(), player.track.time), ("run", 2.5));
        let mut player = AnicPlayer::new(Handle::default());
        player.cross_fade(Track::new("walk"), 0.0);
        assert_eq!(player.track.clip, "walk");
    }

    #[test]
    fn weights_stay_without_a_fade() {
        let mut player = AnicPlayer::new(Handle::default());
        (player.other, player.weight) = (Some(Track::new("run")), 0.3);
        player.track.speed = -1.0;
        player.advance(2.0);
        assert_eq!((player.weight, player.track.time), (0.3, -2.0));
    }
}
