#!/usr/bin/env bash
# Renders a scene over and over on an emulated Cell and checks that no run hangs, fails or differs from the first.
#
#   tools/soak.sh PROGRAM [SCENE [RUNS [SPES]]]
#
# PROGRAM is a built celltrace, of a thread sanitizer build for instance. 200 runs with 8 SPEs unless said otherwise.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

program=$1
scene=${2:-tests/scenes/finishes.pov}
runs=${3:-200}
spes=${4:-8}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

for ((run = 1; run <= runs; run++)); do
  # Far beyond what a run takes: only one that hangs meets it.
  timeout 300 "$program" render "$scene" -W 160 -H 120 --backend cell_emu --spes "$spes" -o "$out/$run.png" --quiet ||
    { echo "run $run of $runs: exit code $?" >&2; exit 1; }
  cmp -s "$out/1.png" "$out/$run.png" || { echo "run $run of $runs: another picture" >&2; exit 1; }
  [ "$run" -eq 1 ] || rm "$out/$run.png"
done
echo "$runs runs of $scene with $spes SPEs: no hang, no difference"
