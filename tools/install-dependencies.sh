#!/usr/bin/env bash
# Installs the Debian packages that celltrace needs and that are missing; as root, or through sudo.
#
#   tools/install-dependencies.sh GROUP...
#
#   program  to build the library and the program without its window
#   build    to build the library and the program
#   tests    to build and run the tests and benchmarks
#   bench    Embree and POV-Ray, which celltrace is compared with
#   python   to build the Python package and to test it
#   docs     to make the documents a site
#   clients  programs that call POV-Ray, which tools/test-clients.sh runs with celltrace in its place
#   extras   POV-Ray, for the tests that compare with it, ImageMagick and ffmpeg, which tests have read pictures, matplotlib, whose colours Python has, clang
#            with its runtime, to compare builds and to fuzz, ccache, Valgrind, which the emulator tells of transfers in
#            flight, and the shells whose completions are tested
set -euo pipefail

declare -A packages=(
  [program]="g++ cmake ninja-build flex bison libboost-context-dev libcli11-dev libdeflate-dev libfreetype-dev libglm-dev libjpeg62-turbo-dev libopenexr-dev libpng-dev libseccomp-dev libxsimd-dev nlohmann-json3-dev zlib1g-dev"
  [tests]="catch2 fonts-dejavu-core libbenchmark-dev pkg-config python3 xz-utils"
  [python]="pybind11-dev python3-dev python3-numpy python3-pip python3-pytest python3-setuptools python3-venv python3-wheel"
  [docs]="doxygen mkdocs"
  [clients]="blender imagemagick jmol mayavi2 openbabel povray povray-includes pymol python3-ase python3-skimage python3-vtk9 xauth xvfb"
  [bench]="libembree-dev povray povray-includes"
  [extras]="ccache clang ffmpeg fish imagemagick libclang-rt-14-dev libmagickcore-6.q16-6-extra povray povray-includes python3-matplotlib valgrind xdotool xvfb zsh"
)
packages[build]="${packages[program]} libsdl2-dev libsdl2-ttf-dev"

is_installed() {
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

missing=()
for group in "$@"; do
  [ -n "${packages[$group]:-}" ] || { echo "$0: unknown group '$group'" >&2; exit 1; }
  if ! command -v dpkg-query >/dev/null; then
    echo "Not a Debian system; please see to these packages yourself: ${packages[$group]}" >&2
    continue
  fi
  for package in ${packages[$group]}; do
    is_installed "$package" || missing+=("$package")
  done
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "Missing packages, and neither root nor sudo: ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
echo "Installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
