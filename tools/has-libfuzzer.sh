#!/usr/bin/env bash
# Whether there is a clang++ that brings the sanitizers' runtime and libFuzzer.
set -euo pipefail

command -v clang++ >/dev/null &&
  clang++ -fsanitize=address,undefined,fuzzer-no-link -x c++ - -o /dev/null <<<'int main() {}' 2>/dev/null
