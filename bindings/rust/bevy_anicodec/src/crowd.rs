// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! Crowds: a vertex shader makes the vertices of all instances of a mesh from the basis of its clip, which lies in textures
//! that they share, and from a row of numbers for each instance.
use std::collections::HashMap;

use anicodec::{Basis, Clip, Reconstruction, Target, Texture, When};
use bevy::asset::{RenderAssetUsages, uuid_handle};
use bevy::image::Image;
use bevy::mesh::{MeshTag, MeshVertexAttribute, MeshVertexBufferLayoutRef, VertexAttributeValues, VertexFormat};
use bevy::pbr::{ExtendedMaterial, MaterialExtension, MaterialExtensionKey, MaterialExtensionPipeline};
use bevy::prelude::*;
use bevy::render::render_resource::{
    AsBindGroup, Extent3d, RenderPipelineDescriptor, SpecializedMeshPipelineError, TextureDimension, TextureFormat,
};
use bevy::render::renderer::RenderDevice;
use bevy::render::storage::ShaderBuffer;
use bevy::shader::ShaderRef;

use crate::clip::AnicClip;
use crate::player::{AnicPlayer, Instance, is_absent};

/// The material of a crowd: all entities with an [`AnicPlayer`] and the same material are one, and drawn by one call.
///
/// Each plays at a time and with a blend of its own. All play the same mesh of the same file. `base` is the look, the file's own by
/// [`AnicClip::material`]; `extension` is [`AnicBasis::default`], which the plugin fills.
pub type AnicCrowdMaterial = ExtendedMaterial<StandardMaterial, AnicBasis>;

const SHADER: &str = "embedded://bevy_anicodec/crowd.wesl";

/// Vertex of the clip, of each render vertex.
const VERTEX: MeshVertexAttribute = MeshVertexAttribute::new("AnicVertex", 0x616e_6963_0001, VertexFormat::Uint32);

/// Texels of a row before its parts, and of a part before its state.
const ROW_TEXELS: usize = 1;
const PART_TEXELS: usize = 2;
/// Parts that an instance shows at most.
const MAX_PARTS: usize = 4;
/// Floats of a region's state before its weights, and the place of the motion among them.
const STATE_FLOATS: usize = 28;
const MOTION: usize = 12;

/// The basis of a clip on the graphics card: of [`AnicCrowdMaterial`].
#[derive(Asset, AsBindGroup, TypePath, Clone, Debug)]
pub struct AnicBasis {
    #[texture(100, sample_type = "float", filterable = false, visibility(vertex))]
    pose: Handle<Image>,
    #[texture(101, sample_type = "s_int", visibility(vertex))]
    wide: Handle<Image>,
    #[texture(102, sample_type = "s_int", visibility(vertex))]
    narrow: Handle<Image>,
    #[storage(103, read_only, visibility(vertex))]
    states: Handle<ShaderBuffer>,
    /// Width and rows of a layer; texels of an instance.
    #[uniform(104, visibility(vertex))]
    layout: UVec4,
}

impl Default for AnicBasis {
    /// Nothing yet: a material that is not drawn, as none of its textures are there.
    fn default() -> Self {
        const NOTHING: Handle<Image> = uuid_handle!("6e1f5cf4-9d2e-4c8e-8a38-0d2b8d6c6a11");
        let states = uuid_handle!("b0a6e1fd-5a0d-4f43-93a5-6a5b3a0f7c2e");
        Self { pose: NOTHING, wide: NOTHING, narrow: NOTHING, states, layout: UVec4::ZERO }
    }
}

impl MaterialExtension for AnicBasis {
    fn vertex_shader() -> ShaderRef {
        SHADER.into()
    }

    fn fragment_shader() -> ShaderRef {
        SHADER.into()
    }

    fn prepass_vertex_shader() -> ShaderRef {
        SHADER.into()
    }

    fn deferred_vertex_shader() -> ShaderRef {
        SHADER.into()
    }

