#!/usr/bin/env bash
# Feeds the parser and the renderer scenes that are made up at random, under the address and undefined-behaviour
# sanitizers (libFuzzer, so that it needs clang and its runtime), in the sanitizers' build, with the checks that this
# was configured with: all of them, unless .ci/run was here before without --all.
#
#   tools/fuzz.sh [SECONDS [TARGET...]]
#
# 120 seconds each for fuzz_parse and fuzz_render unless said otherwise. What makes one fail stays in build-fuzz/found;
# `build-asan/tests/fuzz/TARGET FILE` runs it again. What the fuzzer has learned stays in build-fuzz/corpus.
# FUZZ_SEED=N in the environment repeats a run's random choices, as far as the corpus and the time are the same.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

seconds=${1:-120}
shift || true
[ $# -gt 0 ] || set -- fuzz_parse fuzz_render
tools/has-libfuzzer.sh || { echo "Skipped: there is no clang++ with libFuzzer."; exit; }

build=$PWD/build-asan
tools/configure.sh asan -DCMAKE_CXX_COMPILER=clang++ -DCELLTRACE_FUZZ=ON -DCELLTRACE_BENCH=OFF -DCELLTRACE_EXAMPLES=OFF \
  -DCELLTRACE_SPU_GXX= >/dev/null
cmake --build "$build" --target "$@"

work=$PWD/build-fuzz
mkdir -p "$work/found" "$work/empty"
seeds=("$PWD"/tests/scenes "$PWD"/tests/hostile/scenes "$PWD"/examples/scenes)
# Side by side, each from an empty folder: scenes read files from where they are.
declare -A running
for target in "$@"; do
  mkdir -p "$work/corpus/$target"
  (cd "$work/empty" && "$build/tests/fuzz/$target" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=3000 -max_len=4096 -seed="${FUZZ_SEED:-0}" \
    -dict="$OLDPWD/tests/fuzz/pov.dict" -artifact_prefix="$work/found/$target-" -print_final_stats=1 -verbosity=0 \
    "$work/corpus/$target" "${seeds[@]}" >"$work/$target.log" 2>&1) &
  running[$target]=$!
done
failed=0
for target in "$@"; do
  wait "${running[$target]}" || failed=1
  printf '%s:\n' "$target"
  tail -n 40 "$work/$target.log"
done
exit $failed
