#!/usr/bin/env bash
# Configures one of CMakePresets.json with Ninja, with ccache and an SPU compiler where there are any.
#
#   tools/configure.sh PRESET [more arguments for cmake]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=$1
shift
arguments=(-G Ninja)
if command -v ccache >/dev/null; then
  arguments+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi
spu_compiler=$(tools/spu-compiler.sh)
if [ -n "$spu_compiler" ]; then
  arguments+=("-DCELLTRACE_SPU_GXX=$spu_compiler")
fi
cmake --preset "$preset" "${arguments[@]}" "$@"