    fn deferred_fragment_shader() -> ShaderRef {
        SHADER.into()
    }

    fn specialize(
        _pipeline: &MaterialExtensionPipeline,
        descriptor: &mut RenderPipelineDescriptor,
        layout: &MeshVertexBufferLayoutRef,
        _key: MaterialExtensionKey<Self>,
    ) -> Result<(), SpecializedMeshPipelineError> {
        let mut attributes = vec![VERTEX.at_shader_location(0)];
        if layout.0.contains(Mesh::ATTRIBUTE_UV_0) {
            attributes.push(Mesh::ATTRIBUTE_UV_0.at_shader_location(1));
        }
        descriptor.vertex.buffers = vec![layout.0.get_layout(&attributes)?];
        Ok(())
    }
}

/// The crowds, by their material; none of a material that cannot be played.
#[derive(Resource, Default)]
pub(crate) struct Crowds(HashMap<AssetId<AnicCrowdMaterial>, Option<Crowd>>);

struct Crowd {
    file: AssetId<AnicClip>,
    mesh: u32,
    faces: Handle<Mesh>,
    states: Handle<ShaderBuffer>,
    /// By number of the segment; none for segments that do not move the mesh.
    segments: Vec<Option<Segment>>,
    /// Texels of an instance.
    stride: usize,
    z_up: bool,
    /// A row for each instance.
    staged: Vec<[f32; 4]>,
    count: usize,
}

/// The place of a segment in the textures, and what its state looks like.
struct Segment {
    /// First rows of pose, wide and narrow components; -1: it has no pose.
    first: [f32; 3],
    /// Components have three numbers and one weight each.
    vectors: bool,
    wide_texels: usize,
    region_texels: usize,
    regions: usize,
}

impl Segment {
    fn new(basis: &Basis, first: [u32; 3], has_pose: bool) -> Self {
        let vectors = basis.channels == 3;
        let texels = |components: u32| components.div_ceil(4) as usize * if vectors { 1 } else { 3 };
        let wide_texels = texels(basis.wide_components);
        let narrow_texels = texels(basis.components - basis.wide_components);
        let [pose, wide, narrow] = first.map(|row| row as f32);
        Self {
            first: [if has_pose { pose } else { -1.0 }, wide, narrow],
            vectors,
            wide_texels,
            region_texels: STATE_FLOATS / 4 + wide_texels + narrow_texels,
            regions: basis.regions as usize,
        }
    }

    /// Texels of the state of all regions.
    fn state_texels(&self) -> usize {
        self.regions * self.region_texels
    }
}

/// The three textures of all segments of a mesh, the segments below one another.
struct Textures {
    images: [Image; 3],
    width: u32,
    rows: u32,
    segments: Vec<Option<Segment>>,
}

const KINDS: [(Texture, TextureFormat); 3] = [
    (Texture::Pose, TextureFormat::Rgba32Float),
    (Texture::Wide, TextureFormat::Rgba32Sint),
    (Texture::Narrow, TextureFormat::Rgba16Sint),
];

