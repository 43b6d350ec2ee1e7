#!/usr/bin/env bash
# Prints the widest SIMD of this machine that kernels are built for: sse2, avx2 or avx512. The wider it is, the fewer
# instructions has a kernel for its sixteen lanes, and the sooner it is compiled.
set -euo pipefail
flags=" $(grep -m 1 ^flags /proc/cpuinfo) "
for part in f cd dq bw vl; do
  if [[ $flags != *" avx512$part "* ]]; then
    if [[ $flags == *" avx2 "* ]]; then echo avx2; else echo sse2; fi
    exit
  fi
done
echo avx512
