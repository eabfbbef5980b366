// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#![doc = include_str!("../README.md")]

mod clip;
mod crowd;
mod player;
mod surface;

use bevy::asset::{AssetEventSystems, embedded_asset};
use bevy::camera::visibility::VisibilitySystems;
use bevy::pbr::MaterialPlugin;
use bevy::prelude::*;

pub use anicodec;
pub use anicodec::{Sampling, Wrap};
pub use clip::{AnicClip, AnicLoadError, AnicLoader, AnicSettings};
pub use crowd::{AnicBasis, AnicCrowdMaterial};
pub use player::{AnicPlayer, Track};

/// Loads `.anic` files, and plays them on entities with an [`AnicPlayer`]. Needs Bevy's assets, meshes and `PbrPlugin`.
pub struct AnicPlugin;

/// The systems that play, in [`PostUpdate`], in this order: time goes on, then it is shown. A system that chooses times of its
/// own runs before them.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct AnicSystems;

impl Plugin for AnicPlugin {
    fn build(&self, app: &mut App) {
        embedded_asset!(app, "crowd.wesl");
        app.init_asset::<AnicClip>()
            .init_asset_loader::<AnicLoader>()
            .add_plugins(MaterialPlugin::<AnicCrowdMaterial>::default())
            .init_resource::<crowd::Crowds>()
            .add_systems(
                PostUpdate,
                (
                    player::advance,
                    (player::forget_changed, crowd::forget_changed),
                    player::attach,
                    ApplyDeferred,
                    player::seek,
                    (surface::write, crowd::stage),
                )
                    .chain()
                    .in_set(AnicSystems)
                    // The renderer hears of meshes and buffers in the frame that they are written in.
                    .before(AssetEventSystems)
                    // ViewVisibility tells until then which entities were in sight.
                    .before(VisibilitySystems::VisibilityPropagate),
            );
    }
}
