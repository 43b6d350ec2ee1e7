#!/usr/bin/env bash
# From a fresh checkout to a picture: installs what is missing, builds the program, renders
# examples/scenes/first.pov to out/first.png.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
start=$SECONDS

tools/install-dependencies.sh build
if [ ! -f build/CMakeCache.txt ]; then
  tools/configure.sh release -DCELLTRACE_TESTS=OFF -DCELLTRACE_BENCH=OFF -DCELLTRACE_EXAMPLES=OFF
fi
cmake --build --preset release --target celltrace_program
built=$SECONDS

mkdir -p out
build/src/cli/celltrace render examples/scenes/first.pov -o out/first.png -W 960 -H 540
echo "The picture is $PWD/out/first.png ($(du -h out/first.png | cut -f1)): $((built - start)) s to install and build," \
  "$((SECONDS - built)) s to render."
