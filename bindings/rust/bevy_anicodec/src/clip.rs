// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
use std::fmt;
use std::io;

use anicodec::{
    AttributeKind, Bounds, Clip, Context, Domain, OpenOptions, RenderOptions, RenderPlan, Status, UpAxis, When,
};
use bevy::asset::io::Reader;
use bevy::asset::{AssetLoader, LoadContext, RenderAssetUsages};
use bevy::camera::primitives::Aabb;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;
use serde::{Deserialize, Serialize};

/// An opened file, shared by all that play it.
#[derive(Asset, TypePath, Debug)]
pub struct AnicClip {
    clip: Clip,
    plans: Vec<RenderPlan>,
}

/// How a file is loaded: `asset_server.load_builder().with_settings(|settings: &mut AnicSettings| ...)`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(default)]
pub struct AnicSettings {
    /// Share of the components to open, in (0, 1]: fewer are coarser, smaller and faster.
    pub quality: f64,
    /// Names of the clips to open; none: all.
    pub clips: Vec<String>,
    /// Leaves the motion of the whole out of the positions, for games that move the entity by [`Clip::root_step`].
    pub in_place: bool,
    /// Degrees: edges are hard between polygons whose normals are further apart, in files that do not tell hard edges.
    pub crease_angle: f64,
    /// Most memory that opening takes; 0: the default of [`OpenOptions::max_bytes`].
    pub max_bytes: u64,
}

impl Default for AnicSettings {
    fn default() -> Self {
        Self { quality: 1.0, clips: Vec::new(), in_place: false, crease_angle: 60.0, max_bytes: 0 }
    }
}

impl AnicClip {
    /// Opens a file in memory: what the loader does with a file of the asset server.
    pub fn open(file: impl AsRef<[u8]>, settings: &AnicSettings) -> anicodec::Result<Self> {
        let clip = OpenOptions::new()
            .bounds(true)
            .quality(settings.quality)
            .clips(settings.clips.iter().cloned())
            .in_place(settings.in_place)
            .max_bytes(settings.max_bytes)
            .open(file)?;
        let plans = clip.meshes().map(|mesh| {
            mesh.render_plan(&RenderOptions {
                crease_angle: settings.crease_angle,
                reference_frame: first_frame(&clip, mesh.number),
                source_edges: true,
            })
        });
        let plans = plans.collect::<anicodec::Result<_>>()?;
        Ok(Self { clip, plans })
    }

    /// The file itself: names and lengths of its clips, events, materials, motion of the whole.
    pub fn clip(&self) -> &Clip {
        &self.clip
    }

    /// Render vertices of a mesh; none where there is no such mesh.
    pub(crate) fn plan(&self, mesh: u32) -> Option<&RenderPlan> {
        self.plans.get(mesh as usize)
    }

    pub(crate) fn has_mesh(&self, mesh: u32) -> bool {
        (mesh as usize) < self.plans.len()
    }

    pub(crate) fn is_z_up(&self) -> bool {
        self.clip.info().up == UpAxis::Z
    }

    /// Takes points from the axes of the file to those of Bevy, y up.
    pub(crate) fn turn(&self, points: &mut [[f32; 3]]) {
        if self.is_z_up() {
            for [_, y, z] in points {
                (*y, *z) = (*z, -*y);
            }
        }
    }

    /// A box of the file in the axes of Bevy.
    pub(crate) fn turned_box(&self, bounds: &Bounds) -> Aabb {
        let mut ends = [bounds.min, bounds.max];
        self.turn(&mut ends);
        let [a, b] = ends.map(Vec3::from);
        Aabb::from_min_max(a.min(b), a.max(b))
    }

    /// The box around all frames of a mesh, in Bevy's axes; none where the mesh is in no frame.
    pub fn bounds(&self, mesh: u32) -> Option<Aabb> {
        self.clip.bounds(mesh).ok().flatten().map(|bounds| self.turned_box(&bounds))
    }

    /// The look that the file gives a mesh, of its first material; textures are for the game to load.
    pub fn material(&self, mesh: u32) -> StandardMaterial {
        let label = self.plan(mesh).and_then(|plan| plan.groups().next()).map_or(0, |(material, _)| material);
        let names = self
            .clip
            .mesh(mesh)
            .ok()
            .and_then(|mesh| mesh.attributes().find(|attribute| attribute.kind == AttributeKind::Material));
        let found = names.zip(label.checked_sub(1)).and_then(|(names, label)| names.material(label).ok().flatten());
        let Some(found) = found else { return StandardMaterial::default() };
        let [r, g, b, a] = found.base_colour;
        let [er, eg, eb] = found.emissive;
        StandardMaterial {
            base_color: LinearRgba::new(r, g, b, a).into(),
            metallic: found.metallic,
            perceptual_roughness: found.roughness,
            emissive: LinearRgba::rgb(er, eg, eb),
            double_sided: found.double_sided,
            cull_mode: if found.double_sided { None } else { StandardMaterial::default().cull_mode },
            alpha_mode: match found.alpha {
                anicodec::AlphaMode::Mask => AlphaMode::Mask(found.alpha_cutoff),
                anicodec::AlphaMode::Blend => AlphaMode::Blend,
                _ => AlphaMode::Opaque,
            },
            ..default()
        }
    }

