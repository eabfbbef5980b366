#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
set -euo pipefail
cd -P "$(dirname "${BASH_SOURCE[0]}")"
source cmake/common.sh

usage="usage: ./release.sh [--no-install] [--homepage URL] [--only STEP]... [OUT]
Makes the packages of a release in OUT (out/release), from the commit that is checked out: source archive, Debian
packages, Python wheels, npm package, extension for Blender, NuGet and Unity packages, crates, SHA256SUMS and a
list of what is inside (CycloneDX). docs/release.md says more.
--only makes one of archive, debian, wheels, npm, blender, nuget, crate anew. --homepage is the address that
packages state; without, they state none."

out=out/release homepage='' packages_wanted=true steps=()
while (($#)); do
  case $1 in
    --no-install) packages_wanted=false ;;
    --homepage) homepage=${2:?$usage}; shift ;;
    --only) steps+=("${2:?$usage}"); shift ;;
    -h | --help) echo "$usage"; exit ;;
    -*) fail "unknown option $1 (try --help)" ;;
    *) out=$1 ;;
  esac
  shift
done
((${#steps[@]})) || steps=(archive debian wheels npm blender nuget crate)

[[ -z $(git status --porcelain) ]] || fail "there are changes that are in no commit"
python3 tests/scripts/check_versions.py .
version=$(sed -n 's/^project(anicodec VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH TZ=UTC LC_ALL=C.UTF-8
umask 022
if $packages_wanted; then
  packages+=(dpkg-dev file npm emscripten mono-mcs libgif-dev zlib1g-dev libassimp-dev)
  install_packages
fi
mkdir -p "$out"
out=$(cd "$out" && pwd -P)
checkout=$PWD

# All is built from the archive, which is thereby known to be whole.
archive=$out/anicodec-$version.tar.gz
make_archive() {
  git -C "$checkout" archive --prefix="anicodec-$version/" HEAD | gzip -9n >"$archive"
}
unpack() {
  local commit
  commit=$(git rev-parse HEAD)
  tree=$checkout/build/release_tree/anicodec-$version
  if [[ $(cat "$tree.commit" 2>/dev/null) != "$commit" ]]; then
    rm -rf "$tree" "$tree.commit"
    mkdir -p "$(dirname "$tree")"
    git -C "$checkout" archive --prefix="anicodec-$version/" HEAD | tar xf - -C "$(dirname "$tree")" --no-same-owner
    echo "$commit" >"$tree.commit"
  fi
  cd "$tree"
}

# The objects that everything for this kind of machine is linked from.
build_objects() {
  [[ -f build/release/build.ninja ]] ||
    cmake --preset release -DCMAKE_INSTALL_PREFIX=/usr -DANICODEC_BUILD_TESTS=OFF -DANICODEC_BUILD_EXAMPLES=OFF \
      -DANICODEC_HOMEPAGE="$homepage"
  cmake --build --preset release --target installed
}
build_portable() {
  build_objects
  cmake/portable/prepare.sh
  cmake -S cmake/portable -B build/portable/link -G Ninja --toolchain "$PWD/cmake/portable/toolchain.cmake" \
    -DANICODEC_PREBUILT="$PWD/build/release"
  cmake --build build/portable/link
}
build_web() {
  [[ -d bindings/web/node_modules ]] || npm ci --prefix bindings/web --no-audit --no-fund --ignore-scripts
  build wasm
  build wasm-scalar
}

make_debian() {
  build_objects
  rm -rf build/deb
  (cd build/release && cpack -G DEB -B "$tree/build/deb")
  rm -f "$out"/*.deb
  cp build/deb/*.deb "$out/"
}

python_with_headers() {
  "python3.$1" -c 'import os, sys, sysconfig
assert os.path.exists(sysconfig.get_path("include") + "/Python.h")
print(sys.executable)' 2>/dev/null
}

# A wheel for each Python from 3.9 to 3.11 that is here, and one by the stable interface for 3.12 and later.
make_wheels() {
  build_portable
  rm -f "$out"/*.whl
  local minors minor python environment platform
  platform=manylinux_2_28_$(uname -m)
  for minors in 9 10 11 "12 13 14"; do
    python=''
    for minor in $minors; do
      python=$(python_with_headers "$minor") && break
    done
    if [[ -z $python ]]; then
      echo "No Python 3.${minors// /, 3.} with its headers is here: there is no wheel for it"
      continue
    fi
    environment=build/python3.$minor
    [[ -x $environment/bin/python ]] || "$python" -m venv "$environment"
    "$environment/bin/pip" install -q --disable-pip-version-check -r cmake/release/requirements.txt
    rm -rf build/wheel
    PATH=$PWD/$environment/bin:$PATH "$environment/bin/pip" wheel -v --disable-pip-version-check --no-deps --no-build-isolation . \
      -w build/wheel --config-settings=cmake.define.ANICODEC_PREBUILT=build/release \
      --config-settings=cmake.define.CMAKE_TOOLCHAIN_FILE="$PWD/cmake/portable/toolchain.cmake" \
      --config-settings=build-dir="$PWD/build/wheel_build_$minor"
    # Nothing is brought in, for everything is static; the name is checked against the symbols.
    PATH=$PWD/$environment/bin:$PATH "$environment/bin/auditwheel" repair --plat "$platform" --exclude libassimp.so.5 --exclude libusd_ms.so \
      -w "$out" build/wheel/*.whl
  done
  [[ -z $(find "$out" -name "*.whl" -size +8000000c) ]] || fail "a wheel has more than 8 MB"
}

make_npm() {
  build_web
  node --test tests/web/prebuilt.test.mjs
  rm -rf build/npm "$out"/anicodec-"$version".tgz
  mkdir -p build/npm
  if [[ -n $homepage ]]; then
    (cd bindings/web && npm pkg set "homepage=$homepage" "repository.type=git" "repository.url=$homepage")
  fi
  (cd bindings/web && npm pack --ignore-scripts=false --pack-destination "$tree/build/npm")
  cp build/npm/*.tgz "$out/"
}

# Blender 4.2 to 5.0 have Python 3.11, later ones 3.13. Beside a wheel for one Python it takes none for all that follow
# (abi3), so that one is packed under the name of a wheel for 3.13.
make_blender() {
  local wheels=() python
  for python in cp311 cp312-abi3; do
    wheels+=("$out"/anicodec-"$version-$python"-*.whl)
    [[ -f ${wheels[-1]} ]] || fail "the extension for Blender carries a wheel for $python, which is not there"
  done
  rm -rf build/blender
  mkdir build/blender
  cp "${wheels[@]}" build/blender/
  local tools=(build/python3.*/bin)
  "${tools[0]}/python" -m wheel tags --remove --python-tag cp313 --abi-tag cp313 build/blender/*-abi3-*.whl
  python3 bindings/blender/package.py build/blender/*.whl -o "$out/anicodec-blender-$version.zip"
}

make_nuget() {
  build_portable
  python3 bindings/csharp/pack.py "$out" --notices build/portable/THIRD_PARTY_LICENSES \
    linux-x64=build/portable/link/libanicodec.so linux-x64=build/portable/link/libanicodec_encoder.so
}

make_crate() {
  command -v cargo >/dev/null || fail "the crates want cargo, of Rust 1.81 or later; Debian 12 has an older one"
  rm -f "$out"/*.crate
  bindings/rust/package.sh "$out" --allow-dirty  # in a folder that git ignores
}

unpack
for step in "${steps[@]}"; do
  say "$step"
  started=$SECONDS
  declare -F "make_$step" >/dev/null || fail "there is no step $step"
  "make_$step"
  echo "$step: $((SECONDS - started)) s"
done

say "What is inside, and checksums"
cd "$out"
rm -f SHA256SUMS
python3 "$tree/cmake/release/sbom.py" "$tree" "$out" >"anicodec-$version.cdx.json"
find . -maxdepth 1 -type f ! -name SHA256SUMS -printf '%P\n' | LC_ALL=C sort | xargs sha256sum >SHA256SUMS
ls -l --time-style=+
echo "$out is ready; tests/scripts/try_release.sh $out installs each"
