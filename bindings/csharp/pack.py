#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Makes the NuGet package and the Unity package of bindings/csharp from native libraries.

usage: pack.py OUT [--notices FILE] PLATFORM=LIBRARY...      writes OUT/Anicodec.VERSION.nupkg and OUT/org.anicodec.unity-VERSION.tgz

FILE has the licences of what is compiled into the libraries. PLATFORM is a name of NuGet (linux-x64, osx-arm64, win-x64 ...); one may be
named twice, with the decoder and with the encoder. The assembly is compiled by dotnet, for .NET Standard 2.1 and
.NET 6, or where there is none by Mono's mcs, for .NET Standard 2.1 alone. The same input gives the same bytes of everything
else.
"""
import gzip
import hashlib
import io
import json
import pathlib
import shutil
import subprocess
import sys
import tarfile
import tempfile
import xml.etree.ElementTree as xml
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
NUSPEC = "{http://schemas.microsoft.com/packaging/2013/05/nuspec.xsd}"
EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest that a zip file can state
UNITY_CPU = {"x64": "x86_64", "x86": "x86", "arm64": "ARM64"}
UNITY_SYSTEM = {"linux": "Linux", "osx": "OSX", "win": "Windows"}
CONTENT_TYPES = """<?xml version="1.0" encoding="utf-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
  <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml" />
  <Default Extension="nuspec" ContentType="application/octet" />
{}</Types>
"""
RELATIONS = """<?xml version="1.0" encoding="utf-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
  <Relationship Type="http://schemas.microsoft.com/packaging/2010/07/manifest" Target="/Anicodec.nuspec" Id="R1" />
