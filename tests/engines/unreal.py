#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Compiles the plug-in for Unreal against stubs of Unreal's headers, runs it on them, and its build rules on stubs of
UnrealBuildTool. No part of Unreal is run.

usage: unreal.py CHECKOUT LIBRARY WORK CXX_COMPILER [LAUNCHER]
Exit status 77: skipped, for the reason printed. Without Mono the rules are left out, which a line says.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys

SKIPPED = 77


def run(*command, **options):
    result = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False, **options)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{result.stdout}")
    return result.stdout


def check_rules(plugin, tests, work):
    """The rules name the modules of Unreal, and the files of the library, which they miss where they are not there."""
    sources = sorted(plugin.rglob("*.Build.cs"))
    run("mcs", "-warnaserror", f"-out:{work / 'rules.exe'}", tests / "rules_test.cs", *sources)
    folder = work / "AnicodecLibrary"
    told = run("mono", work / "rules.exe", "Linux", folder)
    if f"AnicodecLibrary refused: anicodec: there is no {folder}/lib/Linux/libanicodec.so" not in told:
        sys.exit(f"a library that is not there:\n{told}")
    for platform, names in (("Linux", ["libanicodec.so"]), ("Mac", ["libanicodec.dylib"]), ("Win64", ["anicodec.lib", "anicodec.dll"])):
        here = folder / "lib" / platform
        here.mkdir(parents=True)
        for name in names:
            (here / name).touch()
        told = run("mono", work / "rules.exe", platform, folder)
        lines = {line.split()[0]: line.split()[1:] for line in told.splitlines()}
        wanted = {"Anicodec": ["Core", "CoreUObject", "Engine", "ProceduralMeshComponent", "AnicodecLibrary"],
                  "AnicodecEditor": ["Core", "CoreUObject", "Engine", "UnrealEd", "Anicodec"],
                  "AnicodecLibrary": [str(folder / "include"), *(str(here / name) for name in (names[0], names[-1])),
                                      *(["ANIC_SHARED=1"] if platform == "Win64" else [])]}
        if lines != wanted:
            sys.exit(f"{platform}:\n{told}")
    print("the build rules say what they should, for Linux, macOS and Windows")


def check_modules(plugin):
    """Every module of the description has rules, and the names of Unreal's conventions: NAME/NAME.Build.cs, IMPLEMENT_MODULE."""
    described = json.loads((plugin / "Anicodec.uplugin").read_text(encoding="utf-8"))
    for module in described["Modules"]:
        folder = plugin / "Source" / module["Name"]
        rules = (folder / f"{module['Name']}.Build.cs").read_text(encoding="utf-8")
        assert re.search(rf"class {module['Name']} : ModuleRules", rules), module
        code = "".join(path.read_text(encoding="utf-8") for path in folder.rglob("*.cpp"))
        assert f"IMPLEMENT_MODULE(FDefaultModuleImpl, {module['Name']})" in code, module
        for header in folder.rglob("*.h"):
            includes = re.findall(r'#include "(.*)"', header.read_text(encoding="utf-8"))
            assert includes[-1] == f"{header.stem}.generated.h", f"{header}: its generated header comes last"


def main():
    if not 5 <= len(sys.argv) <= 6:
        sys.exit(__doc__)
    checkout, library, work = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
    if "sanitize" in (library.parents[2] / "CMakeCache.txt").read_text(encoding="utf-8", errors="replace"):
        print("skipped: a library with sanitizers cannot be linked into a program without them")
        sys.exit(SKIPPED)
    launcher = [sys.argv[5]] if len(sys.argv) == 6 and sys.argv[5] else []
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    plugin, tests = checkout / "bindings/engines/unreal", checkout / "tests/engines/unreal"
    check_modules(plugin)
    flags = ["-std=c++20", "-O1", "-Wall", "-Wextra", "-Werror", "-Wno-unused-parameter", "-Wno-unused-variable", "-fno-exceptions", "-fno-rtti"]
    folders = [plugin / "Source/Anicodec/Public", plugin / "Source/AnicodecEditor/Private", checkout / "sdk/include", tests / "stubs"]
    objects = []
    for source in [*sorted(plugin.rglob("*.cpp")), tests / "unreal_test.cpp"]:
        objects.append(work / f"{source.stem}.o")
        # Unreal compiles without exceptions and types at run time; the test of it needs neither.
        run(*launcher, sys.argv[4], *flags, *(f"-I{folder}" for folder in folders), "-c", source, "-o", objects[-1])
    run(sys.argv[4], *objects, library, f"-Wl,-rpath,{library.parent}", "-o", work / "unreal_test")
    print(run(work / "unreal_test", checkout), end="")
    if all(shutil.which(name) for name in ("mcs", "mono")):
        check_rules(plugin, tests, work)
    else:
        print("the build rules are not tested: there is no Mono (Debian: mono-mcs mono-runtime)")


if __name__ == "__main__":
    main()
