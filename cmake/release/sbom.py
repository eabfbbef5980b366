#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Prints a list of what is in the packages of a release, as CycloneDX 1.5: sbom.py SOURCE FOLDER.

SOURCE is the tree that they were built in, on this machine: versions are those of its installed Debian packages, and of the
sources that the build brings. FOLDER holds the packages.
"""
import datetime
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import uuid

# Debian packages whose code is in binaries, and its licence. Headers alone are code, too.
DEBIAN = {
    "libstdc++-12-dev": "GPL-3.0-or-later WITH GCC-exception-3.1", "libdraco-dev": "Apache-2.0", "libzstd-dev": "BSD-3-Clause",
    "libxxhash-dev": "BSD-2-Clause", "libeigen3-dev": "MPL-2.0", "libtbb-dev": "Apache-2.0", "libopenmesh-dev": "BSD-3-Clause",
    "libcli11-dev": "BSD-3-Clause", "libfmt-dev": "MIT", "nlohmann-json3-dev": "MIT", "libpng-dev": "libpng-2.0",
    "zlib1g-dev": "Zlib", "libgif-dev": "MIT", "liblzma-dev": "0BSD", "libtinyexr-dev": "BSD-3-Clause",
}
SOURCES = {"meshopt": "MIT", "pyufbx": "MIT", "mapbox-earcut": "ISC"}  # of packages that cmake/anicodec_*.cmake bring
ENCODER = {"libstdc++-12-dev", "libdraco-dev", "libzstd-dev", "libxxhash-dev", "libeigen3-dev", "libtbb-dev", "libopenmesh-dev"}


def debian_components():
    text = subprocess.run(["dpkg-query", "-W", "-f", "${Package} ${Version} ${Architecture}\n", *DEBIAN], check=True,
                          capture_output=True, text=True).stdout
    for line in text.splitlines():
        name, version, machine = line.split()
        yield component(name, version, DEBIAN[name], f"pkg:deb/debian/{name}@{version}?arch={machine}")


def brought_components(source):
    for path in sorted(source.glob("cmake/anicodec_*.cmake")):
        for package, version, digest in re.findall(r"anicodec_source\(\w+ (\S+) (\S+) ([0-9a-f]{64})", path.read_text()):
            yield component(package, version, SOURCES[package], f"pkg:pypi/{package}@{version}", digest)
    for name, version in re.findall(r"^(nanobind)==(\S+)$", re.sub(r"; .*", "", (source / "cmake/release/requirements.txt")
                                                                   .read_text()), re.MULTILINE):
        yield component(name, version, "BSD-3-Clause", f"pkg:pypi/{name}@{version}")
    for name, version in re.findall(r"^(pxr[\w-]+)==(\S+)", (source / "bindings/usd/headers.lock").read_text(), re.MULTILINE):
        yield component(name, version, "LicenseRef-TOST-1.0", f"pkg:pypi/{name}@{version}")  # headers alone
    lock = json.loads((source / "bindings/web/package-lock.json").read_text())
    version = lock["packages"]["node_modules/zstd-napi"]["version"]
    yield component("zstd-napi", version, "BSD-3-Clause", f"pkg:npm/zstd-napi@{version}")  # zstd's source


def component(name, version, licence, purl, digest=None):
    is_id = " " not in licence and "LicenseRef" not in licence
    made = {"type": "library", "bom-ref": purl, "name": name, "version": version, "purl": purl,
            "licenses": [{"license": {"id": licence}} if is_id else {"expression": licence}]}
    if digest:
        made["hashes"] = [{"alg": "SHA-256", "content": digest}]
    return made


def used_by(name, components):
    """The components compiled into a file of the release; Debian packages depend on shared libraries of the rest."""
    def refs(wanted):
        return [c["bom-ref"] for c in components if c["name"] in wanted]
    sources = set(SOURCES)
    if name.endswith(".whl") or "-blender-" in name:
        return refs(set(DEBIAN) | sources | {"nanobind"} | {c["name"] for c in components if c["name"].startswith("pxr")})
    if name.endswith(".nupkg") or name.startswith("org.anicodec.unity"):
        return refs(ENCODER)
    if name.endswith(".tgz"):
        return refs({"zstd-napi"})
    if name.endswith(".deb"):
        return refs(sources | {"libeigen3-dev", "libcli11-dev", "nlohmann-json3-dev", "libxxhash-dev"})
    return []


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    source, folder = map(pathlib.Path, sys.argv[1:])
    version = re.search(r"project\(anicodec VERSION ([\d.]+)", (source / "CMakeLists.txt").read_text())[1]
    libraries = [*debian_components(), *brought_components(source)]
    files = []
    for path in sorted(folder.iterdir()):
        if path.is_file() and path.name != "SHA256SUMS" and not path.name.endswith(".cdx.json"):
            digest = hashlib.sha256(path.read_bytes()).hexdigest()
            files.append({"type": "file", "bom-ref": path.name, "name": path.name, "version": version,
                          "hashes": [{"alg": "SHA-256", "content": digest}], "licenses": [{"license": {"id": "Apache-2.0"}}]})
    product = f"pkg:generic/anicodec@{version}"
    time = datetime.datetime.fromtimestamp(int(os.environ["SOURCE_DATE_EPOCH"]), datetime.timezone.utc)
    bill = {
        "bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1,
        "serialNumber": f"urn:uuid:{uuid.uuid5(uuid.NAMESPACE_URL, json.dumps(files))}",
        "metadata": {"timestamp": time.isoformat(),
                     "component": {"type": "application", "bom-ref": product, "name": "anicodec", "version": version, "purl": product,
                                   "licenses": [{"license": {"id": "Apache-2.0"}}]}},
        "components": files + libraries,
        "dependencies": [{"ref": product, "dependsOn": [file["bom-ref"] for file in files]},
                         *({"ref": file["bom-ref"], "dependsOn": used_by(file["name"], libraries)} for file in files)],
    }
    print(json.dumps(bill, indent=1))


if __name__ == "__main__":
    main()
