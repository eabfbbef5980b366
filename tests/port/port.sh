#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
set -euo pipefail
cd -P "$(dirname "${BASH_SOURCE[0]}")/../.."

usage="usage: tests/port/port.sh TARGET [CMake options]
Builds the decoder without Draco for a machine, installs it, builds a program in C with what is installed, and runs that on all
files of tests/conformance and tests/golden, linked dynamically and statically; the shared library must export just the functions of
its header. In build/port/TARGET. Exit status 77: something is not installed, and the last line says what.

native                       this machine: Linux, macOS, Windows with MSYS2
aarch64, armhf, s390x        Linux, by Debian's cross compilers and qemu-user
windows                      x86-64, by Debian's mingw-w64 and wine64
macos-arm64, macos-x86_64    by zig (pip install ziglang; ZIG=command): compiled and linked, not run
clang-cl                     Windows, by clang-cl: configured, checked for syntax by the rules of Visual C++, not linked

-DANICODEC_LANES=1 takes the scalar kernels, 4 those of four lanes."

say() { printf '\n== %s\n' "$*"; }

# need COMMAND PACKAGE...: ends with status 77 where the command is absent.
need() {
  local command=$1
  shift
  command -v "$command" >/dev/null && return
  echo "skipped: $command is not installed ($*)"
  exit 77
}

(($# >= 1)) || { echo "$usage" >&2; exit 2; }
target=$1
shift
work=$PWD/build/port/$target
prefix=$work/prefix
system=() run=() link_flags=()
exports=elf
nm="nm"
warnings_are_errors=ON

# cross NAME TRIPLET QEMU
cross() {
  need "$2-g++" "apt-get install g++-$2"
  need "$3" "apt-get install qemu-user"
  system=(-DCMAKE_SYSTEM_NAME=Linux "-DCMAKE_SYSTEM_PROCESSOR=$1" "-DCMAKE_C_COMPILER=$2-gcc" "-DCMAKE_CXX_COMPILER=$2-g++"
    "-DCMAKE_FIND_ROOT_PATH=/usr/$2")
  run=("$3" -L "/usr/$2")
  nm=$2-nm
}

# zig is one program for all targets; CMake wants one for each tool.
zig_tools() {
  local zig tool
  read -r -a zig <<<"${ZIG:-zig}"
  if ! command -v "${zig[0]}" >/dev/null; then
    python3 -c 'import ziglang' 2>/dev/null || need zig "pip install ziglang"
    zig=(python3 -m ziglang)
  fi
  need llvm-nm "apt-get install llvm"
  mkdir -p "$work/zig"
  for tool in cc c++ ar ranlib; do
    local arguments=("$tool")
    [[ $tool == c* ]] && arguments+=(-target "$1")
    printf '#!/bin/sh\nexec %s "$@"\n' "${zig[*]} ${arguments[*]}" >"$work/zig/$tool"
    chmod +x "$work/zig/$tool"
  done
  system=(-DCMAKE_SYSTEM_NAME=Darwin "-DCMAKE_SYSTEM_PROCESSOR=$2" "-DCMAKE_C_COMPILER=$work/zig/cc" "-DCMAKE_CXX_COMPILER=$work/zig/c++"
    "-DCMAKE_AR=$work/zig/ar" "-DCMAKE_RANLIB=$work/zig/ranlib" -DCMAKE_SYSTEM_VERSION=22)
  run=(none)
  exports=macho
  nm=llvm-nm
}

case $target in
  native)
    warnings_are_errors=OFF  # of compilers that nobody has tried
    case $(uname -s) in
      Darwin) exports=macho ;;
      MINGW* | MSYS*) exports=pe nm="objdump" link_flags=(-DCMAKE_EXE_LINKER_FLAGS=-static) ;;
    esac
    ;;
  aarch64) cross aarch64 aarch64-linux-gnu qemu-aarch64 ;;
  armhf) cross arm arm-linux-gnueabihf qemu-arm ;;
  s390x) cross s390x s390x-linux-gnu qemu-s390x ;;
  windows)
    need x86_64-w64-mingw32-g++-posix "apt-get install g++-mingw-w64-x86-64-posix"
    wine=$(command -v wine64 || echo /usr/lib/wine/wine64)
    need "$wine" "apt-get install wine64"
    system=(-DCMAKE_SYSTEM_NAME=Windows -DCMAKE_SYSTEM_PROCESSOR=AMD64 -DCMAKE_C_COMPILER=x86_64-w64-mingw32-gcc-posix
      -DCMAKE_CXX_COMPILER=x86_64-w64-mingw32-g++-posix -DCMAKE_RC_COMPILER=x86_64-w64-mingw32-windres)
    link_flags=(-DCMAKE_EXE_LINKER_FLAGS=-static)
    export WINEPREFIX=$work/wine WINEDEBUG=-all WINEDLLOVERRIDES="mscoree,mshtml="
    run=("$wine")
    exports=pe nm=x86_64-w64-mingw32-objdump
    ;;
  macos-arm64) zig_tools aarch64-macos arm64 ;;
  macos-x86_64) zig_tools x86_64-macos x86_64 ;;
  clang-cl) ;;
  *)
    echo "$usage" >&2
    exit 2
    ;;
