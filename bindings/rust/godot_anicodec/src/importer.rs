// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
use godot::classes::{EditorImportPlugin, EditorPlugin, FileAccess, IEditorImportPlugin, IEditorPlugin, ResourceSaver};
use godot::global::Error;
use godot::prelude::*;

use crate::clip::{AnicClip, Opened};

/// Imports `.anic` files as `AnicClip`.
#[derive(GodotClass)]
#[class(tool, init, base = EditorImportPlugin)]
struct AnicImporter {
    base: Base<EditorImportPlugin>,
}

const IN_PLACE: &str = "in_place";

#[godot_api]
impl IEditorImportPlugin for AnicImporter {
    fn get_importer_name(&self) -> GString {
        "anicodec.clip".into()
    }

    fn get_visible_name(&self) -> GString {
        "Anic Clip".into()
    }

    fn get_recognized_extensions(&self) -> PackedStringArray {
        PackedStringArray::from([GString::from("anic")])
    }

    fn get_save_extension(&self) -> GString {
        "res".into()
    }

    fn get_resource_type(&self) -> GString {
        "AnicClip".into()
    }

    fn get_priority(&self) -> f32 {
        1.0
    }

    fn get_import_order(&self) -> i32 {
        0
    }

    fn get_preset_count(&self) -> i32 {
        1
    }

    fn get_preset_name(&self, _preset: i32) -> GString {
        "Default".into()
    }

    fn get_import_options(&self, _path: GString, _preset: i32) -> Array<AnyDictionary> {
        let option = vdict! { "name" => IN_PLACE, "default_value" => false };
        [option.upcast_any_dictionary()].into_iter().collect()
    }

    fn get_option_visibility(&self, _path: GString, _option: StringName, _options: VarDictionary) -> bool {
        true
    }

    fn import(
        &mut self,
        source_file: GString,
        save_path: GString,
        options: VarDictionary,
        _platform_variants: Array<GString>,
        _gen_files: Array<GString>,
    ) -> Error {
        let data = FileAccess::get_file_as_bytes(&source_file);
        if data.is_empty() {
            godot_error!("{source_file}: it is empty, or cannot be read");
            return Error::ERR_FILE_CANT_READ;
        }
        let in_place = options.get(IN_PLACE).is_some_and(|value| value.booleanize());
        // A damaged file fails here, not in a game.
        if let Err(error) = Opened::new(data.as_slice(), in_place) {
            godot_error!("{source_file}: {error}");
            return Error::ERR_FILE_CORRUPT;
        }
        let mut clip = AnicClip::new_gd();
        clip.bind_mut().set_data(data);
        clip.bind_mut().set_in_place(in_place);
        ResourceSaver::singleton().save_ex(&clip).path(&format!("{save_path}.{}", self.get_save_extension())).done()
    }
}

/// Gives the editor the importer.
#[derive(GodotClass)]
#[class(tool, init, base = EditorPlugin)]
struct AnicEditorPlugin {
    importer: Option<Gd<AnicImporter>>,
    base: Base<EditorPlugin>,
}

#[godot_api]
impl IEditorPlugin for AnicEditorPlugin {
    fn enter_tree(&mut self) {
        let importer = AnicImporter::new_gd();
        self.base_mut().add_import_plugin(&importer);
        self.importer = Some(importer);
    }

    fn exit_tree(&mut self) {
        if let Some(importer) = self.importer.take() {
            self.base_mut().remove_import_plugin(&importer);
        }
    }
}
