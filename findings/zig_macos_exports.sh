#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# Zig 0.17.1 (ziglang of PyPI) as a C compiler for macOS: a list of exported symbols.
#
# Apple's linker takes -exported_symbols_list FILE, by which a library exports the functions of its interface and no others. Zig's own
# linker for Mach-O accepts the option and does nothing with it: all external symbols are exported, without a warning.
# -exported_symbol NAME, the same for one name, is refused as unknown. A library built so exports what it holds of others
# (zstd, for example), and a program that has another version of these may get the wrong one.
#
# Output seen: "a program links with a function that is not in the list". Exit status 1 if it does not.
# Way out: hide the rest when it is compiled (-fvisibility=hidden), in the libraries that are linked in, too.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv pip >/dev/null
pip/bin/pip install --quiet --disable-pip-version-check ziglang==0.17.1
export ZIG_GLOBAL_CACHE_DIR=$folder/cache ZIG_LOCAL_CACHE_DIR=$folder/cache
zig() { pip/bin/python -m ziglang "$@"; }

echo "int wanted(void) { return 1; } int other(void) { return 2; }" >library.c
echo "int other(void); int main(void) { return other(); }" >program.c
echo "_wanted" >exports
zig cc -target aarch64-macos -shared -o libexample.dylib library.c -Wl,-exported_symbols_list,exports
if zig cc -target aarch64-macos -o program program.c libexample.dylib; then
  echo "a program links with a function that is not in the list"
else
  echo "the list is kept"
  exit 1
fi