    /// A mesh of its own for a player: positions and normals as yet of no time, and what never moves.
    pub(crate) fn build_mesh(&self, number: u32) -> anicodec::Result<Mesh> {
        let (mut mesh, plan) = (self.build_faces(number)?, &self.plans[number as usize]);
        mesh.insert_attribute(Mesh::ATTRIBUTE_NORMAL, vec![[0.0, 0.0, 1.0]; plan.vertices().len()]);
        if let Some(colours) = self.colours(number) {
            let context = self.context_of_first(number)?;
            let values = plan.attribute(&context, When::Current, colours.0, 4)?;
            mesh.insert_attribute(Mesh::ATTRIBUTE_COLOR, values.as_chunks::<4>().0.to_vec());
        }
        Ok(mesh)
    }

    /// Indices, texture coordinates, and positions of the first frame that shows the mesh.
    pub(crate) fn build_faces(&self, number: u32) -> anicodec::Result<Mesh> {
        let plan = &self.plans[number as usize];
        let context = self.context_of_first(number)?;
        let mut positions = vec![[0.0; 3]; plan.vertices().len()];
        match plan.positions_into(&context, When::Current, &mut positions) {
            Err(error) if error.status() != Status::Absent => return Err(error),
            _ => self.turn(&mut positions),
        }
        let mut mesh = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
            .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
            .with_inserted_indices(Indices::U32(plan.indices().to_vec()));
        if let Some((uv, _)) = self.attribute(number, AttributeKind::Uv) {
            let mut values = plan.attribute(&context, When::Current, uv, 2)?.as_chunks::<2>().0.to_vec();
            values.iter_mut().for_each(|[_, v]| *v = 1.0 - *v);
            mesh.insert_attribute(Mesh::ATTRIBUTE_UV_0, values);
        }
        Ok(mesh)
    }

    fn context_of_first(&self, mesh: u32) -> anicodec::Result<Context> {
        let mut context = self.clip.context()?;
        context.seek_frame(first_frame(&self.clip, mesh))?;
        Ok(context)
    }

    /// The number of the mesh's colours, and whether they move.
    pub(crate) fn colours(&self, mesh: u32) -> Option<(u32, bool)> {
        self.attribute(mesh, AttributeKind::Colour)
    }

    /// The first attribute of a kind that vertices or corners have.
    fn attribute(&self, mesh: u32, kind: AttributeKind) -> Option<(u32, bool)> {
        let mesh = self.clip.mesh(mesh).ok()?;
        let found =
            mesh.attributes().find(|one| one.kind == kind && one.components > 0 && one.domain != Domain::Polygons);
        found.map(|one| (one.number, one.moves))
    }
}

/// The first frame that shows a mesh.
fn first_frame(clip: &Clip, mesh: u32) -> u32 {
    (0..clip.info().frame_count).find(|&frame| matches!(clip.frame_bounds(mesh, frame), Ok(Some(_)))).unwrap_or(0)
}

/// Loads `.anic` files as [`AnicClip`].
#[derive(Default, TypePath)]
pub struct AnicLoader;

/// A file that cannot be loaded.
#[derive(Debug)]
pub enum AnicLoadError {
    /// It cannot be read.
    Io(io::Error),
    /// It is damaged, asks for more than the limits, or needs what this build lacks.
    File(anicodec::Error),
}

impl fmt::Display for AnicLoadError {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(error) => error.fmt(to),
            Self::File(error) => error.fmt(to),
        }
    }
}

impl std::error::Error for AnicLoadError {}

impl AssetLoader for AnicLoader {
    type Asset = AnicClip;
    type Settings = AnicSettings;
    type Error = AnicLoadError;

    async fn load(
        &self,
        reader: &mut dyn Reader,
        settings: &AnicSettings,
        _context: &mut LoadContext<'_>,
    ) -> Result<AnicClip, AnicLoadError> {
        let mut file = Vec::new();
        reader.read_to_end(&mut file).await.map_err(AnicLoadError::Io)?;
        AnicClip::open(file, settings).map_err(AnicLoadError::File)
    }

    fn extensions(&self) -> &[&str] {
        &["anic"]
    }
}
