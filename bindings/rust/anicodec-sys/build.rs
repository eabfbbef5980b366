// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! Compiles the decoder, the folders cpp/format and cpp/sdk, as the CMake files there do. zstd and the header of xxHash are
//! those of zstd-sys.
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// Rooms that are compiled as one source, which parses their headers once.
const TOGETHER: [&[&str]; 2] =
    [&["sdk/pose", "sdk/mesh", "sdk/segment", "sdk/exact"], &["sdk/play", "sdk/prediction", "sdk/base"]];

/// Sources that take most of the time, or flags of their own. They are compiled alone.
const ALONE: [(&str, Flags); 14] = [
    ("format/coding/binary_coder.cpp", Flags::USUAL),
    ("format/coding/coefficient_model.cpp", Flags::USUAL),
    ("sdk/api/bounds.cpp", Flags::USUAL),
    ("sdk/segment/linear_segment.cpp", Flags::USUAL),
    ("sdk/msgi/msgi.cpp", Flags::fast(&[])),
    ("sdk/msgi/sparse_ldlt.cpp", Flags::fast(&[])),
    ("sdk/prediction/vertex_order.cpp", Flags::fast(&[])),
    ("sdk/segment/residual_reader.cpp", Flags::fast(&[])),
    ("sdk/prediction/prediction_portable.cpp", Flags::fast(&[])),
    ("sdk/prediction/prediction_avx2.cpp", Flags::fast(&["-mavx2"])),
    ("sdk/prediction/prediction_avx512.cpp", Flags::fast(&["-mavx2", "-mavx512f", "-mavx512vl"])),
    ("sdk/play/play_portable.cpp", Flags::fast(&[])),
    ("sdk/play/play_avx2.cpp", Flags::fast(&["-mavx2", "-mfma", "-mf16c"])),
    (
        "sdk/play/play_avx512vl.cpp",
        Flags::fast(&["-mavx2", "-mfma", "-mf16c", "-mavx512f", "-mavx512vl", "-mprefer-vector-width=256"]),
    ),
];
const PLAY_AVX512: (&str, Flags) = (
    "sdk/play/play_avx512.cpp",
    Flags::fast(&["-mavx2", "-mfma", "-mf16c", "-mavx512f", "-mavx512vl", "-mprefer-vector-width=512"]),
);

#[derive(Clone, Copy, PartialEq)]
struct Flags {
    level: u32,
    /// Flags for x86-64 alone.
    instructions: &'static [&'static str],
}

impl Flags {
    const USUAL: Flags = Flags { level: 2, instructions: &[] };

    const fn fast(instructions: &'static [&'static str]) -> Flags {
        Flags { level: 3, instructions }
    }
}

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap()).join("cpp");
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap());
    assert!(
        root.join("format").is_dir(),
        "anicodec-sys: {} is no folder: this checkout has no symbolic links (git config core.symlinks true)",
        root.join("format").display()
    );
    // Clippy links nothing, and what it builds serves nobody else.
    println!("cargo::rerun-if-env-changed=CLIPPY_ARGS");
    if env::var_os("CLIPPY_ARGS").is_some() {
        return;
    }
    println!("cargo::metadata=include={}", root.join("sdk/include").display());

    let mut sources = Vec::new();
    for module in ["format", "sdk"] {
        find_sources(&root, module, &mut sources);
    }
    let draco = env::var_os("CARGO_FEATURE_DRACO").is_some();
    sources.retain(|source| {
        let absent = ["sdk/msgi/msgi_absent.cpp", "sdk/exact/exact_absent.cpp"];
        let other = ["sdk/mesh/draco_poses.cpp", "sdk/mesh/draco_absent.cpp"];
        !absent.contains(&source.as_str()) && source != other[usize::from(draco)]
    });

    let mut objects = Vec::new();
    let mut rooms: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut alone: Vec<(&Flags, Vec<PathBuf>)> = Vec::new();
    for source in sources {
        let special = ALONE.iter().chain([&PLAY_AVX512]).find(|(path, _)| *path == source);
        if let Some((path, flags)) = special {
            match alone.iter_mut().find(|(other, _)| *other == flags) {
                Some((_, group)) => group.push(root.join(path)),
                None => alone.push((flags, vec![root.join(path)])),
            }
        } else if source.ends_with("draco_poses.cpp") {
            objects.extend(draco_objects(&root, &root.join(source)));
        } else {
            let folder = source.rsplit_once('/').unwrap().0;
            let room = TOGETHER.iter().find(|rooms| rooms.contains(&folder));
            let room = room.map_or(folder, |rooms| rooms[0]).to_owned();
            rooms.entry(room).or_default().push(source);
        }
    }
    let mut unities = Vec::new();
    for (room, sources) in rooms {
        let unity = out.join(format!("{}.cpp", room.replace('/', "_")));
        let text: String = sources.iter().map(|source| format!("#include \"{source}\"\n")).collect();
        fs::write(&unity, text).expect("a source in OUT_DIR");
        unities.push(unity);
    }
    objects.extend(compiler(&root).files(unities).compile_intermediates());
    for (flags, files) in alone {
        objects.extend(compile_alone(&root, *flags, files));
    }
    compiler(&root).objects(objects).compile("anicodec");

    #[cfg(feature = "draco")]
    pkg_config::probe_library("draco").expect("the feature draco needs Draco's library (Debian: libdraco-dev)");
    #[cfg(feature = "encoder")]
    pkg_config::Config::new().atleast_version(env!("CARGO_PKG_VERSION")).probe("anicodec_encoder").expect(
        "the feature encoder needs an installed libanicodec_encoder; PKG_CONFIG_PATH names a folder of its own",
    );
}