impl Textures {
    fn new(clip: &Clip, mesh: u32, max_size: u32) -> Result<Self, String> {
        let told = |error: anicodec::Error| error.to_string();
        let mut bytes = [Vec::new(), Vec::new(), Vec::new()];
        let (mut heights, mut size) = ([0; 3], None);
        let mut segments = Vec::new();
        for number in 0..clip.info().segment_count {
            let basis = clip.basis(number).map_err(told)?;
            if basis.mesh != mesh || basis.target != Target::Positions {
                segments.push(None);
                continue;
            }
            if basis.reconstruction != Reconstruction::Linear {
                return Err(
                    "its geometry interpolation is made by the CPU: it plays without a material for crowds".into()
                );
            }
            let layout = clip.texture_layout(number, max_size).map_err(told)?;
            let (width, rows) = *size.get_or_insert((layout.width, layout.rows));
            if (width, rows) != (layout.width, layout.rows) {
                return Err("the segments of the mesh have textures of different widths".into());
            }
            segments.push(Some(Segment::new(&basis, heights, layout.pose_height > 0)));
            for ((kind, _), (bytes, height)) in KINDS.iter().zip(bytes.iter_mut().zip(&mut heights)) {
                let (_, more, size) = layout.size(*kind);
                let begin = bytes.len();
                bytes.resize(begin + size, 0);
                clip.write_texture(number, *kind, &layout, 0, &mut bytes[begin..]).map_err(told)?;
                *height += more;
            }
        }
        let Some((width, rows)) = size else { return Err("nothing moves the mesh".into()) };
        if let Some(height) = heights.into_iter().find(|&height| height > max_size) {
            return Err(format!("its textures take {height} rows, and the graphics card has {max_size}"));
        }
        let mut images = bytes.into_iter().zip(heights).zip(KINDS).map(|((mut bytes, height), (_, format))| {
            // A texture has one row at least.
            let height = height.max(1);
            bytes.resize((width * height * format.block_copy_size(None).unwrap_or(16)) as usize, 0);
            let extent = Extent3d { width, height, depth_or_array_layers: 1 };
            Image::new(extent, TextureDimension::D2, bytes, format, RenderAssetUsages::RENDER_WORLD)
        });
        let images = [images.next(), images.next(), images.next()].map(Option::unwrap_or_default);
        Ok(Self { images, width, rows, segments })
    }
}

impl Crowd {
    fn new(
        file: AssetId<AnicClip>,
        mesh: u32,
        clip: &AnicClip,
        max_size: u32,
        (images, meshes, buffers): (&mut Assets<Image>, &mut Assets<Mesh>, &mut Assets<ShaderBuffer>),
    ) -> Result<(Self, AnicBasis), String> {
        let textures = Textures::new(clip.clip(), mesh, max_size)?;
        let mut faces = clip.build_faces(mesh).map_err(|error| error.to_string())?;
        let vertices = clip.plan(mesh).map_or(&[][..], |plan| plan.vertices()).to_vec();
        faces.insert_attribute(VERTEX, VertexAttributeValues::Uint32(vertices));
        let parts = textures.segments.iter().flatten().count().min(MAX_PARTS);
        let largest = textures.segments.iter().flatten().map(Segment::state_texels).max().unwrap_or(0);
        let stride = ROW_TEXELS + parts * (PART_TEXELS + largest);
        let states = buffers.add(ShaderBuffer::from(vec![[0_f32; 4]; stride]));
        let [pose, wide, narrow] = textures.images.map(|image| images.add(image));
        let layout = UVec4::new(textures.width, textures.rows, stride as u32, 0);
        let basis = AnicBasis { pose, wide, narrow, states: states.clone(), layout };
        let (segments, z_up) = (textures.segments, clip.is_z_up());
        let faces = meshes.add(faces);
        Ok((Self { file, mesh, faces, states, segments, stride, z_up, staged: Vec::new(), count: 0 }, basis))
    }

    /// Adds the row of an instance, and returns its number.
    fn add(&mut self, instance: &Instance) -> anicodec::Result<u32> {
        let number = self.count;
        self.count += 1;
        if self.staged.len() < self.count * self.stride {
            self.staged.resize(self.count.next_power_of_two() * self.stride, [0.0; 4]);
        }
        let row = &mut self.staged[number * self.stride..][..self.stride];
        // No parts: all vertices in one point, which draws nothing.
        row[0] = [0.0; 4];
        let shown = instance.context.shown(self.mesh, When::Current);
        let parts = match shown.parts() {
            Err(error) if is_absent(&error) => return Ok(number as u32),
            parts => parts?,
        };
        let mut at = ROW_TEXELS;
        for (number, part) in parts.iter().enumerate() {
            let Some(Some(segment)) = self.segments.get(part.segment as usize) else { continue };
            let [pose, wide, narrow] = segment.first;
            let texels = segment.state_texels();
            row[at] = [narrow, wide, pose, (PART_TEXELS + texels) as f32];
            row[at + 1] = [f32::from(segment.vectors), segment.wide_texels as f32, segment.region_texels as f32, 0.0];
            let state = &mut row[at + PART_TEXELS..][..texels];
            shown.state_into(number as u32, state.as_flattened_mut())?;
            if self.z_up {
                for region in state.chunks_mut(segment.region_texels) {
                    let [_, y, z] = &mut region[MOTION / 4..][..3] else { continue };
                    (*y, *z) = (*z, y.map(|number| -number));
                }
            }
            at += PART_TEXELS + texels;
        }
        row[0][0] = parts.len() as f32;
        Ok(number as u32)
    }
}

