#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# Installs what release.sh made where nothing else is, and plays a clip there.
set -euo pipefail

usage="usage: sudo tests/scripts/try_release.sh FOLDER [debian|wheel|old|npm|nuget|blender|reproduce]...
FOLDER is what release.sh wrote. Each step starts from nothing:
  debian     a Debian 12 without compilers, by debootstrap: dpkg, man, encode, decode, a page in Chromium; then the
             headers, with a compiler
  wheel      such a Debian: pip install, README's Python example
  old        the same in Debian 11, whose glibc is that of 2021
  npm        a new project of Vite 8: npm install, build, Chromium
  nuget      a program in C# under Mono
  blender    Blender as a Python module (bpy), where pip has one for a Python that is here: the extension
  reproduce  release.sh once more in another folder: which files differ
All but the last without a word; Debian's packages debootstrap, chromium, mono-mcs, npm and a network are needed."

release=$(cd "${1:?$usage}" && pwd -P)
shift
steps=("$@")
((${#steps[@]})) || steps=(debian wheel old npm nuget blender)
root=$(cd -P "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
work=$root/build/try_release
mkdir -p "$work"
(cd "$release" && sha256sum --quiet -c SHA256SUMS)

say() { printf '\n== %s\n' "$*"; }

# fresh SUITE PACKAGES: a system of its own in $work/system, from an archive that is made once.
fresh() {
  local suite=$1 base=$work/$1
  if [[ ! -f $base.tar ]]; then
    rm -rf "$base"
    debootstrap --variant=minbase --include="$2" "$suite" "$base" >"$base.log"
    tar cf "$base.tar" -C "$base" .
    rm -rf "$base"
  fi
  leave
  mkdir "$work/system"
  tar xf "$base.tar" -C "$work/system"
  mount -t proc proc "$work/system/proc"
  cp /etc/resolv.conf "$work/system/etc/"
  # pip and apt reach their registries as on this machine.
  for file in /etc/pip.conf /etc/apt/apt.conf.d/*proxy* /etc/ssl/certs/ca-certificates.crt; do
    [[ ! -f $file ]] || install -D -m 644 "$file" "$work/system$file"
  done
  mkdir "$work/system/release"
  cp "$release"/*.deb "$release"/*.whl "$work/system/release/"
}
leave() {
  ! mountpoint -q "$work/system/proc" || umount "$work/system/proc"
  rm -rf "$work/system"
}
trap leave EXIT

# inside COMMANDS: in that system, with nothing of this machine's environment but how to reach registries.
inside() {
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    ${PIP_INDEX_URL:+PIP_INDEX_URL="$PIP_INDEX_URL"} ${PIP_CERT:+PIP_CERT="$PIP_CERT"} ${https_proxy:+https_proxy="$https_proxy"} \
    ${http_proxy:+http_proxy="$http_proxy"} chroot "$work/system" bash -euxo pipefail -c "$1"
}

# in_browser ADDRESS WORD PICTURE: the page says WORD in its title once it plays.
in_browser() {
  mkdir -p "$work/tools"
  [[ -d $work/tools/node_modules/playwright-core ]] ||
    (cd "$work/tools" && npm init -y >/dev/null && npm install --silent --no-audit --no-fund playwright-core)
  node "$root/tests/scripts/try_page.mjs" "$1" "$2" "$3" "$work/tools"
}

try_debian() {
  fresh bookworm python3-venv,man-db
  inside '
    ! command -v cc
    dpkg -i /release/*.deb >/dev/null 2>&1 || true   # what they depend on is not there yet
    apt-get -qq update
    apt-get -qq -f install -y >/dev/null
    dpkg -s anicodec libanicodec1 libanicodec-encoder1.0 libanicodec-dev | grep -E "^(Package|Status|Version)"
    ! command -v cc
    cd /tmp
    anicodec --version
    anicodec corpus limb -o limb.pc2
    anicodec encode limb.obj limb.pc2 -o limb.anic
    anicodec verify limb.anic
    anicodec decode limb.anic -o back.pc2
    anicodec compare limb.pc2 back.pc2 | grep "max error"
    anicodec render limb.anic -o limb.html
    man anicodec | head -12
    man -w anicodec-encode anicodec-massage-fit
    test -f /usr/share/bash-completion/completions/anicodec
    ldconfig -p | grep anicodec'
  cp "$work/system/tmp/limb.html" "$work/limb.html"
  in_browser "file://$work/limb.html" limb "$work/debian.png"
  say "Headers, with a compiler"
  sed -n '/^#include <anicodec/,/^```/p' "$root/sdk/README.md" | sed '$d' >"$work/system/tmp/frame_to_obj.c"
  inside '
    apt-get -qq install -y --no-install-recommends gcc g++ libc6-dev pkg-config libzstd-dev libdraco-dev >/dev/null
    cd /tmp
    cc frame_to_obj.c $(pkg-config --cflags --libs anicodec) -o frame_to_obj
    ./frame_to_obj limb.anic | grep -c "^v "
    apt-get -qq remove -y anicodec libanicodec1 >/dev/null
    ! command -v anicodec'
}

python_example() {
  sed -n '/^import anicodec$/,/^```/p' "$root/bindings/python/README.md" | sed '/^```/,$d'
  echo 'print(clip.show())'
}

try_wheel() {
  fresh "${1:-bookworm}" python3-venv,man-db
  python_example >"$work/system/tmp/example.py"
  inside '
    ! command -v cc
    cd /tmp
    python3 -m venv environment
    version=$(python3 -c "import sys; print(sys.version_info.minor)")
    environment/bin/pip -q install /release/anicodec-*-cp3$version-*.whl
    ldd --version | head -1
    BROWSER=true environment/bin/python example.py
    environment/bin/anicodec corpus limb -o limb.pc2
    environment/bin/anicodec encode limb.obj limb.pc2 -o limb.anic
    environment/bin/anicodec verify limb.anic
    environment/bin/anicodec render limb.anic -o limb.html'
  cp "$work/system/tmp/limb.html" "$work/limb.html"
  in_browser "file://$work/limb.html" limb "$work/wheel.png"
}

try_old() { try_wheel bullseye; }

try_npm() {
  local project=$work/vite port=4173 server
  rm -rf "$project"
  mkdir -p "$project/public"
  cp "$root/tests/conformance/limb_small.anic" "$project/public/dancer.anic"
  cd "$project"
  npm init -y >/dev/null
  npm install --no-audit --no-fund vite@8 three "$(echo "$release"/anicodec-[0-9]*.tgz)"
  npm ls
  local lines
  lines=$(sed -n '/^import { AnicLoader }/,/^```/p' "$root/bindings/web/README.md" | sed '/^```/,$d')
  {
    grep '^import' <<<"$lines"
    echo "import { AmbientLight, PerspectiveCamera, Scene, Timer, WebGLRenderer } from 'three';
const scene = new Scene(), renderer = new WebGLRenderer(), camera = new PerspectiveCamera(50, 4 / 3, 0.01, 100), timer = new Timer();
renderer.setSize(800, 600);
document.body.append(renderer.domElement);
scene.add(new AmbientLight(0xffffff, 3));
camera.position.set(0, 0, 8);"
    grep -v '^import' <<<"$lines"
    echo "setInterval(() => { if (dancer.time > 0) document.title = 'plays at ' + dancer.time; }, 50);"
  } >main.js
  echo '<!doctype html><link rel="icon" href="data:,"><title>waits</title><body><script type="module" src="/main.js"></script>' >index.html
  npx vite build --target es2022
  ls -l dist/assets
  node node_modules/vite/bin/vite.js preview --host 127.0.0.1 --port $port --strictPort >"$work/vite.log" 2>&1 &
  server=$!
  sleep 3
  local played=true
  in_browser "http://127.0.0.1:$port/" plays "$work/npm.png" || played=false
  kill $server 2>/dev/null || true
  $played
  cd - >/dev/null
}

try_nuget() {
  local folder=$work/nuget
  rm -rf "$folder"
  mkdir -p "$folder"
  cd "$folder"
  unzip -q "$release"/Anicodec.*.nupkg
  cp lib/netstandard2.1/* runtimes/linux-x64/native/libanicodec.so "$root/tests/conformance/limb_small.anic" .
  cat >program.cs <<'C'
using System;
using Anicodec;

class Program {
  static void Main(string[] names) {
    using (var asset = Asset.Open(names[0]))
    using (var plan = new RenderPlan(asset))
    using (var dancer = new Context(asset)) {
      float[] positions = new float[3 * plan.VertexCount];
      dancer.Seek(0.1, Sampling.Linear, Wrap.Loop);
      plan.WritePositions(dancer, positions);
      Console.WriteLine("{0} vertices, the first at {1} {2} {3}", plan.VertexCount, positions[0], positions[1], positions[2]);
    }
  }
}
C
  mcs -langversion:latest -r:Anicodec.dll program.cs
  env -i PATH="$PATH" mono program.exe limb_small.anic
  cd - >/dev/null
}

# The extension as Blender's own command installs it, then a clip there and back.
try_blender() {
  local python found=''
  for python in python3.13 python3.11; do
    "$python" -c 'import sys' 2>/dev/null || continue
    rm -rf "$work/bpy"
    "$python" -m venv "$work/bpy"
    if "$work/bpy/bin/pip" -q install bpy numpy 2>"$work/bpy.log"; then
      found=$python
      break
    fi
  done
  if [[ -z $found ]]; then
    echo "pip has no bpy for a Python that is here: $(tail -1 "$work/bpy.log")"
    return
  fi
  rm -rf "$work/blender"
  mkdir "$work/blender"
  BLENDER_USER_RESOURCES=$work/blender "$work/bpy/bin/python" "$root/tests/scripts/try_extension.py" \
    "$(echo "$release"/anicodec-blender-*.zip)" "$root/tests/conformance/limb_small.anic" "$work/blender"
}

try_reproduce() {
  local copy=$work/again
  rm -rf "$copy" "$work/second"
  git clone -q "$root" "$copy"
  (cd "$copy" && ./release.sh --no-install "$work/second" >"$work/second.log" 2>&1) || { tail -20 "$work/second.log"; return 1; }
  diff <(sort -k2 "$release/SHA256SUMS") <(sort -k2 "$work/second/SHA256SUMS") && echo "every file has the same bytes"
}

for step in "${steps[@]}"; do
  say "$step"
  started=$SECONDS
  "try_$step"
  echo "$step: $((SECONDS - started)) s"
done
