#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Packs bindings/csharp with a library, and tests what is in the packages under Mono, and under .NET where there is one.

usage: run.py CHECKOUT LIBRARY WORK C_COMPILER ENCODER      exit status 77: skipped, for the reason printed
"""
import json
import os
import pathlib
import platform
import shutil
import subprocess
import sys
import tarfile
import zipfile

SKIPPED = 77
CPU = {"x86_64": "x64", "aarch64": "arm64"}
# Names that are a constant of no enumeration of the header.
EXTRA = {("OpenFlags", "None"), ("EncodeFlags", "None")}


def run(*command, **options):
    result = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            **options)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{result.stdout}")
    return result.stdout


def mcs(out, sources, *options):
    kind = "exe" if out.suffix == ".exe" else "library"
    run("mcs", "-unsafe", "-langversion:latest", "-warnaserror", f"-target:{kind}", f"-out:{out}", *options, *sources)


def layout_faults(layout, checkout, work, compiler):
    """Differences between what the assembly declares and the headers, as a compiler of C lays them out."""
    sys.path.insert(0, str(checkout / "bindings" / "generate"))
    import csharp
    import headers
    interface = headers.read(checkout)
    both = (interface.decoder, interface.encoder)
    ours = {line for line in layout.splitlines() if line.startswith(("struct", "field"))}
    prints = []
    for struct in (s for header in both for s in header.structs if s.name not in csharp.SHOWN_STRUCTS):
        prints.append(f'printf("struct {struct.name} %zu\\n", sizeof({struct.name}));')
        for field in struct.fields:
            members = {field.name: field.name}
            if field.count and (field.base not in csharp.TYPES or field.stars):  # C# has a field for each of them
                members = {f"{field.name}{i}": f"{field.name}[{i}]" for i in range(field.count)}
            prints += [f'printf("field {struct.name} {name} %zu\\n", offsetof({struct.name}, {member}));'
                       for name, member in members.items()]
    source = work / "layout.c"
    source.write_text("#include <anicodec/encode.h>\n#include <stdio.h>\nint main(void) {\n" + "\n".join(prints) +
                      "\nreturn 0;\n}\n", encoding="utf-8")
    run(compiler, "-std=c11", *(f"-I{checkout / module / 'include'}" for module in ("sdk", "codec")), source, "-o", work / "layout")
    theirs = set(run(work / "layout").splitlines())
    yield from (f"C has {line}" for line in sorted(theirs - ours))
    yield from (f"C# has {line}" for line in sorted(ours - theirs))
    lines = [line.split() for line in layout.splitlines()]
    told = {function.name: len(function.parameters) for header in both for function in header.functions}
    declared = {words[1]: int(words[2]) for words in lines if words[0] == "function"}
    yield from (f"{name} has {declared.get(name)} parameters in C#, {told.get(name)} in the headers"
                for name in sorted(told.keys() | declared.keys()) if told.get(name) != declared.get(name))
    numbers = {(words[1], words[2]): int(words[3]) for words in lines if words[0] == "constant"}
    wanted = {(csharp.enumeration_name(e), csharp.constant_name(e, c.name)): c.value
              for header in both for e in header.enumerations for c in e.constants}
    for key in sorted(numbers.keys() | wanted.keys()):
        if key not in EXTRA and numbers.get(key) != wanted.get(key):
            yield f"{'.'.join(key)} is {numbers.get(key)} in C#, {wanted.get(key)} in the headers"


def unpack(packages, work, rid):
    """The NuGet package as a program finds it: the assembly, and the library below it."""
    nuget = next(packages.glob("*.nupkg"))
    folder = work / "program"
    with zipfile.ZipFile(nuget) as archive:
        names = set(archive.namelist())
        wanted = {"[Content_Types].xml", "_rels/.rels", "Anicodec.nuspec", "README.md", "lib/netstandard2.1/Anicodec.dll",
                  f"runtimes/{rid}/native/libanicodec.so",
                  f"runtimes/{rid}/native/libanicodec_encoder.so"}
        if not wanted <= names:
            sys.exit(f"{nuget.name} lacks {wanted - names}")
        for name in names:
            if name.startswith("lib/netstandard2.1/"):
                (folder / pathlib.PurePosixPath(name).name).write_bytes(archive.read(name))
            elif name.startswith("runtimes/"):
                archive.extract(name, folder)
    return folder


def check_unity_package(packages):
    path = next(packages.glob("*.tgz"))
    with tarfile.open(path) as archive:
        names = set(archive.getnames())
        manifest = json.load(archive.extractfile("package/package.json"))
        for name in names:
            if name.endswith(".asmdef"):
                json.load(archive.extractfile(name))
    assert path.name == f"{manifest['name']}-{manifest['version']}.tgz", path.name
    lonely = {name for name in names if not name.endswith(".meta") and f"{name}.meta" not in names}
    assert not lonely, f"files without .meta: {lonely}"


def main():
    if len(sys.argv) != 6:
        sys.exit(__doc__)
    checkout, library, work = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
    encoder = pathlib.Path(sys.argv[5]).resolve()
    missing = [name for name in ("mcs", "mono") if not shutil.which(name)]
    if missing:
        print(f"skipped: there is no {' and no '.join(missing)} (Debian: mono-mcs mono-runtime)")
        sys.exit(SKIPPED)
    if "sanitize" in (library.parents[2] / "CMakeCache.txt").read_text(encoding="utf-8", errors="replace"):
        print("skipped: a library with sanitizers cannot be loaded into a Mono without them")
        sys.exit(SKIPPED)
    shutil.rmtree(work, ignore_errors=True)
    (work / "program").mkdir(parents=True)
    tests, sdk, files = checkout / "tests" / "csharp", checkout / "bindings" / "csharp", checkout / "tests" / "conformance"
    rid = f"linux-{CPU.get(platform.machine(), platform.machine())}"
    run(sys.executable, sdk / "pack.py", work / "packages", f"{rid}={library}", f"{rid}={encoder}")
    check_unity_package(work / "packages")
    program = unpack(work / "packages", work, rid)
    assembly = program / "Anicodec.dll"
    mcs(program / "package_test.exe", [tests / "check.cs", tests / "package_test.cs"], f"-r:{assembly}", "-r:System.Core.dll")
    mcs(program / "unity_stubs.dll", [tests / "unity_stubs.cs"])
    unity = [path for folder in ("Unity", "Editor", "Timeline") for path in sorted((sdk / folder).glob("*.cs"))]
    mcs(program / "Anicodec.Unity.dll", unity, f"-r:{assembly}", f"-r:{program / 'unity_stubs.dll'}")
    mcs(program / "unity_test.exe", [tests / "check.cs", tests / "unity_test.cs"], f"-r:{assembly}",
        f"-r:{program / 'unity_stubs.dll'}", f"-r:{program / 'Anicodec.Unity.dll'}")
    environment = {name: value for name, value in os.environ.items() if name != "LD_LIBRARY_PATH"}
    faults = list(layout_faults(run("mono", program / "package_test.exe", "--layout", env=environment), checkout, work,
                                sys.argv[4]))
    if faults:
        sys.exit("\n".join(faults))
    for name in ("package_test", "unity_test"):
        print(f"{name}: {run('mono', program / (name + '.exe'), files, env=environment)}", end="")
    check_il2cpp(tests, sdk, program, environment)
    for kernel in ("Positions", "Normals") if shutil.which("glslangValidator") else ():
        run("glslangValidator", "-D", "-S", "comp", "-e", kernel, "-V", "-o", work / "kernel.spv", sdk / "Unity" / "AnicPlay.compute")
        print(f"kernel {kernel} compiles")
    for kernel in ("Positions", "Normals") if shutil.which("dxc") else ():  # tests/scripts/dxc.py
        run("dxc", "-T", "cs_6_0", "-E", kernel, "-Fo", work / "kernel.bin", sdk / "Unity" / "AnicPlay.compute")
        print(f"kernel {kernel} compiles by DXC")
    if shutil.which("dotnet"):
        print(run_with_dotnet(tests, assembly, program, work, files, environment))
    else:
        print("there is no dotnet: Mono alone")


def check_il2cpp(tests, sdk, program, environment):
    """Holds the code that Unity compiles for iOS to the rules of IL2CPP, and the rules to a sample that breaks each of them."""
    mcs(program / "il2cpp_rules.exe", [tests / "il2cpp_rules.cs"], "-r:System.Core.dll")
    mcs(program / "il2cpp_faults.dll", [tests / "il2cpp_faults.cs"], "-r:System.Core.dll")
    told = subprocess.run(["mono", program / "il2cpp_rules.exe", program / "il2cpp_faults.dll"], text=True, stdout=subprocess.PIPE, env=environment,
                          check=False).stdout
    wanted = ["takes_delegate passes a ", "takes_struct passes a ", "Lets lets C call Called", "Makes calls System.Activator",
              "Searches calls System.Type.GetMethod", "Compiles calls System.Linq.Expressions", "Generic is virtual and generic"]
    missed = [line for line in wanted if f"Faults.{line}" not in told]
    if missed or "LetsAsItShould" in told:
        sys.exit(f"of the sample {missed} are missed:\n{told}")
    phone = ["-define:UNITY_2021_3_OR_NEWER", "-define:ENABLE_IL2CPP", "-define:UNITY_IOS"]
    folder = program / "phone"
    folder.mkdir()
    shutil.copy(program / "unity_stubs.dll", folder)
    mcs(folder / "Anicodec.dll", sorted((sdk / "Runtime").glob("*.cs")), *phone)
    players = [path for part in ("Unity", "Timeline") for path in sorted((sdk / part).glob("*.cs"))]
    mcs(folder / "Anicodec.Unity.dll", players, *phone, f"-r:{folder / 'Anicodec.dll'}", f"-r:{folder / 'unity_stubs.dll'}")
    print(run("mono", program / "il2cpp_rules.exe", folder / "Anicodec.dll", folder / "Anicodec.Unity.dll", env=environment), end="")


def run_with_dotnet(tests, assembly, program, work, files, environment):
    """The same test of the package as a program of .NET."""
    project = work / "dotnet"
    project.mkdir()
    (project / "package_test.csproj").write_text(f"""<Project Sdk="Microsoft.NET.Sdk">
  <PropertyGroup>
    <OutputType>Exe</OutputType><TargetFramework>net6.0</TargetFramework><RollForward>Major</RollForward>
    <AllowUnsafeBlocks>true</AllowUnsafeBlocks><LangVersion>7.3</LangVersion>
  </PropertyGroup>
  <ItemGroup>
    <Compile Include="{tests}/check.cs;{tests}/package_test.cs" />
    <Compile Include="{tests.parent.parent}/bindings/csharp/Runtime/*.cs" />
  </ItemGroup>
</Project>
""", encoding="utf-8")
    libraries = {variable: str(next(program.glob(f"runtimes/*/native/{name}.so"))) for variable, name in
                 (("ANICODEC_LIBRARY", "libanicodec"), ("ANICODEC_ENCODER_LIBRARY", "libanicodec_encoder"))}
    return run("dotnet", "run", "--project", project, "--", files, env={**environment, **libraries})


if __name__ == "__main__":
    main()
