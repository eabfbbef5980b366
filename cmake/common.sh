# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# Shared by quickstart.sh and test.sh: the list of packages, installing them, and building a preset. To be sourced, with
# the checkout as current folder.

# Debian packages needed to build and test.
packages=(
  g++ cmake ninja-build
  libzstd-dev libxxhash-dev libdraco-dev       # format, sdk
  libeigen3-dev libtbb-dev                     # codec
  libopenmesh-dev                              # codec: remeshing
  libcli11-dev libfmt-dev nlohmann-json3-dev   # tools
  libpng-dev libgif-dev libtinyexr-dev         # tools: pictures, textures
  libassimp-dev                                # tools: Collada, MD2 ...
  libgtest-dev libgmock-dev python3            # tests
  python3-dev                                  # the Python package
  python3-venv                                 # the same; sources of libraries, by pip
  liblzma-dev                                  # a compressor to compare with
)

say() { printf '\n== %s\n' "$*"; }

fail() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

# Installs what is missing. Asks for the package lists only when the ones at hand do not do.
install_packages() {
  local missing=() package
  for package in "${packages[@]}"; do
    [[ $(dpkg-query -W -f '${Status}' "$package" 2>/dev/null) == *' installed' ]] ||
      missing+=("$package")
  done
  if ((${#missing[@]} == 0)); then
    say "All ${#packages[@]} Debian packages are installed"
    return
  fi
  command -v apt-get >/dev/null ||
    fail "this is no Debian: install ${missing[*]} in your way, then add --no-install"
  local as_root=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null ||
      fail "installing ${missing[*]} needs root or sudo; --no-install goes without"
    as_root=(sudo)
  fi
  say "Installing Debian packages: ${missing[*]}"
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q
    -o Acquire::Retries=3 -o DPkg::Lock::Timeout=600)
  local install=(install -y --no-install-recommends "${missing[@]}")
  if ! "${apt[@]}" --simulate "${install[@]}" >/dev/null 2>&1 || ! "${apt[@]}" "${install[@]}"; then
    "${apt[@]}" update
    "${apt[@]}" "${install[@]}"
  fi
}

# Installs packages that tests go without, where it can.
install_optional() {
  local as_root=()
  dpkg-query -W "$@" >/dev/null 2>&1 && return
  command -v apt-get >/dev/null || return
  if ((EUID != 0)); then
    as_root=(sudo -n)
  fi
  say "Installing $*, for tests"
  "${as_root[@]}" timeout 240 env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=60 install -y \
    --no-install-recommends "$@" >/dev/null
}

# build PRESET [TARGET...]: configures where needed, and builds in build/PRESET.
build() {
  local preset=$1 fresh=() home
  shift
  home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "build/$preset/CMakeCache.txt" 2>/dev/null || true)
  if [[ -n $home && $home != "$(pwd -P)" ]]; then
    fresh=(--fresh)  # the checkout has been moved or copied
  fi
  if ((${#fresh[@]})) || [[ ! -f build/$preset/build.ninja ]]; then
    say "Configuring build/$preset"
    cmake --preset "$preset" "${fresh[@]}"
  fi
  say "Building build/$preset"
  cmake --build --preset "$preset" ${1:+--target "$@"}
}
