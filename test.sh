#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
set -euo pipefail
cd -P "$(dirname "${BASH_SOURCE[0]}")"
source cmake/common.sh

usage="usage: ./test.sh [--no-install] [ctest options]
Installs the Debian packages anicodec needs, builds it in build/test with warnings as errors, and runs
all tests. --no-install: without the packages. Other options go to ctest: -L tools runs those of one
module, -E 'Slow|RealData' leaves out those that take long or want real data."

packages_wanted=true
ctest_options=()
for argument in "$@"; do
  case $argument in
    --no-install) packages_wanted=false ;;
    -h | --help) echo "$usage"; exit ;;
    *) ctest_options+=("$argument") ;;
  esac
done

if $packages_wanted; then
  install_packages
  install_optional blender python3-numpy || say "No Blender: the test of its add-on is skipped"
  install_optional clang-format-14 || say "No clang-format 14: the test of formatting is skipped"
  install_optional python3-clang || say "No libclang: the reader of the headers is not compared with it"
  install_optional abigail-tools || say "No libabigail: the test of the binary interface is skipped"
  install_optional libsdl2-dev libgl-dev libgl1-mesa-dri || say "No SDL2: the example that draws is left out"
  install_optional libogre-1.12-dev xvfb xauth || say "No OGRE: its plug-in is left out"
  install_optional mono-mcs mono-runtime glslang-tools || say "No Mono: the test of the C# package is skipped"
  install_optional glslang-tools spirv-cross || say "No glslang or SPIRV-Cross: shaders in HLSL are not compiled"
  if command -v npm >/dev/null && [[ ! -d tests/gltf/node_modules ]]; then
    say "Installing the glTF validator"
    timeout 120 npm ci --prefix tests/gltf --no-audit --no-fund || say "No glTF validator: its test is skipped"
  fi
fi
# Packages of the web's tests alone.
install_web_packages() {
  install_optional emscripten chromium || say "No emscripten or Chromium: tests of the npm package are skipped"
  # With the clang that emscripten needs.
  install_optional libclang-rt-14-dev || say "No sanitizers of clang: GCC compiles the sanitized readers"
  local folder
  for folder in bindings/web tests/web tests/web/babylon tests/web/vite tests/web/pages; do
    [[ -d $folder/node_modules ]] || timeout 120 npm ci --prefix "$folder" --no-audit --no-fund ||
      say "$folder lacks packages of npm: its tests are skipped"
  done
}

# The modules of the npm package.
build_web() {
  if $packages_wanted && command -v npm >/dev/null; then
    install_web_packages
  fi
  if command -v emcc >/dev/null && [[ -d bindings/web/node_modules/zstd-napi ]]; then
    build wasm
    build wasm-scalar
  fi
}

# Packages that python.Wheel installs, without a network then, and headers that it compiles.
bring_python_packages() {
  [[ -d build/python_packages ]] ||
    timeout 300 python3 -m pip download --quiet --disable-pip-version-check --no-deps --require-hashes --only-binary :all: \
      -r tests/python/requirements.lock -d build/python_packages || say "No packages of PyPI: tests of the Python package bring them"
  local release
  for release in $(sed -n 's/^set(releases \(.*\))$/\1/p' bindings/usd/CMakeLists.txt); do
    python3 bindings/usd/headers.py "$release" "build/third_party/usd-headers/${release/./_}" ||
      say "No headers of OpenUSD $release: tests of the Python package bring them"
  done
}

# Beside each other: networks are waited for, and builds end by linking on one processor.
mkdir -p build
rm -f build/python_packages.log
build_web >build/web.log 2>&1 &
web=$!
if $packages_wanted; then
  bring_python_packages >build/python_packages.log 2>&1 &
fi
build test
status=0
wait "$web" || status=$?
wait
for log in build/python_packages.log build/web.log; do
  if [[ -f $log ]]; then
    cat "$log"
    rm "$log"
  fi
done
if ((status)); then
  fail "build_web ended with status $status"
fi
say "Running the tests"
# One more than there are processors: browsers, Blender and killed runs wait more than they work.
ctest --preset test -j "$(($(nproc) + 1))" "${ctest_options[@]}"
