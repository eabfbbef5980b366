#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
set -euo pipefail
cd -P "$(dirname "${BASH_SOURCE[0]}")/../.."
source cmake/common.sh

usage="usage: docs/site/build.sh [--no-install]
Makes the site in build/site/html: guides, references of C, Python and JavaScript, the specification, and a gallery of
clips. It needs the command of build/release with its viewer (./quickstart.sh makes both), Doxygen and npm; pip and npm
bring Sphinx and TypeDoc in fixed versions. The pages need no network, and no server. --no-install: without the Debian packages."

packages_wanted=true
for argument in "$@"; do
  case $argument in
    --no-install) packages_wanted=false ;;
    -h | --help) echo "$usage"; exit ;;
    *) fail "unknown option $argument (try --help)" ;;
  esac
done

if $packages_wanted; then
  packages=(doxygen npm python3-venv)
  install_packages
fi
command=build/release/tools/anicodec
[[ -x $command ]] || fail "there is no $command: run ./quickstart.sh first"
out=build/site
mkdir -p "$out"

say "Installing Sphinx and TypeDoc"
if ! cmp -s docs/site/requirements.lock "$out/venv/requirements.lock"; then
  rm -rf "$out/venv"
  python3 -m venv "$out/venv"
  "$out/venv/bin/pip" --disable-pip-version-check -q install --require-hashes --only-binary :all: -r docs/site/requirements.lock
  cp docs/site/requirements.lock "$out/venv/"
fi
npm ci --prefix docs/site --no-audit --no-fund --silent

say "Collecting pages, headers and types"
"$out/venv/bin/python" docs/site/collect.py "$out"
(cd "$out" && doxygen doxygen/Doxyfile)
docs/site/node_modules/.bin/typedoc --options docs/site/typedoc.json --out "$out/source/reference/javascript"
for module in index:anicodec three:anicodec/three three_webgpu:anicodec/three/webgpu react:anicodec/react babylon:anicodec/babylon playcanvas:anicodec/playcanvas gltf_transform:anicodec/gltf-transform loaders_gl:anicodec/loaders-gl; do
  sed -i "1s|.*|# ${module#*:}|" "$out/source/reference/javascript/${module%%:*}.md"
done

say "Making the clips of the gallery"
"$out/venv/bin/python" docs/site/gallery.py "$command" "$out"

say "Building the pages"
rm -rf "$out/html"
"$out/venv/bin/sphinx-build" -W --keep-going -q -j auto -c docs/site -d "$out/doctrees" "$out/source" "$out/html"
echo "The site is in $out/html: $(find "$out/html" -name '*.html' | wc -l) pages, $(du -sh "$out/html" | cut -f1)"
