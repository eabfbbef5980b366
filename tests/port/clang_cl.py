#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Checks the decoder for clang-cl as far as goes without Visual C++'s headers and libraries, which no package has.

usage: clang_cl.py WORK ZSTD       WORK: a folder for the build; ZSTD: folder lib/ of zstd's source
- CMake configures for clang-cl.
- The kernels of prediction, which include nothing of a library but integer types, compile by clang-cl with CMake's flags, and no
  fused multiply-add is in them.
- The C header passes as C.
- All sources and headers pass Clang by the rules of Visual C++ (-fms-compatibility), with MinGW's headers instead.
Exit status 1 if anything is wrong, 77 if a program is absent.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
GCC = pathlib.Path("/usr/lib/gcc/x86_64-w64-mingw32/12-posix/include/c++")
KERNELS = ("prediction_portable", "prediction_avx2", "prediction_avx512")
# Integer types for a C++ without library.
STAND_INS = {"cstddef": "#include <stddef.h>\n", "cstdint": "#include <stdint.h>\n"}
MSVC_RULES = ["-fms-compatibility", "-fms-extensions", "-fdelayed-template-parsing", "-fms-compatibility-version=19.38"]
# MinGW's headers know Clang by these, which it leaves out with those rules.
AS_MINGW = ["-D__GNUC__=4", "-D__GNUC_MINOR__=2", "-D__GNUC_PATCHLEVEL__=1", "-D_WCHAR_T_DEFINED", "-D_NATIVE_WCHAR_T_DEFINED",
            "-D__GCC_ATOMIC_TEST_AND_SET_TRUEVAL=1",
            *(f"-D__GCC_ATOMIC_{kind}_LOCK_FREE=2" for kind in
              ("BOOL", "CHAR", "CHAR16_T", "CHAR32_T", "WCHAR_T", "SHORT", "INT", "LONG", "LLONG", "POINTER"))]


def tool(*names):
    """The first of some programs that there is, in Debian's folder of LLVM 14 too."""
    for name in names:
        if found := shutil.which(name) or shutil.which(name, path="/usr/lib/llvm-14/bin"):
            return found
    print(f"skipped: {names[0]} is not installed (apt-get install clang clang-tools lld llvm)")
    sys.exit(77)


def run(command):
    """The output of a program, or the end with it."""
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def configure(build, zstd):
    """The commands of all sources, by name."""
    options = {"SYSTEM_NAME": "Windows", "SYSTEM_PROCESSOR": "AMD64", "LINKER": tool("lld-link"), "AR": tool("llvm-lib"),
               "RC_COMPILER": tool("llvm-rc"), "MT": tool("llvm-mt"), "TRY_COMPILE_TARGET_TYPE": "STATIC_LIBRARY",
               "BUILD_TYPE": "Release", "EXPORT_COMPILE_COMMANDS": "ON"}
    for language in ("C", "CXX"):
        options[f"{language}_COMPILER"] = tool("clang-cl")
        options[f"{language}_COMPILER_TARGET"] = "x86_64-pc-windows-msvc"
    off = ("BUILD_ENCODER", "BUILD_TOOLS", "BUILD_TESTS", "BUILD_EXAMPLES", "WITH_DRACO")
    run(["cmake", "--fresh", "-S", ROOT, "-B", build, "-G", "Ninja", f"-DANICODEC_ZSTD_SOURCE={zstd}",
         *(f"-DCMAKE_{key}={value}" for key, value in options.items()), *(f"-DANICODEC_{key}=OFF" for key in off)])
    commands = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    return {pathlib.Path(c["file"]): c["command"].split() for c in commands if c["file"].endswith(".cpp")}


def check_kernels(commands, work):
    stand_ins = work / "stand_ins"
    stand_ins.mkdir(exist_ok=True)
    for name, text in STAND_INS.items():
        (stand_ins / name).write_text(text, encoding="utf-8")
    header = ROOT / "sdk/include/anicodec/anicodec.h"
    run([tool("clang-cl"), "--target=x86_64-pc-windows-msvc", "/W4", "/WX", "/clang:-ffreestanding", f"-I{ROOT / 'sdk/include'}", "/Zs", "/TC", "--", header])
    for source, command in commands.items():
        if source.stem not in KERNELS:
            continue
        made = work / f"{source.stem}.obj"
        end = command.index("--")
        flags = [word for word in command[:end] if not word.startswith(("/Fo", "/Fd"))]
        text = run([*flags, "/WX", "/clang:-ffreestanding", f"-imsvc{stand_ins}", f"/Fo{made}", "--", source])
        if text:
            sys.exit(f"{source.stem}: {text}")
        fused = len(re.findall(r"\tvf?n?m(?:add|sub)\w*ps|\tvfn?m\w+", run([tool("llvm-objdump", "llvm-objdump-14"), "-d", made])))
        if fused:
            sys.exit(f"{source.stem}: {fused} fused instructions")
        print(f"{source.stem}: compiles by clang-cl, nothing is fused")


def check_rules(commands):
    checked = 0
    headers = [path for folder in ("format", "sdk") for path in sorted((ROOT / folder).rglob("*.h*"))
               if "draco" not in path.as_posix()]
    some = next(iter(commands.values()))
    for source in [*commands, *headers]:
        words = [re.sub(r"^/clang:|^-imsvc", lambda m: "" if m.group() == "/clang:" else "-isystem", word)
                 for word in commands.get(source, some)]
        flags = [word for word in words if word.startswith(("-D", "-I", "-isystem", "-m"))]
        language = "c++" if source.suffix == ".cpp" else "c++-header"
        run([tool("clang++"), "--target=x86_64-w64-mingw32", "-isystem", GCC, "-isystem", GCC / "x86_64-w64-mingw32", *MSVC_RULES, *AS_MINGW,
             "-std=gnu++17", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-Wno-psabi", "-Wno-unused-const-variable",
             "-Wno-unused-function", f"-I{ROOT / 'sdk/include'}", *flags, "-x", language, source])
        checked += 1
    print(f"{checked} sources and headers pass by the rules of Visual C++")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    work = pathlib.Path(sys.argv[1])
    work.mkdir(parents=True, exist_ok=True)
    if not GCC.is_dir():
        print("skipped: MinGW's headers are not installed (apt-get install g++-mingw-w64-x86-64-posix)")
        sys.exit(77)
    commands = configure(work / "build", sys.argv[2])
    check_kernels(commands, work)
    check_rules(commands)


if __name__ == "__main__":
    main()