esac

zstd=${ANICODEC_ZSTD_SOURCE:-$PWD/bindings/web/node_modules/zstd-napi/deps/zstd/lib}
[[ -f $zstd/zstd.h ]] || {
  echo "skipped: no source of zstd (npm ci --prefix bindings/web, or ANICODEC_ZSTD_SOURCE=FOLDER)"
  exit 77
}

if [[ $target == clang-cl ]]; then
  exec python3 tests/port/clang_cl.py "$work" "$zstd"
fi

say "Building for $target"
mkdir -p "$work"
common=(-G Ninja -DCMAKE_BUILD_TYPE=Release "-DCMAKE_C_FLAGS_RELEASE=-O2 -DNDEBUG" "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG"
  ${system[@]+"${system[@]}"})  # Bash 3 of macOS takes an empty list for an unset one
cmake -S . -B "$work/sdk" "${common[@]}" -DCMAKE_UNITY_BUILD=ON -DANICODEC_WERROR=$warnings_are_errors -DANICODEC_BUILD_ENCODER=OFF \
  -DANICODEC_BUILD_TOOLS=OFF -DANICODEC_BUILD_TESTS=OFF -DANICODEC_BUILD_EXAMPLES=OFF -DANICODEC_INSTALL=ON \
  -DANICODEC_WITH_DRACO=OFF "-DANICODEC_ZSTD_SOURCE=$zstd" -DCMAKE_INSTALL_LIBDIR=lib "$@" >"$work.log" || { cat "$work.log"; exit 1; }
cmake --build "$work/sdk"
rm -rf "$prefix"
cmake --install "$work/sdk" --prefix "$prefix" --component sdk >/dev/null
for kind in shared static; do
  static=OFF
  [[ $kind == static ]] && static=ON
  cmake -S tests/port -B "$work/$kind" "${common[@]}" ${link_flags[@]+"${link_flags[@]}"} "-DCMAKE_PREFIX_PATH=$prefix" \
    "-DANICODEC_STATIC=$static" --fresh >"$work.log" || { cat "$work.log"; exit 1; }
  cmake --build "$work/$kind"
done
rm "$work.log"

say "What the library exports"
sed -n 's/^ANIC_API .*[ *]\(anic_[a-z_]*\)(.*/\1/p' "$prefix"/include/anicodec/{play,surface,gpu,stream}.h | sort >"$work/declared"
case $exports in
  elf) "$nm" -D --defined-only "$prefix/lib/libanicodec.so" | awk '{print $3}' ;;
  # Zig's linker takes no list of exports, and the operators new and delete of its own library come along.
  macho) "$nm" -gU "$prefix/lib/libanicodec.dylib" | awk '{sub(/^_/, "", $3)} $3 !~ /^(_Z[nd]|__dso_handle|_mh_)/ {print $3}' ;;
  pe) "$nm" -p "$prefix/bin/anicodec.dll" | awk '/Ordinal\/Name Pointer/ {names = 1; next} NF == 0 {names = 0} names {print $NF}' ;;
esac | sort >"$work/exported"
diff "$work/declared" "$work/exported" || { echo "the library exports other functions than the header declares"; exit 1; }
echo "just the $(wc -l <"$work/declared") functions of the header"

if [[ ${run[*]} == none ]]; then
  say "$target: built and linked; nothing here runs it"
  exit
fi
suffix=
if [[ $exports == pe ]]; then
  suffix=.exe
  cp "$prefix/bin/anicodec.dll" "$work/shared/"
fi

# decode KIND FOLDER: runs the program on the files of a manifest.
decode() {
  say "$2, $1"
  python3 tests/conformance/run.py --memory 0 --folder "$2" --without draco --without streams --without bounds --without metadata \
    --without origin ${run[@]+"${run[@]}"} "$work/$1/c_decoder$suffix" "{file}" "{out}"
}
if [[ $target == windows ]]; then
  # One session of Wine for all files; Debian's way starts Windows anew for each.
  server=$(command -v wineserver64 || echo /usr/lib/wine/wineserver64)
  mkdir -p "$WINEPREFIX"
  "$server" -p || true  # is there already
  trap '"$server" -k' EXIT
fi
decode shared tests/conformance
decode shared tests/golden
decode static tests/golden
say "$target: conforms"
