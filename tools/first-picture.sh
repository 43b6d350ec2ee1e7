#!/usr/bin/env bash
# From a fresh checkout to a picture: installs what is missing, builds the program, renders
# examples/scenes/first.pov to out/first.png.
#
# The program, build-first/src/cli/celltrace, is built as quickly as can be: for this computer's instruction set alone,
# without the window and without the programming models that only the study compares.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
start=$SECONDS

tools/install-dependencies.sh program
if [ ! -f build-first/CMakeCache.txt ]; then
  tools/configure.sh release -B build-first -DCELLTRACE_UNITY=ON -DCELLTRACE_WIDE_SIMD=OFF \
    "-DCELLTRACE_BASELINE_SIMD=$(tools/widest-simd.sh)" -DCELLTRACE_MODELS=OFF -DCMAKE_DISABLE_FIND_PACKAGE_SDL2=ON \
    -DCELLTRACE_PYTHON=OFF -DCELLTRACE_SPU_GXX= -DCELLTRACE_TESTS=OFF -DCELLTRACE_BENCH=OFF -DCELLTRACE_EXAMPLES=OFF
fi
cmake --build build-first --target celltrace_program
built=$SECONDS

mkdir -p out
build-first/src/cli/celltrace render examples/scenes/first.pov -o out/first.png -W 960 -H 540
echo "The picture is $PWD/out/first.png ($(du -h out/first.png | cut -f1)): $((built - start)) s to install and build," \
  "$((SECONDS - built)) s to render."
