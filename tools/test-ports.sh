#!/usr/bin/env bash
# Builds celltrace for other processors, runs its tests by qemu-user, and compares pictures with this machine's.
#
#   tools/test-ports.sh [aarch64|powerpc64]...
#
# Both if none is named. $CELLTRACE is this machine's program, build-ci's if it is not set. Builds are build-aarch64 and
# build-powerpc64. docs/porting.md says which packages of Debian are needed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

own_program=${CELLTRACE:-build-ci/src/cli/celltrace}

missing() {
  echo "tools/test-ports.sh: missing: $1 ($2)" >&2
  exit 1
}
needs_command() {
  command -v "$1" >/dev/null || missing "$1" "$2"
}
needs_file() {
  [ -e "$1" ] || missing "$1" "$2"
}

# configure NAME [arguments for cmake]. xsimd is headers only, and its CMake package is beside this machine's libraries.
configure() {
  local arguments=()
  if command -v ccache >/dev/null; then
    arguments+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  cmake -S . -B "$build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="cmake/$1-linux-gnu.cmake" "${arguments[@]}" \
    -Dxsimd_DIR="$(dirname "$(find /usr/lib /usr/share -name xsimdConfig.cmake | head -n 1)")" \
    -DCMAKE_BUILD_TYPE=Release -DCELLTRACE_WERROR=ON -DCELLTRACE_PYTHON=OFF -DCELLTRACE_BENCH=OFF \
    -DCELLTRACE_EXAMPLES=OFF -DCELLTRACE_SPU_GXX= "${@:2}"
}

# port SUITES: builds the suites, runs them, compares pictures.
port() {
  local targets=() suites=$1
  for suite in $suites; do
    targets+=("test_$suite")
  done
  ninja -C "$build" "${targets[@]}" celltrace_program
  ctest --test-dir "$build" --no-tests=error -j "$(nproc)" --output-on-failure -R "^(${suites// /|}):"
  tools/same-pixels --program "$own_program" --also "${emulator[*]} $build/src/cli/celltrace"
}
}

aarch64() {
  local build=build-aarch64 emulator=(qemu-aarch64)
  needs_command aarch64-linux-gnu-g++ "package g++-aarch64-linux-gnu"
  needs_command qemu-aarch64 "package qemu-user"
  for library in png deflate z boost_context; do
    needs_file /usr/lib/aarch64-linux-gnu/lib$library.a "packages libpng-dev, libdeflate-dev, zlib1g-dev, libboost-context-dev of arm64"
  done
  configure aarch64
  port "isa isa_instructions native spe cell_emu sdk simulator balance balance_on_spus cache cache_traces cache_checked kernel models image pov reference render job"
}

powerpc64() {
  local build=build-powerpc64 emulator=(qemu-ppc64 -L /usr/powerpc64-linux-gnu)
  needs_command powerpc64-linux-gnu-g++ "package g++-powerpc64-linux-gnu"
  needs_command qemu-ppc64 "package qemu-user"
  # Debian has no libraries for it: files of pictures that need them are not read or written, so their headers do.
  mkdir -p $build
  rm -f $build/libnothing.a
  powerpc64-linux-gnu-ar rc $build/libnothing.a
  local nothing=$PWD/$build/libnothing.a include
  include=$(dirname "$(find /usr/include -name zconf.h | head -n 1)")
  configure powerpc64 -DCELLTRACE_UCONTEXT=ON -DCMAKE_EXE_LINKER_FLAGS="-static -Wl,--unresolved-symbols=ignore-all" \
    -DPNG_LIBRARY="$nothing" -DPNG_PNG_INCLUDE_DIR=/usr/include -DDeflate_LIBRARY="$nothing" \
    -DDeflate_INCLUDE_DIR=/usr/include -DZLIB_LIBRARY="$nothing" -DZLIB_INCLUDE_DIR="$include"
  port "isa isa_instructions native spe cell_emu sdk simulator balance balance_on_spus cache kernel"
}

needs_command cmake "package cmake"
needs_command ninja "package ninja-build"
needs_command python3 "package python3"
needs_file "$own_program" "this machine's program: ninja -C build-ci celltrace_program, or set CELLTRACE"
[ $# -gt 0 ] || set -- aarch64 powerpc64
for name in "$@"; do
  case $name in
    aarch64 | powerpc64) (set -e; "$name") ;;
    *) echo "usage: tools/test-ports.sh [aarch64|powerpc64]..." >&2; exit 1 ;;
  esac
done
