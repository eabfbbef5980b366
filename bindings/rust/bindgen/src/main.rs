// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! Writes the declarations of anicodec-sys from the headers; with --check, tells whether they are what it would write.
//! Needs a libclang.
use std::path::Path;
use std::process::exit;

fn declarations(repository: &Path, header: &str, skipped: Option<&str>) -> String {
    let mut builder = bindgen::Builder::default()
        .header(repository.join(header).to_str().expect("a path in UTF-8"))
        // As C++, since enumerations are types of their own there.
        .clang_args(["-xc++", "-std=c++11"])
        .clang_arg(format!("-I{}", repository.join("sdk/include").display()))
        .allowlist_item("(anic|ANIC)_.*")
        .blocklist_item("anic_init|ANIC_INT32")
        .prepend_enum_name(false)
        .default_macro_constant_type(bindgen::MacroTypeVariation::Unsigned)
        .use_core()
        .generate_comments(false)
        .derive_debug(false)
        .merge_extern_blocks(true)
        .rustfmt_configuration_file(Some(repository.join("bindings/rust/rustfmt.toml")))
        .disable_header_comment();
    if let Some(file) = skipped {
        builder = builder.blocklist_file(file);
    }
    let uses = if skipped.is_some() { "use crate::decoder::*;\n" } else { "" };
    let text = builder.generate().expect("declarations").to_string();
    // Layouts are those of this machine.
    let text = text.replace("const _: () = {", "#[cfg(target_pointer_width = \"64\")]\nconst _: () = {");
    format!("// SPDX-License-Identifier: Apache-2.0\n// SPDX-FileCopyrightText: The anicodec authors\n// bindings/rust/bindgen wrote this.\n\
         #![allow(missing_docs, non_camel_case_types)]\n{uses}{text}")
}

fn main() {
    let check = match std::env::args().nth(1).as_deref() {
        None => false,
        Some("--check") => true,
        Some(_) => {
            eprintln!("usage: anicodec-bindgen [--check]");
            exit(2);
        }
    };
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..").canonicalize().expect("a checkout");
    let sources = repository.join("bindings/rust/anicodec-sys/src");
    let mut stale = false;
    for (name, header, skipped) in [
        ("decoder.rs", "sdk/include/anicodec/anicodec.h", None),
        ("encoder.rs", "codec/include/anicodec/encode.h", Some(".*sdk/include/anicodec/.*\\.h")),
    ] {
        let text = declarations(&repository, header, skipped);
        let file = sources.join(name);
        if !check {
            std::fs::write(&file, text).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        } else if std::fs::read_to_string(&file).ok().as_ref() != Some(&text) {
            println!(
                "{} is not what {header} says: run cargo run --manifest-path bindings/rust/bindgen/Cargo.toml",
                file.display()
            );
            stale = true;
        }
    }
    exit(i32::from(stale));
}
