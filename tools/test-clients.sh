#!/usr/bin/env bash
# Has programs that call POV-Ray export scenes and render them with celltrace in its place, and compares the pictures with
# POV-Ray's: ASE, PyMOL, Jmol, VTK, Open Babel, Blender, Mayavi, and the command lines of others. CTest does a shorter form of
# this where ASE and VTK are installed.
#
#   tools/test-clients.sh [--no-install] [--celltrace PROGRAM] [options] [CLIENT...]
#
# Packages that are missing are installed as tools/install-dependencies.sh does, about 1.5 GB. Options are those of
# tests/clients/run.py. docs/clients.md says how each client is called. Exit codes: 0 done, 1 a scene fails or differs, 77
# neither POV-Ray nor a client is installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if [ "${1:-}" = --no-install ]; then
  shift
else
  tools/install-dependencies.sh clients
fi
program=()
if [[ " $* " != *" --celltrace"* ]]; then
  newest=$(find build*/src/cli -maxdepth 1 -name celltrace -printf '%T@ %p\n' 2>/dev/null | sort -n | tail -n 1 | cut -d' ' -f2)
  [ -n "$newest" ] || { echo "First build celltrace, or name it: --celltrace PROGRAM" >&2; exit 1; }
  program=(--celltrace "$newest")
fi
exec python3 tests/clients/run.py "${program[@]}" "$@"
