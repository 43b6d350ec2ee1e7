#!/usr/bin/env bash
# Prints the path of a spu-elf-g++ that works, or nothing: $CELLTRACE_SPU_GXX, one that a toolchain folder beside the
# checkout unpacks, or one on the PATH. Says on stderr when there is none.
set -uo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

find_compiler() {
  if [ -n "${CELLTRACE_SPU_GXX:-}" ]; then
    echo "$CELLTRACE_SPU_GXX"
  elif [ -x "$top/../shared/toolchain/install.sh" ]; then
    "$top/../shared/toolchain/install.sh"
  else
    command -v spu-elf-g++
  fi
}

compiler=$(find_compiler)
if [ -n "$compiler" ] && "$compiler" --version >/dev/null 2>&1; then
  echo "$compiler"
else
  echo "No spu-elf-g++: the build for the real SPU is skipped." >&2
fi
