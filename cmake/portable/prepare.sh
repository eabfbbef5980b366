#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# Makes build/portable, which the portable binaries are linked with: the static libraries of Debian's packages; those
# that Debian has no static library of, from the sources of its packages; and stubs of an older glibc.
set -euo pipefail
cd -P "$(dirname "${BASH_SOURCE[0]}")/../.."
glibc=2.28
out=$PWD/build/portable

if [[ -f $out/glibc/libc.so ]]; then
  exit
fi
rm -rf "$out"
mkdir -p "$out"/lib "$out"/source/lists/partial "$out"/source/apt.d
triplet=$(gcc -print-multiarch)
for library in draco zstd z gif lzma png16; do
  [[ -f /usr/lib/$triplet/lib$library.a ]] || {
    echo "prepare.sh: there is no /usr/lib/$triplet/lib$library.a" >&2
    exit 1
  }
  cp "/usr/lib/$triplet/lib$library.a" "$out/lib/"
done
objcopy --redefine-sym stderr=anicodec_png_stderr "$out/lib/libpng16.a"  # old_glibc.c

# The lists of apt name binary packages alone; a copy names their sources.
cd "$out/source"
for list in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
  [[ ! -f $list ]] || sed -e 's/^deb /deb-src /' -e 's/^Types: *deb$/Types: deb-src/' "$list" >"apt.d/$(basename "$list")"
done
apt=(apt-get -qq -o "Dir::State::lists=$PWD/lists" -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache=
  -o Dir::Etc::SourceList=/dev/null -o "Dir::Etc::SourceParts=$PWD/apt.d" -o Acquire::Retries=3 -o APT::Sandbox::User=root)
"${apt[@]}" update || true  # a source of other packages that is out of reach does not matter
for package in onetbb:libtbb-dev openmesh:libopenmesh-dev fmtlib:libfmt-dev; do
  name=${package%:*}
  wanted=$(dpkg-query -W -f '${source:Version}' "${package#*:}")  # of the headers here
  "${apt[@]}" source --download-only "$name=$wanted" || {
    echo "prepare.sh: Debian has no source $wanted of $name any more: upgrade ${package#*:}" >&2
    exit 1
  }
  dpkg-source --extract "$name"_*.dsc "$name" >/dev/null
done

library() {  # library FOLDER OPTION...
  local folder=$1
  shift
  cmake -S "$folder" -B "build_$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF \
    -DCMAKE_POSITION_INDEPENDENT_CODE=ON \
    -DCMAKE_{C,CXX}_FLAGS="-ffunction-sections -fdata-sections -ffile-prefix-map=$out=." "$@"
  cmake --build "build_$folder"
}
library onetbb -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF -DTBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON
library fmtlib -DFMT_TEST=OFF -DFMT_DOC=OFF
library openmesh -DBUILD_APPS=OFF -DOPENMESH_DOCS=OFF
find build_onetbb build_fmtlib -name 'lib*.a' -exec cp {} "$out/lib/" \;
for name in OpenMeshCore OpenMeshTools; do  # shared libraries are all that it makes
  find build_openmesh -path "*/$name.dir/*.o" | LC_ALL=C sort | xargs ar crD "$out/lib/lib$name.a"
done
cd - >/dev/null
# Licences want their text to go with what is compiled in.
for name in libstdc++-12-dev libdraco-dev libzstd-dev libxxhash-dev libeigen3-dev libtbb-dev libopenmesh-dev libcli11-dev \
  libfmt-dev nlohmann-json3-dev libpng-dev zlib1g-dev libgif-dev liblzma-dev libtinyexr-dev; do
  printf '\n==== %s\n\n' "$name"
  cat "/usr/share/doc/$name/copyright"
done >"$out/THIRD_PARTY_LICENSES"
find build/third_party -iname 'license*' -printf '\n==== %P\n\n' -exec cat {} \; >>"$out/THIRD_PARTY_LICENSES"
python3 cmake/portable/glibc_stubs.py "$glibc" "$out/glibc"
