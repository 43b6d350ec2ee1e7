#!/usr/bin/env bash
# Feeds the parser and the renderer scenes that are made up at random, under the address and undefined-behaviour
# sanitizers (libFuzzer, so that it needs clang).
#
#   tools/fuzz.sh [SECONDS [TARGET...]]
#
# 120 seconds each for fuzz_parse and fuzz_render unless said otherwise. What makes one fail stays in build-fuzz/found;
# `build-fuzz/tests/fuzz/TARGET FILE` runs it again. What the fuzzer has learned stays in build-fuzz/corpus.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

seconds=${1:-120}
shift || true
[ $# -gt 0 ] || set -- fuzz_parse fuzz_render
command -v clang++ >/dev/null || { echo "Skipped: there is no clang++."; exit; }

build=$PWD/build-fuzz
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
cmake -S . -B "$build" -G Ninja -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1 -DNDEBUG" -DCELLTRACE_FUZZ=ON -DCELLTRACE_SANITIZE=address,undefined \
  -DCELLTRACE_WIDE_SIMD=OFF -DCELLTRACE_TESTS=OFF -DCELLTRACE_BENCH=OFF -DCELLTRACE_EXAMPLES=OFF "${launcher[@]}" >/dev/null
cmake --build "$build" --target "$@"

mkdir -p "$build/corpus" "$build/found" "$build/empty"
seeds=("$PWD"/tests/scenes "$PWD"/tests/hostile/scenes "$PWD"/examples/scenes)
failed=0
for target in "$@"; do
  mkdir -p "$build/corpus/$target"
  # From an empty folder: scenes read files from where they are.
  (cd "$build/empty" && "$build/tests/fuzz/$target" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=3000 -max_len=4096 \
    -dict="$OLDPWD/tests/fuzz/pov.dict" -artifact_prefix="$build/found/$target-" -print_final_stats=1 -verbosity=0 \
    "$build/corpus/$target" "${seeds[@]}") || failed=1
done
exit $failed
