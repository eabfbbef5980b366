#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Tests the crates of bindings/rust: their declarations against the headers, their own tests and examples, and what they make of
the conformance and golden files against the facts and against the C++ decoder, byte for byte.

usage: run.py [--all] CHECKOUT WORK SDK_DECODER C_COMPILER CXX_COMPILER [LAUNCHER]
Exit status 77: skipped, for the reason printed. --all adds what takes minutes or other tools: the packages, built from their
own .crate files; documentation; the features draco and encoder (an installed libanicodec_encoder); Miri (a
nightly toolchain); libFuzzer; the declarations by bindgen (a libclang); times against C.
"""
import importlib.util
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

SKIPPED = 77
NEEDED = (1, 81)  # rust-version of bindings/rust/Cargo.toml
HEADERS = {"decoder.rs": "sdk/include/anicodec/anicodec.h", "encoder.rs": "codec/include/anicodec/encode.h"}
RENAMED = {"box_": "box", "loop_": "loop", "move_": "move"}  # words of Rust
# Facts that no function of anicodec.h tells.
UNTOLD = ("asked", "asked_value", "attribute_errors")


def run(*command, check=True, **options):
    print("+", *command, flush=True)
    result = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False,
                            **options)
    if check and result.returncode != 0:
        sys.exit(result.stdout)
    return result


def without_comments(text):
    return re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)


def declaration_faults(checkout, work, compiler):
    """Differences between what anicodec-sys declares and the headers. Its layouts are checked when it is compiled: they must
    be those of C, too."""
    sys.path.insert(0, str(checkout / "bindings" / "generate"))
    import headers
    prints, ours = [], {}
    declared = {"function": set(), "constant": set(), "struct": set()}
    told = {"function": set(), "constant": set(), "struct": set()}
    for source, header in HEADERS.items():
        rust = (checkout / "bindings/rust/anicodec-sys/src" / source).read_text(encoding="utf-8")
        c = without_comments(headers.text_of(checkout / header))
        told["function"] |= set(re.findall(r"ANIC_API[^;]*?\b(anic_\w+)\(", c))
        declared["function"] |= set(re.findall(r"\bpub fn (anic_\w+)\(", rust))
        told["constant"] |= set(re.findall(r"\b(ANIC_[A-Z0-9_]+) =\s*\d+", c)) | set(re.findall(r"#define (ANIC_[A-Z_]+) \d+\n", c))
        for name, value in re.findall(r"\bpub const (ANIC_\w+): \w+ = (\d+);", rust):
            declared["constant"].add(name)
            ours[f"constant {name}"] = value
            prints.append(f'printf("constant {name} %lld\\n", (long long){name});')
        bodies = dict(re.findall(r"^typedef struct (anic_\w+) \{\n(.*?)^\}", c, re.MULTILINE | re.DOTALL))
        sizes = dict(re.findall(r'\["Size of (\w+)"\]\s*\[\s*::core::mem::size_of::<\w+>\(\) - (\d+)usize,?\s*\]', rust))
        fields = re.findall(r'\["Offset of field: (\w+)::(\w+)"\]\s*\[\s*::core::mem::offset_of!\(\w+, \w+\) - (\d+)usize,?\s*\]', rust)
        told["struct"] |= bodies.keys()
        declared["struct"] |= sizes.keys()
        for name, size in sizes.items():
            ours[f"size {name}"] = size
            prints.append(f'printf("size {name} %zu\\n", sizeof({name}));')
        for name, field, offset in fields:
            field = RENAMED.get(field, field)
            ours[f"offset {name}.{field}"] = offset
            prints.append(f'printf("offset {name}.{field} %zu\\n", offsetof({name}, {field}));')
        for name, body in bodies.items():
            body = re.sub(r"\(\*(\w+)\)\(.*?\);", r"\1;", body, flags=re.DOTALL)
            for field in re.findall(r"(\w+)\s*(?:\[\w+\])?\s*[;,]", body):
                if f"offset {name}.{field}" not in ours:
                    yield f"Rust has no {name}.{field}"
    for kind, names in told.items():
        yield from (f"Rust has no {kind} {name}" for name in sorted(names - declared[kind]))
        yield from (f"the headers have no {kind} {name}" for name in sorted(declared[kind] - names))
    source = work / "layout.c"
    source.write_text("#include <anicodec/encode.h>\n#include <stddef.h>\n#include <stdio.h>\nint main(void) {\n" + "\n".join(prints) +
                      "\nreturn 0;\n}\n", encoding="utf-8")
    run(compiler, "-std=c11", "-I", checkout / "sdk/include", "-I", checkout / "codec/include", source, "-o", work / "layout")
    for line in run(work / "layout").stdout.splitlines():
        what, value = line.rsplit(" ", 1)
        if ours[what] != value:
            yield f"{what} is {ours[what]} in Rust, {value} in C"


def packed_faults(checkout, cargo):
    """Sources of the decoder that the package lacks."""
    packed = set(cargo("package", "-p", "anicodec-sys", "--list", "--allow-dirty").stdout.split())
    for module in ("format", "sdk"):
        for path in sorted((checkout / module).rglob("*")):
            name = path.relative_to(checkout).as_posix()
            if path.suffix in (".h", ".cpp") and not name.startswith(("sdk/examples/", "sdk/package/")) and f"cpp/{name}" not in packed:
                yield f"the package has no cpp/{name}"


def told_facts(folder, work):
    """The files of a folder with a manifest, and what the crate tells of them."""
    shutil.copytree(folder, work, symlinks=False, ignore=shutil.ignore_patterns("*.py", "*.md", "traces", "*.cpp", "*.h"))
    for path in (work / "facts").glob("*.json"):
        facts = json.loads(path.read_text(encoding="utf-8"))
        for clip in facts["clip"]["clips"]:
            for key in UNTOLD:
                clip.pop(key, None)
        path.write_text(json.dumps(facts), encoding="utf-8")
    return work


def check_files(checkout, work, decoder, sdk_decoder, with_draco):
    """Conformance and golden files."""
    conformance = checkout / "tests/conformance"
    without = [] if with_draco else ["--without", "draco"]
    specification = importlib.util.spec_from_file_location("conformance", conformance / "run.py")
    module = importlib.util.module_from_spec(specification)
    sys.path.insert(0, str(conformance))
    specification.loader.exec_module(module)
    for folder in (conformance, checkout / "tests/golden"):
        copy = told_facts(folder, work / folder.name)
        print(run(sys.executable, "-B", conformance / "run.py", "--memory", "0", *without, "--folder", copy, decoder, "{file}", "{out}").stdout, end="")
        files = 0
        for line in (folder / "MANIFEST").read_text(encoding="utf-8").splitlines():
            entry = module.Entry(line)
            if entry.kind not in ("valid", "stream") or entry.needs & {"draco"} and not with_draco:
                continue
            for name, program in (("rust", decoder), ("c", sdk_decoder)):
                run_quietly(program, folder / entry.name, work / name)
            written = sorted(path.name.removeprefix("c") for path in work.glob("c.*") if path.suffix != ".json")
            for suffix in written:
                if (work / f"c{suffix}").read_bytes() != (work / f"rust{suffix}").read_bytes():
                    sys.exit(f"{entry.name}: {suffix} is not what the C++ decoder writes")
            for path in (*work.glob("c.*"), *work.glob("rust.*")):
                path.unlink()
            files += 1
        print(f"{files} files of {folder.name} decode to the bytes of the C++ decoder")


def run_quietly(program, file, out):
    subprocess.run([program, file, out], check=True, stdout=subprocess.DEVNULL)


def main():
    arguments = sys.argv[1:]
    everything = arguments[:1] == ["--all"]
    arguments = arguments[everything:]
    if not 5 <= len(arguments) <= 6:
        sys.exit(__doc__)
    checkout, work, sdk_decoder = (pathlib.Path(path).resolve() for path in arguments[:3])
    version = re.search(r"cargo (\d+)\.(\d+)", run("cargo", "--version").stdout) if shutil.which("cargo") else None
    if version is None or tuple(map(int, version.groups())) < NEEDED:
        print(f"skipped: there is no cargo of {NEEDED[0]}.{NEEDED[1]} or later")
        sys.exit(SKIPPED)
    shutil.rmtree(work / "files", ignore_errors=True)
    (work / "files").mkdir(parents=True)
    launcher = [arguments[5]] if len(arguments) == 6 and arguments[5] else []
    environment = {**os.environ, "CARGO_TARGET_DIR": str(work / "target"), "CC": " ".join([*launcher, arguments[3]]),
                   "CXX": " ".join([*launcher, arguments[4]])}

    def cargo(*words, check=True, **more):
        return run("cargo", *words, check=check, cwd=checkout / "bindings/rust", env={**environment, **more})

    faults = list(declaration_faults(checkout, work / "files", arguments[3]))
    if faults:
        sys.exit("\n".join(faults))
    fetched = cargo("fetch", CARGO_NET_RETRY="1", CARGO_HTTP_TIMEOUT="20", check=False)
    if fetched.returncode != 0:
        print(fetched.stdout)
        print("skipped: Cargo's registry is not at hand")
        sys.exit(SKIPPED)
    if faults := list(packed_faults(checkout, cargo)):
        sys.exit("\n".join(faults))
    for tool, words in (("fmt", ("--check",)), ("clippy", ("--workspace", "--all-targets", "--", "-D", "warnings"))):
        if shutil.which(f"cargo-{tool}"):
            cargo(tool, *words)
    print(cargo("test", "--workspace", "--quiet").stdout, end="")
    cargo("build", "-p", "anicodec-tests")
    check_files(checkout, work / "files", work / "target/debug/anicodec-tests", sdk_decoder, False)
    if everything:
        check_everything(checkout, work, sdk_decoder, cargo)


def check_everything(checkout, work, sdk_decoder, cargo):
    """Checks that take minutes, or tools that few machines have. It fails where one is missing."""
    rust = checkout / "bindings/rust"
    with_features = [word for name in ("anicodec", "anicodec-tests") for word in ("-p", name)]
    with_features += ["--features", ",".join(f"{name}/{feature}" for name in with_features[1::2] for feature in ("draco", "encoder"))]
    cargo("doc", *with_features, "--no-deps", RUSTDOCFLAGS="-D warnings")
    run(rust / "package.sh", work / "packages", "--allow-dirty")
    cargo("clippy", *with_features, "--all-targets", "--", "-D", "warnings")
    print(cargo("test", *with_features, "--quiet").stdout, end="")
    cargo("build", "-p", "anicodec-tests", "--features", "draco")
    shutil.rmtree(work / "files")
    (work / "files").mkdir()
    check_files(checkout, work / "files", work / "target/debug/anicodec-tests", sdk_decoder, True)
    print(cargo("+nightly", "miri", "test", "-p", "anicodec", "--lib", "--quiet").stdout, end="")
    cargo("run", "--manifest-path", "bindgen/Cargo.toml", "--", "--check")
    fuzz(checkout, work, cargo)
    print_times(checkout, work, sdk_decoder.parents[1] / "sdk/package", cargo)


def fuzz(checkout, work, cargo):
    """A minute of libFuzzer, by what cargo-fuzz does. It follows Rust alone: tests/fuzz has targets that follow the decoder."""
    host = re.search(r"host: (\S+)", run("rustc", "-vV").stdout)[1]
    coverage = ("level=4", "inline-8bit-counters", "pc-table", "trace-compares")
    flags = ["--cfg", "fuzzing", "-Cpasses=sancov-module", "-Cdebug-assertions", *(f"-Cllvm-args=-sanitizer-coverage-{of}" for of in coverage)]
    cargo("build", "--manifest-path", "fuzz/Cargo.toml", "--target", host, CARGO_TARGET_DIR=str(work / "fuzz"), RUSTFLAGS=" ".join(flags))
    corpus = work / "corpus"
    corpus.mkdir(exist_ok=True)
    tests = checkout / "tests"
    told = run(work / "fuzz" / host / "debug/play", "-max_total_time=60", "-max_len=20000", corpus, tests / "conformance", tests / "golden", cwd=work)
    print(told.stdout.splitlines()[-1])


def print_times(checkout, work, libraries, cargo):
    """Milliseconds of opening and of a frame, in Rust and in C, of ANICODEC_CLIP or a golden file."""
    clip = os.environ.get("ANICODEC_CLIP", checkout / "tests/golden/large.anic")
    cargo("build", "--release", "-p", "anicodec", "--example", "times")
    run("cc", "-O2", "-I", checkout / "sdk/include", checkout / "tests/rust/times.c", "-o", work / "times", "-L", libraries, "-lanicodec",
        f"-Wl,-rpath,{libraries}")
    for name, program in (("Rust", work / "target/release/examples/times"), ("C", work / "times")):
        print(f"{name}: open and frame of {pathlib.Path(clip).name}, ms: {run(program, clip).stdout}", end="")


if __name__ == "__main__":
    main()
