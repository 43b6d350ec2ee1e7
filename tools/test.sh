#!/usr/bin/env bash
# Installs what is missing, builds everything with warnings as errors and runs all tests; CTest's summary comes last.
# Takes no arguments; --help says this.
set -euo pipefail
if [ $# -gt 0 ]; then
  sed -n '2,/^set /s/^# //p' "$0"
  [ "$1" = --help ] && exit
  exit 2
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.."

export CCACHE_SLOPPINESS=pch_defines,time_macros # else ccache compiles again what has a precompiled header

tools/install-dependencies.sh build tests python docs
tools/configure.sh ci
cmake --build --preset ci
ctest --preset ci --no-tests=error -j $(($(nproc) + 1)) # some tests wait for programs
