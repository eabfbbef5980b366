#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Makes libraries to link with in place of this machine's glibc: glibc_stubs.py VERSION OUT.

They offer what glibc of that version offers, under the versions that it knows, so that a program linked with them runs on it
and on all later ones. Their functions are empty: the real ones are found when the program starts. A function that this glibc has
and the older one lacks is missing, and the linker says so; old_glibc.c has the few that are needed.
"""
import pathlib
import re
import subprocess
import sys

# Libraries of their own until glibc 2.34, which still answers to their names.
APART = {"libpthread.so.0": r"(pthread|sem)_\w+", "libdl.so.2": r"dl(open|close|sym|vsym|error|addr|addr1|info|mopen)"}
SYMBOL = re.compile(r"^[0-9a-f]+ .{6}(?P<kind>[FO ]) +\S+\s+(?P<size>[0-9a-f]+) +\(?GLIBC_(?P<version>[0-9.]+)\)? +(?P<name>\w+)$")


def numbers(version):
    return tuple(map(int, version.split(".")))


def symbols_of(library, newest):
    """{name: (version, is a function, bytes)}: of each the last version that is not too new."""
    text = subprocess.run(["objdump", "-T", library], check=True, capture_output=True, text=True).stdout
    chosen = {}
    for match in filter(None, map(SYMBOL.match, text.splitlines())):
        name, version = match["name"], match["version"]
        if numbers(version) <= newest and (name not in chosen or numbers(version) > numbers(chosen[name][0])):
            chosen[name] = version, match["kind"] != "O", int(match["size"], 16)
    return chosen


def write_stub(out, library, symbols):
    lines = []
    for number, (name, (version, is_function, size)) in enumerate(sorted(symbols.items())):
        lines += [".text" if is_function else ".data", f".globl stub{number}",
                  f".type stub{number}, {'@function' if is_function else '@object'}", f".size stub{number}, {size}",
                  f"stub{number}: .zero {1 if is_function else size or 8}",
                  f".symver stub{number}, {name}@@GLIBC_{version}, remove"]
    lines.append('.section .note.GNU-stack, "", @progbits')
    versions = sorted({version for version, _, _ in symbols.values()}, key=numbers)
    script = out / f"{library}.map"
    script.write_text("".join(f"GLIBC_{version} {{}};\n" for version in versions))
    source = out / f"{library}.s"
    source.write_text("\n".join(lines) + "\n")
    subprocess.run(["cc", "-shared", "-nostdlib", f"-Wl,-soname,{library}", f"-Wl,--version-script={script}", source, "-o",
                    out / library], check=True)


def where(name):
    """The path of a library that the compiler links with."""
    path = subprocess.run(["cc", f"-print-file-name={name}"], check=True, capture_output=True, text=True).stdout.strip()
    return pathlib.Path(path).resolve()


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    newest, out = numbers(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    out.mkdir(parents=True, exist_ok=True)
    libc = symbols_of(where("libc.so.6"), newest)
    for library, pattern in APART.items():
        write_stub(out, library, {name: libc.pop(name) for name in list(libc) if re.fullmatch(pattern, name)})
    write_stub(out, "libc.so.6", libc)
    write_stub(out, "libm.so.6", symbols_of(where("libm.so.6"), newest))
    subprocess.run(["cc", "-O2", "-fPIC", "-fvisibility=hidden", "-c", pathlib.Path(__file__).with_name("old_glibc.c"),
                    "-o", out / "old_glibc.o"], check=True)
    subprocess.run(["ar", "crD", out / "libold_glibc.a", out / "old_glibc.o"], check=True)
    loader = where("ld-linux-x86-64.so.2")
    (out / "libc.so").write_text(f"GROUP({out}/libc.so.6 {out}/libold_glibc.a {where('libc_nonshared.a')} "
                                 f"AS_NEEDED({' '.join(str(out / name) for name in APART)} {loader}))\n")
    (out / "libm.so").write_text(f"GROUP({out}/libm.so.6)\n")


if __name__ == "__main__":
    main()