/// Lets go of crowds whose file was loaded again, or whose material is gone.
pub(crate) fn forget_changed(
    mut crowds: ResMut<Crowds>,
    mut files: MessageReader<AssetEvent<AnicClip>>,
    mut materials: MessageReader<AssetEvent<AnicCrowdMaterial>>,
) {
    for event in files.read() {
        if let AssetEvent::Modified { id } = event {
            crowds.0.retain(|_, crowd| crowd.as_ref().is_some_and(|crowd| crowd.file != *id));
        }
    }
    for event in materials.read() {
        if let AssetEvent::Unused { id } = event {
            crowds.0.remove(id);
        }
    }
}

type Players<'w, 's> = Query<
    'w,
    's,
    (
        Entity,
        Ref<'static, Instance>,
        &'static MeshMaterial3d<AnicCrowdMaterial>,
        Option<&'static Mesh3d>,
        Option<&'static MeshTag>,
    ),
    With<AnicPlayer>,
>;

/// Writes the row of each instance, and makes crowds for materials that are new.
#[expect(clippy::too_many_arguments, reason = "a system")]
pub(crate) fn stage(
    mut commands: Commands,
    mut crowds: ResMut<Crowds>,
    clips: Res<Assets<AnicClip>>,
    mut materials: ResMut<Assets<AnicCrowdMaterial>>,
    mut images: ResMut<Assets<Image>>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut buffers: ResMut<Assets<ShaderBuffer>>,
    device: Option<Res<RenderDevice>>,
    players: Players,
) {
    let max_size = device.map_or(8192, |device| device.limits().max_texture_dimension_2d);
    for crowd in crowds.0.values_mut().flatten() {
        crowd.count = 0;
    }
    for (entity, instance, material, mesh, tag) in &players {
        let crowd = crowds.0.entry(material.id()).or_insert_with(|| {
            let clip = clips.get(instance.file)?;
            let assets = (&mut *images, &mut *meshes, &mut *buffers);
            match Crowd::new(instance.file, instance.mesh, clip, max_size, assets) {
                Ok((crowd, basis)) => {
                    materials.get_mut(material.id())?.extension = basis;
                    Some(crowd)
                }
                Err(fault) => {
                    error!("AnicCrowdMaterial: {fault}");
                    None
                }
            }
        });
        let Some(crowd) = crowd else { continue };
        if (crowd.file, crowd.mesh) != (instance.file, instance.mesh) {
            error_once!("AnicPlayer of entity {entity}: its material belongs to a crowd of another file or mesh");
            continue;
        }
        match crowd.add(&instance) {
            Ok(number) => {
                if tag.is_none_or(|tag| tag.value != number) {
                    commands.entity(entity).insert(MeshTag::new(number));
                }
                if mesh.is_none_or(|mesh| mesh.0 != crowd.faces) {
                    commands.entity(entity).insert(Mesh3d(crowd.faces.clone()));
                }
            }
            Err(error) => error_once!("AnicPlayer of entity {entity}: {error}"),
        }
    }
    for crowd in crowds.0.values().flatten().filter(|crowd| crowd.count > 0) {
        if let Some(mut buffer) = buffers.get_mut(&crowd.states) {
            // The renderer takes the rows of the frame before out of it.
            buffer.clear();
            buffer.extend_from_slice(&crowd.staged);
        }
    }
}