/// Sources below a folder, as paths from `root` on, in an order that is always the same.
fn find_sources(root: &Path, folder: &str, out: &mut Vec<String>) {
    let mut entries: Vec<_> = fs::read_dir(root.join(folder))
        .unwrap_or_else(|error| panic!("{folder}: {error}"))
        .map(|entry| entry.expect("an entry of a folder"))
        .collect();
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let name = entry.file_name().into_string().expect("a name in UTF-8");
        let path = format!("{folder}/{name}");
        if entry.path().is_dir() {
            if !["sdk/examples", "sdk/package"].contains(&path.as_str()) {
                find_sources(root, &path, out);
            }
        } else if name.ends_with(".h") || name.ends_with(".cpp") {
            println!("cargo::rerun-if-changed={}", entry.path().display());
            if name.ends_with(".cpp") {
                out.push(path);
            }
        }
    }
}

/// A compiler with what all sources are compiled with. Optimised in every profile: slow decoding helps nobody.
fn compiler(root: &Path) -> cc::Build {
    let mut build = cc::Build::new();
    build
        .cpp(true)
        .std("c++17")
        .include(root)
        .include(root.join("sdk/include"))
        .opt_level(2)
        .debug(false)
        .warnings(false)
        .define("NDEBUG", None)
        .define("XXH_INLINE_ALL", None)
        .define("ANICODEC_DECODER_ONLY", None)
        // Integers that are predicted must come out the same everywhere.
        .flag("-ffp-contract=off")
        .flag("-fno-rtti")
        .flag("-ffunction-sections")
        .flag("-fdata-sections")
        .flag("-fvisibility=hidden")
        .flag("-fvisibility-inlines-hidden")
        .flag_if_supported("-Wno-psabi");
    assert!(
        !build.get_compiler().is_like_msvc(),
        "anicodec-sys needs GCC or Clang: the decoder's kernels use their vectors"
    );
    // Headers of zstd, with that of xxHash beside them, or of the system where zstd-sys uses its library.
    for folder in env::var("DEP_ZSTD_INCLUDE").unwrap_or_default().split(';') {
        build.flag(format!("-isystem{folder}"));
        build.flag(format!("-isystem{folder}/common"));
    }
    if is_x86_64() {
        build.define("ANICODEC_PREDICTION_AVX2", None);
        build.define("ANICODEC_PLAY_AVX2", None);
    }
    build
}

fn compile_alone(root: &Path, flags: Flags, files: Vec<PathBuf>) -> Vec<PathBuf> {
    let mut build = compiler(root);
    build.opt_level(flags.level).files(files);
    if is_x86_64() {
        for flag in flags.instructions {
            build.flag(flag);
        }
    }
    build.compile_intermediates()
}

fn draco_objects(root: &Path, source: &Path) -> Vec<PathBuf> {
    compiler(root).include(root.join("sdk/draco_headers")).file(source).compile_intermediates()
}

fn is_x86_64() -> bool {
    env::var("CARGO_CFG_TARGET_ARCH").is_ok_and(|arch| arch == "x86_64")
}
