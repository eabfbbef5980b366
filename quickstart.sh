#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
set -euo pipefail
cd -P "$(dirname "${BASH_SOURCE[0]}")"
source cmake/common.sh

usage="usage: ./quickstart.sh [--no-install]
Installs the Debian packages anicodec needs, builds command and libraries in build/release, and takes a clip
there and back in out/, with a page that plays it. --no-install: without the packages."

packages_wanted=true
for argument in "$@"; do
  case $argument in
    --no-install) packages_wanted=false ;;
    -h | --help) echo "$usage"; exit ;;
    *) fail "unknown option $argument (try --help)" ;;
  esac
done

if $packages_wanted; then
  install_packages
fi
build release installed anicodec_examples

anicodec=build/release/tools/anicodec
run() {
  echo "\$ $*"
  "$@"
}

say "Making a clip of the corpus, encoding it, and decoding it"
mkdir -p out
run $anicodec corpus limb -f -o out/limb.pc2
run $anicodec encode -f out/limb.obj out/limb.pc2 -o out/limb.anic
run $anicodec decode -f out/limb.anic -o out/decoded.pc2

say "How far the decoded clip is from the original"
run $anicodec compare out/limb.pc2 out/decoded.pc2

say "A page that plays it in a browser"
run $anicodec render -f out/limb.anic -o out/limb.html

say "Sizes"
wc -c out/limb.pc2 out/limb.anic out/limb.html | sed '$d'  # without the sum
echo "Next: $anicodec --help, or cmake --install build/release
The pages of docs/howto/ want the command and the examples in the path:
  PATH=\$PWD/build/release/tools:\$PWD/build/release/sdk/examples:\$PATH
A package for Python of this build, in half a minute:
  python3 -m venv venv && venv/bin/pip install . --config-settings=cmake.define.ANICODEC_PREBUILT=build/release"
