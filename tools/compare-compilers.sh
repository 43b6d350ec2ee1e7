#!/usr/bin/env bash
# Renders the same scenes in lockstep with two builds of the program and compares every bit of what comes out: picture,
# statistics apart from host seconds, virtual cycles and trace.
#
#   tools/compare-compilers.sh PROGRAM PROGRAM [SCENE...]
#
# For programs built by different compilers. The scenes of tests/scenes unless said otherwise.
set -euo pipefail

one=$(realpath "$1")
two=$(realpath "$2")
shift 2
[ $# -gt 0 ] || set -- "$(dirname "${BASH_SOURCE[0]}")"/../tests/scenes/*.pov
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

settings=(
  "--spes 8"
  "--spes 3 --timing ps3 --transfers issue"
  "--spes 6 --seed 7 --transfers random --faults"
  "--spes 2 --seed 8 --faults"
)
for scene in "$@"; do
  for setting in "${settings[@]}"; do
    for side in one two; do
      # shellcheck disable=SC2086 -- a setting is several words
      "${!side}" render "$scene" -W 64 -H 48 --backend cell_emu --schedule lockstep $setting --quiet \
        -o "$out/$side.png" --stats "$out/$side.json" --trace "$out/$side.trace"
      # What the host's clock says is the host's.
      sed -i '/"seconds": {/,/}/d' "$out/$side.json"
    done
    for kind in png json trace; do
      cmp "$out/one.$kind" "$out/two.$kind" || { echo "$scene $setting: the builds differ" >&2; exit 1; }
    done
  done
done
echo "$# scenes in ${#settings[@]} settings: identical"
