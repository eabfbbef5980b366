#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
set -euo pipefail

if (($# == 0)) || [[ $1 == -* ]]; then
  echo "usage: bindings/rust/package.sh OUT [options of cargo package]
Writes OUT/anicodec-sys-VERSION.crate and OUT/anicodec-VERSION.crate, and builds each from what is in it. --no-verify: without
building; --allow-dirty: of a checkout with changes; --offline: with the crates of zstd-sys, cc and pkg-config that Cargo has." >&2
  exit 2
fi
mkdir -p "$1"
out=$(cd "$1" && pwd)
shift
cd "$(dirname "${BASH_SOURCE[0]}")"
target=$(mktemp -d)
trap 'rm -rf "$target"' EXIT
cargo package --target-dir "$target" -p anicodec-sys -p anicodec "$@"
cp "$target"/package/anicodec-*.crate "$out"
ls -l "$out"/anicodec-*.crate
