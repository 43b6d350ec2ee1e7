#!/usr/bin/env bash
# Says how much of each room of the library the tests run, by lines and by branches: a table, coverage.json, and pages with
# each file's lines in build-coverage/report.
#
#   tools/coverage.sh [ARGUMENTS OF CTEST...]
#
# Takes clang with llvm-cov and llvm-profdata (Debian: clang, llvm). Unless other arguments for ctest are given, whole
# pictures are left out, which run what shorter tests run in ten times their time, and the documents' blocks, some of which
# want the SPU's machine code. Exit code 1 where fewer than 90 % of the lines of src, include and backends are run, or where
# tests fail.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=$PWD/build-coverage
suffix=$(clang++ -dumpversion 2>/dev/null | cut -d. -f1) || true
tool() { command -v "$1" || command -v "$1-$suffix" || { echo "Skipped: there is no $1." >&2; exit 77; }; }
command -v clang++ >/dev/null || { echo "Skipped: there is no clang++." >&2; exit 77; }
cov=$(tool llvm-cov)
profdata=$(tool llvm-profdata)

# Optimised a little: pictures by the kernel without any inlining would take too long.
tools/configure.sh release -B "$build" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -DNDEBUG -fprofile-instr-generate -fcoverage-mapping" \
  -DCELLTRACE_WIDE_SIMD=OFF -DCELLTRACE_BENCH=OFF -DCELLTRACE_EXAMPLES=OFF -DCELLTRACE_SPU_GXX=
cmake --build "$build" -- -k 0
rm -rf "$build/profiles"
failed=0
[ $# -gt 0 ] || set -- -LE whole_pictures -E '^docs:'
# Processes of one program add to the same few files.
LLVM_PROFILE_FILE="$build/profiles/%4m.profraw" ctest --test-dir "$build" --no-tests=error -j "$(nproc)" "$@" | tail -n 30 || failed=1
"$profdata" merge -sparse "$build"/profiles/*.profraw -o "$build/all.profdata"

objects=()
while IFS= read -r program; do objects+=(-object "$program"); done \
  < <(find "$build/tests" "$build/src/cli" "$build/python/celltrace" -maxdepth 2 -type f -perm -u+x 2>/dev/null)
# Paths may go through the build's folder, where ccache has made them relative.
others='/(tests|bench|examples)/|build-coverage/(src|backends)/|^/usr/'
"$cov" export -summary-only -instr-profile "$build/all.profdata" -ignore-filename-regex "$others" "${objects[@]}" \
  > "$build/coverage.json"
"$cov" show -format=html -output-dir "$build/report" -instr-profile "$build/all.profdata" \
  -ignore-filename-regex "$others" -show-branches=count "${objects[@]}" > /dev/null

python3 - "$PWD" "$build/coverage.json" <<'PYTHON' || failed=1
import json
import os.path
import sys
from collections import defaultdict

top, report = sys.argv[1:]
counts = defaultdict(lambda: [0, 0, 0, 0])
for file in json.load(open(report))["data"][0]["files"]:
    parts = os.path.relpath(os.path.normpath(file["filename"]), top).split("/")
    if parts[0] not in ("src", "include", "backends"):
        continue
    room = "/".join(parts[:2 if parts[0] in ("src", "backends") else 3 if len(parts) > 3 else 2])
    for key in (room, "all"):
        for i, kind in enumerate(("lines", "branches")):
            counts[key][2 * i] += file["summary"][kind]["covered"]
            counts[key][2 * i + 1] += file["summary"][kind]["count"]
print(f"{'room':32} {'lines':>16} {'branches':>18}")
for room in sorted(counts, key=lambda name: (name == "all", name)):
    lines, of_lines, branches, of_branches = counts[room]
    print(f"{room:32} {lines:6} {100 * lines / max(of_lines, 1):6.1f} % {branches:9} {100 * branches / max(of_branches, 1):6.1f} %")
sys.exit(counts["all"][0] < 0.9 * counts["all"][1])
PYTHON
exit $failed