</Relationships>
"""


def file_name(platform, library):
    name = "anicodec_encoder" if "anicodec_encoder" in library.name else "anicodec"
    return {"win": f"{name}.dll", "osx": f"lib{name}.dylib"}.get(platform.split("-")[0], f"lib{name}.so")


def compile_assembly(folder):
    """The assembly for each framework, as {framework: file}."""
    if shutil.which("dotnet"):
        subprocess.run(["dotnet", "build", "-v", "quiet", "-c", "Release", f"-p:BaseIntermediateOutputPath={folder}/obj/",
                        f"-p:OutputPath={folder}/bin/", HERE / "Anicodec.csproj"], check=True)
        return {path.parent.name: path for path in folder.glob("bin/*/Anicodec.dll")}
    out = folder / "Anicodec.dll"
    subprocess.run(["mcs", "-unsafe", "-optimize", "-langversion:latest", "-target:library", "-warnaserror", f"-out:{out}",
                    *sorted(map(str, HERE.glob("Runtime/*.cs")))], check=True)
    return {"netstandard2.1": out}


def nuget_files(assemblies, libraries, notices):
    """{path in the package: bytes}, by the folders that the nuspec names."""
    stand_ins = {"README.md": (HERE / "README.md").read_bytes()}
    for framework, path in assemblies.items():
        stand_ins[f"lib/{framework}/Anicodec.dll"] = path.read_bytes()
        stand_ins[f"lib/{framework}/Anicodec.dll.config"] = (HERE / "Anicodec.dll.config").read_bytes()
    for platform, path in libraries:
        stand_ins[f"runtimes/{platform}/native/{file_name(platform, path)}"] = path.read_bytes()
        if notices:
            stand_ins[f"runtimes/{platform}/native/THIRD_PARTY_LICENSES.txt"] = notices
    chosen = {}
    for entry in xml.parse(HERE / "Anicodec.nuspec").getroot().iter(NUSPEC + "file"):
        source = entry.get("src").removesuffix("**")
        found = {name: data for name, data in stand_ins.items() if name.startswith(source)}
        assert found, f"nothing for {entry.get('src')}"
        for name, data in found.items():
            chosen["/".join(filter(None, [entry.get("target"), name.removeprefix(entry.get("target") + "/")]))] = data
    return chosen


def nuspec_inside():
    """The manifest as it stands in a package: without the list of files."""
    xml.register_namespace("", NUSPEC.strip("{}"))
    root = xml.parse(HERE / "Anicodec.nuspec").getroot()
    root.remove(root.find(NUSPEC + "files"))
    return xml.tostring(root, encoding="utf-8", xml_declaration=True)


def write_nupkg(out, files):
    version = xml.parse(HERE / "Anicodec.nuspec").getroot().find(f"{NUSPEC}metadata/{NUSPEC}version").text
    path = out / f"Anicodec.{version}.nupkg"
    endings = sorted({name.rpartition(".")[2] for name in files})
    types = "".join(f'  <Default Extension="{ending}" ContentType="application/octet" />\n' for ending in endings)
    parts = {"[Content_Types].xml": CONTENT_TYPES.format(types).encode(), "_rels/.rels": RELATIONS.encode(),
             "Anicodec.nuspec": nuspec_inside(), **files}
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in sorted(parts):
            archive.writestr(zipfile.ZipInfo(name, EPOCH), parts[name], zipfile.ZIP_DEFLATED)
    return path


def meta(name, importer=""):
    """Unity wants one beside each file; the number must never change, so it is made of the name."""
    guid = hashlib.md5(f"org.anicodec.unity/{name}".encode()).hexdigest()
    return f"fileFormatVersion: 2\nguid: {guid}\n{importer}".encode()


def plugin_importer(platform):
    system, cpu = platform.split("-")
    wanted = f"{UNITY_SYSTEM[system]}", UNITY_CPU[cpu]
    editor = f"  - first:\n      Editor: Editor\n    second:\n      enabled: 1\n      settings:\n" \
             f"        CPU: {wanted[1]}\n        OS: {wanted[0]}\n"
    player = {"Linux": "Linux64", "OSX": "OSXUniversal", "Windows": "Win64"}[wanted[0]]
    return "PluginImporter:\n  serializedVersion: 2\n  isOverridable: 1\n  platformData:\n  - first:\n      Any: \n" \
           "    second:\n      enabled: 0\n      settings: {}\n" + editor + \
           f"  - first:\n      Standalone: {player}\n    second:\n      enabled: 1\n      settings:\n        CPU: {wanted[1]}\n"


def unity_files(libraries, notices):
    files = {"Third Party Notices.txt": notices} if notices else {}
    for folder in ("Runtime", "Unity", "Editor", "Timeline"):
        for path in sorted((HERE / folder).iterdir()):
            files[f"{folder}/{path.name}"] = path.read_bytes()
    for name in ("package.json", "README.md"):
        files[name] = (HERE / name).read_bytes()
    for platform, path in libraries:
        files[f"Plugins/{platform}/{file_name(platform, path)}"] = path.read_bytes()
    folders = {parent for name in files for parent in map(str, pathlib.PurePosixPath(name).parents) if parent != "."}
    metas = {f"{folder}.meta": meta(folder, "folderAsset: yes\n") for folder in folders}
    for name in files:
        plugin = name.startswith("Plugins/")
        metas[f"{name}.meta"] = meta(name, plugin_importer(name.split("/")[1]) if plugin else "")
    return {**files, **metas}


def write_unity(out, files):
    manifest = json.loads(files["package.json"])
    path = out / f"{manifest['name']}-{manifest['version']}.tgz"
    data = io.BytesIO()
    with tarfile.open(fileobj=data, mode="w") as archive:
        for name in sorted(files):
            entry = tarfile.TarInfo(f"package/{name}")
            entry.size = len(files[name])
            archive.addfile(entry, io.BytesIO(files[name]))
    path.write_bytes(gzip.compress(data.getvalue(), mtime=0))
    return path


def main():
    notices = None
    if "--notices" in sys.argv[:-1]:
        at = sys.argv.index("--notices")
        notices = pathlib.Path(sys.argv[at + 1]).read_bytes()
        del sys.argv[at:at + 2]
    if len(sys.argv) < 3 or not all("=" in word for word in sys.argv[2:]):
        sys.exit(__doc__)
    out = pathlib.Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    libraries = []
    for word in sys.argv[2:]:
        platform, _, path = word.partition("=")
        libraries.append((platform, pathlib.Path(path)))
    with tempfile.TemporaryDirectory() as folder:
        assemblies = compile_assembly(pathlib.Path(folder))
        print(write_nupkg(out, nuget_files(assemblies, libraries, notices)))
    print(write_unity(out, unity_files(libraries, notices)))


if __name__ == "__main__":
    main()
