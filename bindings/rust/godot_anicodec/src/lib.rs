// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#![doc = include_str!("../README.md")]

mod clip;
mod importer;
mod playback;
mod player;

use godot::prelude::*;

struct AnicExtension;

// SAFETY: the macro writes the entry point that anicodec.gdextension names, and nothing else defines one.
#[gdextension]
unsafe impl ExtensionLibrary for AnicExtension {}
