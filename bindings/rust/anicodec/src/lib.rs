// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#![doc = include_str!("../README.md")]
#![no_std]

extern crate alloc;

mod clip;
mod context;
mod error;
mod gpu;
mod mesh;
mod options;
mod output;
mod plans;
mod raw;
mod stream;
mod text;

#[cfg(feature = "encoder")]
pub mod encode;

pub use clip::{read_bounds, read_metadata, version, Clip, Event, Info, NamedClip, Order, Rate, UpAxis};
pub use context::{Context, RootMotion, Sampling, Shown, When, Wrap};
pub use error::{Chunk, Error, Result, Status};
pub use gpu::{Basis, BasisKind, Correction, Part, Reconstruction, Target, Texture, TextureLayout};
pub use mesh::{AlphaMode, Attribute, AttributeKind, Domain, Index, Material, Mesh, Polygons};
pub use options::{OpenOptions, Progress, Requirements, Run};
pub use output::{Bounds, Format, Hit, Output, Ray, Side, SurfaceFrame, SurfacePoint, ValueFormat, ValueOutput};
pub use plans::{NormalGroups, NormalOptions, NormalPlan, RenderOptions, RenderPlan};
pub use stream::{Stream, StreamInfo};
pub use text::Text;
