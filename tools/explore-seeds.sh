#!/usr/bin/env bash
# Renders scenes on an emulated Cell under many seeds, on all processors: every seed another interleaving, other moments
# at which DMA moves data and other SPEs that are slow, and always the same picture.
#
#   tools/explore-seeds.sh BUILD [SEEDS [SCENE...]]
#
# BUILD is a build directory with tests. 1000 seeds and the scenes of tests/scenes unless said otherwise.
set -euo pipefail

build=$1
seeds=${2:-1000}
shift; [ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- "$(dirname "${BASH_SOURCE[0]}")"/../tests/scenes/*.pov

# Pieces of 50 seeds, so that nobody waits for the slowest scene alone.
for scene in "$@"; do
  for ((first = 1; first <= seeds; first += 50)); do
    printf '%s\0%s\0%s\0' "$first" "$((seeds - first + 1 < 50 ? seeds - first + 1 : 50))" "$scene"
  done
done | xargs -0 -n 3 -P "$(nproc)" sh -c '"$0" --first "$1" --seeds "$2" "$3" || exit 255' "$build/tests/explore/explore_seeds"
echo "$seeds seeds of each scene: no difference"
