#!/usr/bin/env bash
# Calibrates the modelled cycles of cell_emu by cell_sim, which executes the SPU's machine code: renders scenes on both,
# fits the charges of compute() and the statistical parameters of the pipeline, and writes the charges into the headers.
# The parameters are printed: they go into include/celltrace/spe/timing.hpp by hand.
#
#   tools/calibrate-charges.sh BUILD [SCENE.pov...]
#
# BUILD is a build directory with tests and CELLTRACE_SPU_GXX. The study's scenes are always rendered, with those given;
# tests/scenes unless said otherwise. Build and run again until nothing changes any more: twice as a rule, because the
# statistical parameters are of intervals between DMA commands.
set -euo pipefail

build=$1
shift
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
[ $# -gt 0 ] || set -- "$root"/tests/scenes/*.pov

cmake --build "$build" --target calibrate_charges
"$build/tests/calibrate/calibrate_charges" measure "$@" > "$build/calibration.txt"
"$build/tests/calibrate/calibrate_charges" fit "$build/calibration.txt" "$root/src/kernel/scalar_work.hpp" \
  "$root/src/kernel/models/model_work.hpp" "$root/include/celltrace/cache/software_cache.hpp"
